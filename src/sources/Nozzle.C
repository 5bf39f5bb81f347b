// SPDX-License-Identifier: GPL-3.0-or-later
// tap { type nozzle; mouth (0 0 5e-3); direction (0 0 -1); radius 1e-3; flowRate 2e-9; }       // or velocity in place of flowRate
//
// Layers of a square lattice, a spacing apart, move at one speed through a stretch of two supports in front of the mouth (sources/Stream.H). Behind its
// beginning a layer is born whenever the last one is a spacing ahead, so that liquid in front always has liquid behind it at its own density. The speed is the flow
// rate over the area of the columns, so that the volume is exact, as long as no liquid has crept behind the nozzle: no particle is born on another one.

#include "core/messages/Error.H"
#include "sources/Opening.H"
#include "sources/Source.H"
#include "sources/TimedValue.H"

#include <cmath>

namespace shizuku
{

namespace
{

class Nozzle : public Source
{
public:
    Nozzle(const Dictionary& dict, const SourceSetting& setting)
    :
        opening_(dict, setting.spacing(), true), isFlow_(readsFlow(dict)),
        rate_(dict, isFlow_ ? "flowRate" : "velocity", isFlow_ ? Dimensions{{0, 3, -1, 0, 0, 0, 0}} : dimensions::velocity, 0),
        support_(setting.support()), layersAtFirst_(int(std::ceil(2*support_/setting.spacing()))),
        advance_(setting.number("Advance", 0)), layers_(setting.number("Layers", 1 - layersAtFirst_))
    {}

    std::vector<Vector3> places() const override
    {
        std::vector<Vector3> places;
        for (int k = 0; k < layersAtFirst_; ++k)
        {
            for (const Vector3& column : opening_.columns) places.push_back(at(column, k*opening_.spacing));
        }
        return places;
    }

    std::optional<Stream> stream(double time) const override
    {
        const double aside = 0.3*opening_.spacing, inner = opening_.innerRadius - aside;
        return Stream{from() - opening_.spacing/4*opening_.direction, opening_.direction, length() + opening_.spacing/4, inner > 0 ? inner : 0, opening_.radius + aside, speed(time)};
    }

    bool bearsLiquid() const override { return true; }

    double longestStep() const override
    {
        const double most = rate_.most()/(isFlow_ ? opening_.area() : 1);
        return most > 0 ? support_/most : std::numeric_limits<double>::infinity();
    }

    void bear(const SourceStep& step, std::vector<Birth>& births) override
    {
        constexpr double apart = 0.8, free = 0.5;           // spacings, from liquid that is there before the nozzle is, and from what has come back behind it
        constexpr double rounding = 1e-9;
        const double v = speed(step.middle()), d = opening_.spacing;
        advance_ += v*step.length();
        for (; layers_*d <= advance_ + rounding*d; ++layers_)
        {
            const double depth = advance_ - layers_*d;
            std::vector<Vector3> layer;
            for (const Vector3& column : opening_.columns) layer.push_back(at(column, depth));
            const std::vector<bool> isOccupied = step.areOccupied(layer, (layers_ <= 0 ? apart : free)*d);
            for (std::size_t k = 0; k < layer.size(); ++k)
            {
                if (!isOccupied[k]) births.push_back({layer[k], v*opening_.direction});
            }
        }
    }

    double asked() const override { return (advance_ + (layersAtFirst_ - 1)*opening_.spacing)*opening_.area(); }

private:
    static bool readsFlow(const Dictionary& dict)
    {
        if (dict.found("flowRate") != dict.found("velocity")) return dict.found("flowRate");
        throw FatalInputError(dict.where(), dict.name() + (dict.found("velocity") ? " has both flowRate and velocity" : " has neither flowRate nor velocity"), "one of them");
    }

    double speed(double time) const { return rate_.at(time)/(isFlow_ ? opening_.area() : 1); }
    double length() const { return layersAtFirst_*opening_.spacing; }
    Vector3 from() const { return opening_.mouth - length()*opening_.direction; }
    Vector3 at(const Vector3& column, double depth) const { return from() + column + depth*opening_.direction; }

    Opening opening_;
    bool isFlow_;
    TimedValue rate_;
    double support_;
    int layersAtFirst_;
    double &advance_, &layers_;                 // m; born so far, those at first from a negative number on
};

const SourceTable::Add<Nozzle> registered{"nozzle", "lets liquid in through a disc or a ring, at a speed or a flow rate"};

}

}
