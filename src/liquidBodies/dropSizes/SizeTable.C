// SPDX-License-Identifier: GPL-3.0-or-later
// sizes { type table; diameters (1e-3 2e-3 3e-3); shares (5 3 1); }
// So many of the drops, against each other, are of each diameter.

#include "liquidBodies/dropSizes/DropSizes.H"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace shizuku
{

class SizeTable : public DropSizes
{
public:
    explicit SizeTable(const Dictionary& dict)
    :
        diameters_(dict.lookup<std::vector<double>>("diameters"))
    {
        const auto shares = dict.lookup<std::vector<double>>("shares");
        refuseNotAbove(dict, "diameters", diameters_);
        refuseNotAbove(dict, "shares", shares);
        if (shares.size() != diameters_.size())
        {
            throw FatalInputError
            (
                dict.where("shares"), "There are " + std::to_string(diameters_.size()) + " diameters and " + std::to_string(shares.size()) + " shares",
                "a share for each diameter"
            );
        }
        below_.resize(shares.size());
        std::partial_sum(shares.begin(), shares.end(), below_.begin());
    }

    double diameter(double share) const override
    {
        const auto it = std::upper_bound(below_.begin(), below_.end() - 1, share*below_.back());
        return diameters_[it - below_.begin()];
    }

private:
    static void refuseNotAbove(const Dictionary& dict, const std::string& list, const std::vector<double>& values)
    {
        const bool good = !values.empty() && std::all_of(values.begin(), values.end(), [](double value) { return value > 0 && value < 1e300; });
        if (!good) throw FatalInputError(dict.where(list), "The list " + list + " of " + dict.name() + " is empty, or not all of it is above zero", "numbers above 0");
    }

    std::vector<double> diameters_, below_;     // m; sums of the shares up to each
};

static const DropSizesTable::Add<SizeTable> registered{"table", "given diameters, in given shares"};

}
