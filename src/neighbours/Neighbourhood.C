#include "neighbours/Neighbourhood.H"

namespace shizuku
{

Neighbourhood::Neighbourhood(const Liquid& liquid) : grid_(liquid.support()), list_(liquid.support()) {}

void Neighbourhood::update(Liquid& liquid, float wideSupport)
{
    if (wideSupport != (wide_ ? wide_->support() : 0))
    {
        grid_ = CellGrid(std::max(liquid.support(), wideSupport));
        wide_.reset();
        if (wideSupport > 0) wide_.emplace(wideSupport);
    }
    liquid.fields().reorder(grid_.build(liquid.predicted.span(), liquid.all()));
    const Span<const Vec3> points = liquid.predicted.span();
    if (!wide_) return list_.build(points, liquid.owned(), grid_, points, true);
    wide_->build(points, liquid.owned(), grid_, points, true);
    list_.buildWithin(*wide_, points, liquid.owned());
}

}
