// SPDX-License-Identifier: GPL-3.0-or-later
// type image; file "pattern.png"; theta (30 110); origin (-1e-3 -1e-3 0); width (2e-3 0 0); height (0 2e-3 0); outside tile;
//
// Wettability painted with a picture: the angles [degrees] of black and of white, in between in proportion to the grey
// value. The file is in the case's folder constant. Its lower left corner is at `origin`, its lower right one at origin +
// width, its upper left one at origin + height [m]; it is projected along the normal of that rectangle. A place has the
// value of its pixel. Outside of the rectangle the picture is repeated (tile) or its border goes on (clamp, the default).

#include "thetaModels/ThetaModel.H"
#include "vtk/GreyImage.H"

#include <algorithm>

namespace shizuku
{

class ImageTheta : public ThetaModel
{
public:
    ImageTheta(const Dictionary& dict, const std::filesystem::path& casePath)
    :
        theta_(readThetaPair(dict, "theta")),
        origin_(dict.lookupDimensionedVector("origin", dimensions::length)),
        width_(readSide(dict, "width")), height_(readSide(dict, "height")),
        tile_(dict.lookupChoiceOr("outside", {"tile", "clamp"}, "clamp") == "tile"),
        image_(readGreyImage(casePath/"constant"/dict.lookup<std::string>("file")))
    {
        constexpr double tolerance = 1e-6;
        if (std::abs(dot(width_, height_)) > tolerance*length(width_)*length(height_))
        {
            throw FatalInputError
            (
                dict.where("height"), "The image's width " + str(width_) + " and height " + str(height_)
              + " are not at right angles", "the sides of a rectangle"
            );
        }
    }

    double theta(const Vector3& x) const override
    {
        const double across = dot(x - origin_, width_)/squaredLength(width_);
        const double up = dot(x - origin_, height_)/squaredLength(height_);
        const float grey = image_.at(pixel(across, image_.width), pixel(up, image_.height));
        return theta_.first + grey*(theta_.second - theta_.first);
    }

private:
    static Vector3 readSide(const Dictionary& dict, const std::string& key)
    {
        const Vector3 side = dict.lookupDimensionedVector(key, dimensions::length);
        if (!(squaredLength(side) > 0))
        {
            throw FatalInputError(dict.where(key), "The image's " + key + " is zero", "a side of the rectangle, m");
        }
        return side;
    }

    // place: 0 to 1 over the image
    int pixel(double place, int pixels) const
    {
        const double inside = tile_ ? place - std::floor(place) : std::clamp(place, 0.0, 1.0);
        return std::min(int(inside*pixels), pixels - 1);
    }

    std::pair<double, double> theta_;           // degrees, of black and of white
    Vector3 origin_, width_, height_;           // m
    bool tile_;
    GreyImage image_;
};

static const ThetaModelTable::Add<ImageTheta> registered{"image"};

}
