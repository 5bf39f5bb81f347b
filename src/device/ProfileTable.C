// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/ProfileTable.H"

#include <iomanip>
#include <ostream>

namespace shizuku
{

void printProfile
(
    std::ostream& out, const std::vector<KernelTime>& times, long launches, long number, const std::string& turn
)
{
    const int width = 16;
    const auto row = [&](double calls, double milliseconds, const std::string& kernel)
    {
        out << std::setw(width) << calls / double(number) << std::setw(width) << milliseconds / double(number)
            << "   " << kernel << '\n';
    };
    out << std::setw(width) << "calls a " + turn << std::setw(width) << "ms a " + turn << "   kernel\n";
    double sum = 0;
    for (const KernelTime& time : times)
    {
        sum += time.milliseconds;
        row(double(time.calls), time.milliseconds, time.kernel);
    }
    row(double(launches), sum, "all");
}

}
