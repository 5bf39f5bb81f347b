// SPDX-License-Identifier: GPL-3.0-or-later
// sizes { type oneSize; diameter 2e-3; }

#include "liquidBodies/dropSizes/DropSizes.H"

namespace shizuku
{

class OneSize : public DropSizes
{
public:
    explicit OneSize(const Dictionary& dict) : diameter_(dict.lookupPositive("diameter", dimensions::length)) {}

    double diameter(double) const override { return diameter_; }

private:
    double diameter_;
};

static const DropSizesTable::Add<OneSize> registered{"oneSize", "all drops of one diameter"};

}
