// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/TimeName.H"

#include <cmath>
#include <system_error>

namespace shizuku
{

namespace
{

constexpr int enoughDigits = 17;        // tell any two doubles apart

}

std::string timeName(double value, double deltaT, const TimeNameFormat& format)
{
    for (int precision = format.precision;; ++precision)
    {
        char text[400];                 // a fixed double has 309 digits before the point at most
        const auto end = std::to_chars(text, text + sizeof text, value, format.style, precision).ptr;
        const std::string name(text, end);
        if (precision >= enoughDigits || namesTime(name, value, deltaT)) return name;
    }
}

std::optional<double> timeOfName(const std::string& name)
{
    double value = 0;
    const char* end = name.data() + name.size();
    const auto [parsed, error] = std::from_chars(name.data(), end, value);
    if (error != std::errc() || parsed != end || !std::isfinite(value)) return {};
    return value;
}

bool namesTime(const std::string& name, double value, double deltaT)
{
    const auto named = timeOfName(name);
    return named && std::abs(*named - value) < 0.1 * deltaT;
}

}
