#include "neighbours/Neighbourhood.H"

#include <algorithm>

namespace shizuku
{

Neighbourhood::Neighbourhood(const Liquid& liquid) : grid_(liquid.support()), list_(liquid.support()) {}

void Neighbourhood::update(Liquid& liquid, float wideSupport)
{
    if (wideSupport != wideSupport_)
    {
        grid_ = CellGrid(liquid.support(), std::max(liquid.support(), wideSupport));
        wideSupport_ = wideSupport;
    }
    liquid.fields().reorder(grid_.build(liquid.predicted.span(), liquid.all()));
    const Span<const Vec3> points = liquid.predicted.span();
    list_.build(points, liquid.owned(), grid_, points, true);
}

}
