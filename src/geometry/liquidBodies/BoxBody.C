// type box; min (0 0 0); max (1e-3 1e-3 1e-3);

#include "geometry/liquidBodies/LiquidBody.H"

namespace shizuku
{

class BoxBody : public LiquidBody
{
public:
    explicit BoxBody(const Dictionary& dict)
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

    bool contains(const Vector3& x) const override
    {
        const Vector3 r = x - min_;
        return r.x >= 0 && r.y >= 0 && r.z >= 0 && r.x <= size_.x && r.y <= size_.y && r.z <= size_.z;
    }

private:
    Vector3 min_, size_;
};

static const LiquidBodyTable::Add<BoxBody> registered{"box"};

}
