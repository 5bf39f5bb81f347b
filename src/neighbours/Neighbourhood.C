#include "neighbours/Neighbourhood.H"

namespace shizuku
{

void Neighbourhood::update(Liquid& liquid)
{
    liquid.fields().reorder(grid_.build(liquid.predicted.span(), liquid.all()));
    list_.build(liquid.predicted.span(), liquid.owned(), grid_, liquid.predicted.span(), true);
}

}
