// SPDX-License-Identifier: GPL-3.0-or-later
// type drops; min (0 0 0.01); max (0.1 0.1 0.2); number 1000; sizes { type oneSize; diameter 2e-3; } speeds terminal; seed 1; gap 5e-4;
//
// Balls at random places of a box, which do not meet: so many, or of so much water that it would stand `depth` high [m] on the box's floor. Each falls
// at its terminal speed where speeds ask for it, along the case's gravity. gap: three particle spacings, where nothing else is said.
// The same seed gives the same bytes on every machine: diameters are whole nanometres, so that the last bits of a machine's logarithm do not matter.

#include "caseFiles/CaseGravity.H"
#include "caseFiles/LiquidFiles.H"
#include "core/messages/Progress.H"
#include "device/HostThreads.H"
#include "liquidBodies/LiquidBody.H"
#include "liquidBodies/PlaceBalls.H"
#include "liquidBodies/dropSizes/DropSizes.H"
#include "reference/Rain.H"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr std::size_t mostDrops = 100'000'000;

double volumeOfBall(double diameter) { return std::numbers::pi/6*diameter*diameter*diameter; }

class Ball : public LiquidShape<Ball>
{
public:
    explicit Ball(double radius) : radius_(radius) {}

    BodyFrame frame() const override { return {}; }
    Vector3 low() const override { return {-radius_, -radius_, -radius_}; }
    Vector3 high() const override { return {radius_, radius_, radius_}; }
    bool contains(const Vector3& x) const override { return squaredLength(x) <= radius_*radius_; }
    double volume() const override { return volumeOfBall(2*radius_); }

private:
    double radius_;
};

// Diameters, of which as many are drawn as there shall be.
class DrawnSizes
{
public:
    DrawnSizes(const Dictionary& dict, std::uint64_t seed) : dict_(dict), random_(seed)
    {
        const Dictionary sizes = dict.subDict("sizes");
        distribution_ = DropSizesTable::New("drop size", sizes.lookup<std::string>("type"), sizes.where("type"), sizes);
    }

    std::vector<double> byNumber()
    {
        const int number = dict_.lookup<int>("number");
        if (number < 1 || std::size_t(number) > mostDrops) refuse("number", std::to_string(number) + " drops were asked for");
        std::vector<double> diameters(number);
        for (double& diameter : diameters) diameter = draw();
        return diameters;
    }

    // The last one is taken where the volume is nearer to the one asked for with it.
    std::vector<double> byVolume(double volume)
    {
        std::vector<double> diameters;
        double there = 0;
        while (true)
        {
            const double diameter = draw(), one = volumeOfBall(diameter);
            if (there + 0.5*one > volume) break;
            if (diameters.size() == mostDrops) refuse("depth", "The depth asks for more drops than that");
            there += one;
            diameters.push_back(diameter);
        }
        if (diameters.empty()) refuse("depth", "The depth asks for no whole drop: it is " + std::to_string(volume) + " m3 in all");
        return diameters;
    }

private:
    [[noreturn]] void refuse(const std::string& entry, const std::string& found) const
    {
        throw FatalInputError(dict_.where(entry), found, "1 to " + std::to_string(mostDrops) + " drops");
    }

    double draw()
    {
        constexpr double nanometre = 1e-9;
        return std::max(1.0, std::round(distribution_->diameter(double(random_() >> 11)*0x1p-53)/nanometre))*nanometre;
    }

    Dictionary dict_;
    std::mt19937_64 random_;
    std::unique_ptr<DropSizes> distribution_;
};

}

class DropsBody : public LiquidShape<DropsBody>
{
public:
    DropsBody(const Dictionary& dict, const std::filesystem::path& casePath)
    :
        box_{dict.lookupDimensionedVector("min", dimensions::length), dict.lookupDimensionedVector("max", dimensions::length)},
        balls_(place(dict, casePath))
    {
        if (dict.lookupChoiceOr("speeds", {"none", "terminal"}, "none") == "none") return;
        const Vector3 gravity = caseGravity(casePath);
        if (gravity == Vector3())
        {
            throw FatalInputError(dict.where("speeds"), "The drops shall fall, and the case has no gravity", "bodyForce gravity in constant/models, or speeds none");
        }
        if (2*balls_.radii().back() < smallestFallingDrop)
        {
            std::ostringstream found;
            found << "There are drops of " << 2*balls_.radii().back() << " m, whose terminal speed is not known";
            throw FatalInputError(dict.where("speeds"), found.str(), "drops of 0.11 mm and more, or speeds none");
        }
        down_ = gravity/length(gravity);
    }

    BodyFrame frame() const override { return {box_.low}; }
    Vector3 low() const override { return {}; }
    Vector3 high() const override { return box_.high - box_.low; }
    bool contains(const Vector3& x) const override { return balls_.contains(x); }
    double volume() const override { return balls_.volume(); }

    std::vector<Vector3> fill(double spacing, const SourceLocation& where) const override
    {
        constexpr std::size_t share = 64, together = 64*share;          // balls of a thread at a time, and up to where these are put behind each other
        const std::size_t balls = balls_.placed();
        std::vector<Vector3> positions;
        positions.reserve(std::size_t(1.01*volume()/(spacing*spacing*spacing)));
        Progress progress("Filling " + std::to_string(balls) + " drops");
        for (std::size_t begin = 0; begin < balls; begin += together)
        {
            const std::size_t end = std::min(balls, begin + together);
            std::vector<std::vector<Vector3>> filled((end - begin + share - 1)/share);
            forEachPart(filled.size(), [&](std::size_t part)
            {
                const std::size_t first = begin + part*share;
                filled[part] = fillBalls(first, std::min(end, first + share), spacing, where);
            });
            for (const std::vector<Vector3>& some : filled) positions.insert(positions.end(), some.begin(), some.end());
            progress.update(double(end)/double(balls));
        }
        return positions;
    }

    bool hasVelocities() const override { return down_.has_value(); }

    Vector3 velocityAt(const Vector3& x) const override
    {
        const int ball = down_ ? balls_.nearest(x, balls_.radii().back()) : -1;
        return ball < 0 ? Vector3() : roundedSpeed(2*balls_.radii()[ball])**down_;
    }

    std::string describe() const override
    {
        double sum = 0;
        for (const double radius : balls_.radii()) sum += 2*radius;
        const Vector3 size = high();
        std::ostringstream text;
        text << balls_.placed() << " drops of " << 2*balls_.radii().back() << " to " << 2*balls_.radii().front() << " m, "
             << sum/double(balls_.placed()) << " m in the mean, in " << 100*volume()/(size.x*size.y*size.z) << " % of the box";
        if (down_) text << ", falling at " << roundedSpeed(2*balls_.radii().back()) << " to " << roundedSpeed(2*balls_.radii().front()) << " m/s";
        return text.str();
    }

private:
    // Of balls from the first up to the end.
    std::vector<Vector3> fillBalls(std::size_t first, std::size_t end, double spacing, const SourceLocation& where) const
    {
        const double quantum = spacing*0x1p-20;         // so that no machine rounds places differently
        const auto rounded = [&](double x) { return std::round(x/quantum)*quantum; };
        std::vector<Vector3> positions, ofBall;
        for (std::size_t ball = first; ball < end; ++ball)
        {
            const double radius = balls_.radii()[ball];
            if (ball == first || radius != balls_.radii()[ball - 1]) ofBall = fillLattice(Ball(radius), spacing, where);
            for (const Vector3& offset : ofBall)
            {
                const Vector3 x = balls_.centres()[ball] + offset;
                positions.emplace_back(rounded(x.x), rounded(x.y), rounded(x.z));
            }
        }
        return positions;
    }

    // Whole micrometres a second: see diameters.
    static double roundedSpeed(double diameter)
    {
        constexpr double quantum = 1e-6;
        return std::round(terminalSpeed(diameter)/quantum)*quantum;
    }

    PlacedBalls place(const Dictionary& dict, const std::filesystem::path& casePath)
    {
        const Vector3 size = high();
        if (!(size.x > 0 && size.y > 0 && size.z > 0))
        {
            throw FatalInputError
            (
                dict.where("max"), "The box of " + dict.name() + " has min " + str(box_.low) + " and max " + str(box_.high),
                "every component of min below that of max"
            );
        }
        const int seed = dict.lookupOr("seed", 1);
        DrawnSizes drawn(dict, std::uint64_t(seed));
        if (dict.found("number") == dict.found("depth"))
        {
            throw FatalInputError
            (
                dict.where(), "The drops of " + dict.name() + " have " + (dict.found("number") ? "both number and depth" : "neither number nor depth"),
                "number, of drops, or depth, m: how high their water would stand on the floor of the box"
            );
        }
        std::vector<double> radii = dict.found("number") ? drawn.byNumber()
            : drawn.byVolume(dict.lookupPositive("depth", dimensions::length)*size.x*size.y);
        for (double& radius : radii) radius *= 0.5;

        const double largest = 2**std::max_element(radii.begin(), radii.end()), least = std::min({size.x, size.y, size.z});
        const double gap = dict.found("gap") ? dict.lookupPositive("gap", dimensions::length, true) : 3*readSpacing(casePath);
        std::ostringstream found;
        if (largest > least)
        {
            found << "A drop of " << largest << " m is larger than the box of " << dict.name() << ", " << str(size) << " m";
            throw FatalInputError(dict.where("max"), found.str(), "a box that holds the largest drop");
        }
        constexpr std::uint64_t placesApart = 0x9E3779B97F4A7C15ull;        // from the numbers that sizes were drawn with
        PlacedBalls balls(box_, std::move(radii), gap, std::uint64_t(seed) ^ placesApart, "Placing drops");
        if (balls.placed() == balls.wanted()) return balls;
        found << balls.placed() << " of the " << balls.wanted() << " drops fill " << 100*balls.volume()/(size.x*size.y*size.z)
              << " % of the box; the next one, of " << 2*balls.nextRadius() << " m, finds no place " << gap << " m away from the others";
        throw FatalInputError(dict.where(), found.str(), "fewer drops, a larger box, or a smaller gap");
    }

    Bounds box_;
    PlacedBalls balls_;
    std::optional<Vector3> down_;           // where they fall
};

static const LiquidBodyTable::Add<DropsBody> registered{"drops"};

}
