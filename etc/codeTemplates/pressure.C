// SPDX-License-Identifier: GPL-3.0-or-later
// Particles that are closer than a spacing move apart, a fixed number of times. (Equation and source of the model.)
//
//     x_i += mean over close j of (d - r)/2 r_ij/r
//
//     pressure    @word@;
//     system/solution:   pressure { iterations 4; }

#include "models/pressure/Pressure.H"
#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

struct Separate
{
    scalar spacing;
    Span<const Position> x;
    NeighbourView near;
    Span<Position> corrected;

    HOST_DEVICE void operator()(int i) const
    {
        const Position xi = x[i];
        Vec3 sum;
        int close = 0;
        near.forEach(i, [&](int j)
        {
            const Vec3 r = xi - x[j];
            const scalar distance = norm(r);
            if (distance == 0 || distance >= spacing) return;
            sum += 0.5f * (spacing - distance) / distance * r;
            ++close;
        });
        corrected[i] = close > 0 ? xi + 1.0f / scalar(close) * sum : xi;
    }
};

class @class@ : public Pressure
{
public:
    @class@(const Dictionary& dict, Liquid&, const Walls&, FreeSurface&) : iterations_(dict.lookupOr("iterations", 4))
    {
        if (iterations_ < 1) throw FatalInputError(dict.where("iterations"), "iterations is not positive", "1 or more");
    }

    void begin(scalar) override { made_ = 0; }
    bool converged(Liquid&, const Neighbourhood&, const Walls&) override { return made_ >= iterations_; }

    void correct(Liquid& liquid, const Neighbourhood& near, const Walls&) override
    {
        ++made_;
        corrected_.resizeDiscarding(liquid.all());
        NeighbourLoop(liquid, {placesOf(liquid.predicted)}).forEach(Separate{liquid.spacing(), liquid.predicted.span(), near.view(), corrected_.span()});
        liquid.predicted.swap(corrected_);
    }

    // Of converged(); the loop of correct() says what it reads.
    std::optional<Columns> readsOfNeighbours(Liquid&) const override { return Columns{}; }
    int iterations() const override { return made_; }

private:
    int iterations_, made_ = 0;
    Buffer<Position> corrected_;
};

const PressureTable::Add<@class@> registered{"@word@", "what it does, in a line"};

}

}
