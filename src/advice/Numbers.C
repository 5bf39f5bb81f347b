// SPDX-License-Identifier: GPL-3.0-or-later
#include "advice/Numbers.H"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace shizuku
{

std::string percent(double share)
{
    return share > 1 ? "all of it" : number(100*share) + " %";
}

std::string number(double value)
{
    std::ostringstream text;
    text << std::setprecision(3) << value;
    return text.str();
}

std::string wholeNumber(double value)
{
    return std::to_string(std::lround(value));
}

}
