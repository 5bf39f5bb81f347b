// SPDX-License-Identifier: GPL-3.0-or-later
#include "Comparison.H"

namespace shizuku
{

ComparisonRow absoluteRow(const std::string& quantity, const std::string& unit, double reference, double measured, double target)
{
    return {quantity, unit, reference, measured, measured - reference, unit, target};
}

ComparisonRow relativeRow(const std::string& quantity, const std::string& unit, double reference, double measured, double target)
{
    return {quantity, unit, reference, measured, 100*(measured/reference - 1), "%", target};
}

}
