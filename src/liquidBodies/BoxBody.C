// SPDX-License-Identifier: GPL-3.0-or-later
// type box; min (0 0 0); max (1e-3 1e-3 1e-3);
// Whole rows of particles fill its length and its width, a little wider or narrower than the spacing where that asks for
// it; the height of the layers makes up for it. So the top layer alone may be incomplete.

#include "liquidBodies/LiquidBody.H"

#include <algorithm>

namespace shizuku
{

class BoxBody : public LiquidShape<BoxBody>
{
public:
    BoxBody(const Dictionary& dict, const std::filesystem::path&)
    :
        min_(dict.lookupDimensionedVector("min", dimensions::length)),
        size_(Vector3(dict.lookupDimensionedVector("max", dimensions::length)) - min_)
    {
        if (!(size_.x > 0 && size_.y > 0 && size_.z > 0))
        {
            throw FatalInputError
            (
                dict.where("max"), "The box " + dict.name() + " has min " + str(min_) + " and max " + str(min_ + size_),
                "every component of min below that of max"
            );
        }
    }

    BodyFrame frame() const override { return {min_}; }
    Vector3 low() const override { return {}; }
    Vector3 high() const override { return size_; }
    double volume() const override { return size_.x*size_.y*size_.z; }

    Vector3 cell(double spacing) const override
    {
        const double x = rowSpacing(size_.x, spacing), y = rowSpacing(size_.y, spacing);
        return {x, y, spacing*spacing*spacing/(x*y)};
    }

    bool contains(const Vector3& x) const override
    {
        const Vector3 r = x - min_;
        return r.x >= 0 && r.y >= 0 && r.z >= 0 && r.x <= size_.x && r.y <= size_.y && r.z <= size_.z;
    }

private:
    static double rowSpacing(double length, double spacing) { return length/std::max(1.0, std::round(length/spacing)); }

    Vector3 min_, size_;
};

static const LiquidBodyTable::Add<BoxBody> registered{"box"};

}
