// SPDX-License-Identifier: GPL-3.0-or-later
// sizes { type exponential; rainRate 2.8e-6; minDiameter 0.6e-3; maxDiameter 4e-3; }       // or meanDiameter in place of rainRate
//
// Numbers fall with the diameter as exp(-D/mean), between the smallest and the largest (Marshall and Palmer 1948). The mean is that of
// the distribution without these ends, given, or of a rain rate [m/s].

#include "liquidBodies/dropSizes/DropSizes.H"
#include "reference/Rain.H"

namespace shizuku
{

class ExponentialSizes : public DropSizes
{
public:
    explicit ExponentialSizes(const Dictionary& dict)
    :
        mean_(readMean(dict)),
        least_(dict.lookupPositive("minDiameter", dimensions::length)),
        most_(dict.lookupPositive("maxDiameter", dimensions::length))
    {
        if (least_ >= most_)
        {
            throw FatalInputError
            (
                dict.where("maxDiameter"), "The largest drop of " + dict.name() + " is no larger than the smallest one",
                "maxDiameter above minDiameter"
            );
        }
    }

    double diameter(double share) const override
    {
        const double within = -std::expm1((least_ - most_)/mean_);      // of all that are larger than the smallest
        return std::min(most_, least_ - mean_*std::log1p(-share*within));
    }

private:
    static double readMean(const Dictionary& dict)
    {
        if (dict.found("meanDiameter") && dict.found("rainRate"))
        {
            throw FatalInputError(dict.where("rainRate"), "The sizes have both meanDiameter and rainRate", "one of them");
        }
        if (dict.found("rainRate")) return meanRainDrop(dict.lookupPositive("rainRate", dimensions::velocity));
        return dict.lookupPositive("meanDiameter", dimensions::length);
    }

    double mean_, least_, most_;
};

static const DropSizesTable::Add<ExponentialSizes> registered{"exponential", "numbers that fall exponentially with the diameter, as in rain"};

}
