// SPDX-License-Identifier: GPL-3.0-or-later
// shower
// {
//     type rain; rate 1.4e-5; corner (0 0 0.02); along (0.03 0 0); across (0 0.02 0);
//     direction (0 0 -1); speed 2; sizes { type exponential; ... } seed 1;
// }
//
// Balls of liquid at random places of a parallelogram, as many as the rate [m3 a m2 and second] asks for. A drop's size and place follow from the seed and the drop's
// number alone. Without `speed` it falls as fast as such a drop does in air. A place where liquid is too near is given up for another; a drop that finds none in a step waits for the next one.

#include "caseFiles/UnitVector.H"
#include "core/messages/Error.H"
#include "liquidBodies/dropSizes/DropSizes.H"
#include "reference/Rain.H"
#include "sources/Source.H"
#include "sources/TimedValue.H"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <sstream>

namespace shizuku
{

namespace
{

// splitmix64: 0 up to, and without, 1.
double randomShare(std::uint64_t seed, std::uint64_t number)
{
    std::uint64_t bits = seed*0xd1342543de82ef95u + (number + 1)*0x9e3779b97f4a7c15u;
    bits = (bits ^ bits >> 30)*0xbf58476d1ce4e5b9u;
    bits = (bits ^ bits >> 27)*0x94d049bb133111ebu;
    return double((bits ^ bits >> 31) >> 11)*0x1p-53;
}

class Rain : public Source
{
public:
    Rain(const Dictionary& dict, const SourceSetting& setting)
    :
        spacing_(setting.spacing()), rate_(dict, "rate", dimensions::velocity, 0), corner_(dict.lookupDimensionedVector("corner", dimensions::length)),
        along_(dict.lookupDimensionedVector("along", dimensions::length)), across_(dict.lookupDimensionedVector("across", dimensions::length)),
        direction_(readUnitVector(dict, "direction")), sizes_(readSizes(dict)), seed_(std::uint64_t(dict.lookupOr("seed", 1))), isTerminal_(!dict.found("speed")),
        asked_(setting.number("Asked", 0)), let_(setting.number("Let", 0)), drops_(setting.number("Drops", 0)), tries_(setting.number("Tries", 0))
    {
        if (!isTerminal_) speed_ = dict.lookupPositive("speed", dimensions::velocity, true);
        if (!(area() > 0)) throw FatalInputError(dict.where("across"), "The area of " + dict.name() + " is none: along and across have one direction", "two sides of a parallelogram");
        constexpr double least = 2.5;           // spacings
        if (sizes_->diameter(0) < least*spacing_)
        {
            std::ostringstream found;
            found << "The smallest drop of " << dict.name() << " has " << sizes_->diameter(0)/spacing_ << " spacings across";
            throw FatalInputError(dict.where("sizes"), found.str(), "2.5 at the least: larger drops, or a smaller spacing in system/solution");
        }
    }

    std::vector<Vector3> places() const override { return {corner_, corner_ + along_, corner_ + across_, corner_ + along_ + across_}; }

    void bear(const SourceStep& step, std::vector<Birth>& births) override
    {
        constexpr int mostTries = 8;
        asked_ += rate_.at(step.middle())*area()*step.length();
        int tried = 0;
        for (;;)
        {
            const double diameter = sizes_->diameter(share(3*drops_));
            const std::vector<Vector3> ball = ballOf(diameter);
            if ((let_ + double(ball.size()))*particleVolume() > asked_) return;
            const std::size_t first = births.size();
            for (; births.size() == first && tried < mostTries; ++tried, ++tries_)
            {
                const Vector3 centre = corner_ + share(3*tries_ + 1)*along_ + share(3*tries_ + 2)*across_;
                if (!isFree(centre, diameter, step, births)) continue;
                const double speed = isTerminal_ ? terminalSpeed(diameter) : speed_;
                for (const Vector3& point : ball) births.push_back({centre + point, speed*direction_});
            }
            if (births.size() == first) return;
            let_ += double(ball.size());
            ++drops_;
        }
    }

    double asked() const override { return asked_; }

private:
    static std::unique_ptr<DropSizes> readSizes(const Dictionary& dict)
    {
        const Dictionary sizes = dict.subDict("sizes");
        return DropSizesTable::New("sizes", sizes.lookup<std::string>("type"), sizes.where("type"), sizes);
    }

    // From its centre on: the lattice points that are the nearest to it, as many as its volume has.
    std::vector<Vector3> ballOf(double diameter) const
    {
        const std::size_t number = std::size_t(std::lround(std::numbers::pi/6*diameter*diameter*diameter/particleVolume()));
        const int most = int(diameter/2/spacing_) + 2;
        std::vector<Vector3> points;
        for (int i = -most; i < most; ++i)
        {
            for (int j = -most; j < most; ++j)
            {
                for (int k = -most; k < most; ++k) points.push_back(spacing_*Vector3(i + 0.5, j + 0.5, k + 0.5));
            }
        }
        std::stable_sort(points.begin(), points.end(), [](const Vector3& a, const Vector3& b) { return squaredLength(a) < squaredLength(b); });
        points.resize(number);
        return points;
    }

    bool isFree(const Vector3& centre, double diameter, const SourceStep& step, const std::vector<Birth>& births) const
    {
        const double reach = diameter/2 + 2*spacing_;
        for (const Birth& birth : births)
        {
            if (step.distance(birth.place, centre) < reach) return false;
        }
        return !step.isOccupied(centre, reach);
    }

    double share(double number) const { return randomShare(seed_, std::uint64_t(number)); }
    double area() const { return length(cross(along_, across_)); }
    double particleVolume() const { return spacing_*spacing_*spacing_; }

    double spacing_;
    TimedValue rate_;
    Vector3 corner_, along_, across_, direction_;
    std::unique_ptr<DropSizes> sizes_;
    std::uint64_t seed_;
    bool isTerminal_;
    double speed_ = 0;                          // m/s
    double &asked_, &let_, &drops_, &tries_;    // m3; particles; drops let in; places tried
};

const SourceTable::Add<Rain> registered{"rain", "lets drops in at random places of an area"};

}

}
