// SPDX-License-Identifier: GPL-3.0-or-later
// pool { type reservoir; min (0 0 0); max (0.01 0.02 0.012); direction (0 0 1); level 8e-3; relaxationTime 5e-3; }
//
// A part of a pool whose surface stays at a level h above the floor of the box, whatever a tube draws from the pool or pushes back: the pressure at the floor stays rho g h.
// The volume that is missing in the box comes in within a relaxation time,
//
//     dV/dt = (h A - N s^3)/tau,
//
// so that a flow Q out of the box holds its level Q tau/A below h. Particles are born on the surface, in columns that take turns, as deep as they come to rest on the others;
// those that are the highest leave. Nothing is moved by force: what is in the box flows as all other liquid does.

#include "caseFiles/UnitVector.H"
#include "core/messages/Error.H"
#include "sources/Source.H"
#include "sources/TimedValue.H"
#include "sources/Turns.H"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace shizuku
{

namespace
{

class Reservoir : public Source
{
public:
    Reservoir(const Dictionary& dict, const SourceSetting& setting)
    :
        spacing_(setting.spacing()), box_(readBox(dict)), level_(dict, "level", dimensions::length, 0), relaxationTime_(dict.lookupDimensioned("relaxationTime", dimensions::time)),
        volume_(setting.number("Volume", 0)), let_(setting.number("Let", 0)), turns_(setting.number("Turns", 0))
    {
        if (!(relaxationTime_ > 0)) throw FatalInputError(dict.where("relaxationTime"), "relaxationTime is not above 0", "a time in which the level comes back, of many time steps");
        if (level_.most() > box_.depth() - spacing_)
        {
            std::ostringstream found, expected;
            found << "The level of " << dict.name() << ", " << level_.most() << " m, leaves no room for a spacing below the top of its box";
            expected << "a level of at most " << box_.depth() - spacing_ << " m above the floor of the box, or a higher box";
            throw FatalInputError(dict.where("level"), found.str(), expected.str());
        }
        readColumns(dict);
    }

    std::vector<Vector3> places() const override
    {
        std::vector<Vector3> places;
        for (double height = spacing_/2; height < box_.depth() - spacing_/4; height += spacing_)
        {
            for (const Vector3& column : columns_) places.push_back(box_.at(column, height));
        }
        return places;
    }

    double longestStep() const override { return relaxationTime_; }

    void bear(const SourceStep& step, std::vector<Birth>& births) override
    {
        constexpr double calm = 1;              // particle, by which the level may be off
        const double missing = level_.at(step.to)*box_.area()/particleVolume() - step.particlesIn(box_) - (wanted() - let_);
        if (std::abs(missing) > calm) volume_ += missing*particleVolume()*step.length()/relaxationTime_;

        const std::size_t first = births.size(), most = first + columns_.size()/few + 1;
        while (let_ < wanted() && births.size() < most)
        {
            const auto place = lowestOfAFew(step, births, first);
            if (!place) return;
            births.push_back({*place, {}});
            ++let_;
        }
    }

    int due() const override { return let_ > wanted() ? int(let_ - wanted()) : 0; }
    void drew(int taken) override { let_ -= taken; }
    std::optional<Pool> drawsFrom() const override { return box_; }

    double asked() const override { return volume_; }

private:
    static constexpr int few = 4;

    double particleVolume() const { return spacing_*spacing_*spacing_; }
    double wanted() const { return std::floor(volume_/particleVolume() + 1e-6); }

    // On the surface, over the lowest of the columns whose turn it is; nothing where the box is full there.
    std::optional<Vector3> lowestOfAFew(const SourceStep& step, const std::vector<Birth>& births, std::size_t first)
    {
        std::optional<Vector3> place;
        double lowest = box_.depth();
        for (int tried = 0; tried < few; ++tried, ++turns_)
        {
            const Vector3& column = columns_[columnOfTurn(turns_, columns_.size())];
            const double height = std::max(step.restingHeight(box_, column, spacing_), spacing_/2);
            if (height >= lowest) continue;
            const Vector3 at = box_.at(column, height);
            const auto isNear = [&](const Birth& birth) { return step.distance(birth.place, at) < spacing_; };
            if (std::any_of(births.begin() + std::ptrdiff_t(first), births.end(), isNear)) continue;
            lowest = height;
            place = at;
        }
        return place;
    }

    static Pool readBox(const Dictionary& dict)
    {
        constexpr double skew = 1e-6;
        const Vector3 min = dict.lookupDimensionedVector("min", dimensions::length), max = dict.lookupDimensionedVector("max", dimensions::length), up = readUnitVector(dict, "direction");
        Pool box;
        box.axis = -1;
        for (int k = 0; k < 3; ++k)
        {
            if (!(min[k] < max[k])) throw FatalInputError(dict.where("max"), "The box of " + dict.name() + " has no extent along " + "xyz"[k], "max above min, in all three");
            box.middle[k] = (min[k] + max[k])/2;
            box.half[k] = (max[k] - min[k])/2;
            if (std::abs(up[k]) < 1 - skew) continue;
            box.axis = k;
            box.up = up[k] > 0 ? 1 : -1;
        }
        if (box.axis < 0) throw FatalInputError(dict.where("direction"), "The direction of " + dict.name() + " lies along no side of its box", "the direction from the floor of the box to its top, along x, y or z: (0 0 1)");
        return box;
    }

    void readColumns(const Dictionary& dict)
    {
        int n[3];
        for (int k = 0; k < 3; ++k) n[k] = k == box_.axis ? 1 : int(2*box_.half[k]/spacing_ + 1e-6);
        if (n[0]*n[1]*n[2] < few)
        {
            std::ostringstream found;
            found << "The floor of " << dict.name() << " has room for " << n[0]*n[1]*n[2] << " particles";
            throw FatalInputError(dict.where("max"), found.str(), "4 at the least: a wider box, or a smaller spacing in system/solution");
        }
        for (int i = 0; i < n[0]; ++i)
        {
            for (int j = 0; j < n[1]; ++j)
            {
                for (int k = 0; k < n[2]; ++k)
                {
                    const Vector3 share((i + 0.5)/n[0], (j + 0.5)/n[1], (k + 0.5)/n[2]);
                    Vector3 column;
                    for (int axis = 0; axis < 3; ++axis) column[axis] = box_.middle[axis] + (2*share[axis] - 1)*box_.half[axis];
                    columns_.push_back(column);
                }
            }
        }
    }

    double spacing_;
    Pool box_;
    TimedValue level_;
    double relaxationTime_;                     // s
    double &volume_, &let_, &turns_;            // m3 asked for; particles let in, less those drawn; columns that had their turn
    std::vector<Vector3> columns_;              // m
};

const SourceTable::Add<Reservoir> registered{"reservoir", "keeps a pool at a level, and so the pressure below it"};

}

}
