// SPDX-License-Identifier: GPL-3.0-or-later
// type rest;  within 1e-3;
// Whether the liquid has come to rest: over the last tenth of the run, but no more than its last ten capillary times R/v_c, the
// rms speed of its particles and the speed of its centroid (a straight line through its path), both over the capillary speed
// v_c = sqrt(sigma/(rho R)), R the radius of a sphere of the liquid's volume. The time is told in viscous times R^2/nu.

#include "Comparison.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

// Slope of the least-squares line y(t).
double slope(const std::vector<double>& t, const std::vector<double>& y)
{
    double meanT = 0, meanY = 0, above = 0, below = 0;
    for (std::size_t i = 0; i < t.size(); ++i)
    {
        meanT += t[i]/double(t.size());
        meanY += y[i]/double(t.size());
    }
    for (std::size_t i = 0; i < t.size(); ++i)
    {
        above += (t[i] - meanT)*(y[i] - meanY);
        below += (t[i] - meanT)*(t[i] - meanT);
    }
    return above/below;
}

}

static std::vector<ComparisonRow> compareRest(const CaseResults& results, double within)
{
    const CsvTable states = results.table("drop", "liquidState.csv");
    const std::vector<double> allTimes = states.numbers("time");
    const double end = allTimes.back(), scale = results.capillarySpeed();
    const double begin = end - std::min(0.1*end, 10*results.radius()/scale);
    const double mass = results.rho*results.liquidVolume();

    std::vector<double> times, x, y, z;
    double speed = 0;
    for (std::size_t row = 0; row < states.rows(); ++row)
    {
        if (allTimes[row] < begin) continue;
        times.push_back(allTimes[row]);
        x.push_back(states.number(row, "centroidX"));
        y.push_back(states.number(row, "centroidY"));
        z.push_back(states.number(row, "centroidZ"));
        speed += std::sqrt(2*states.number(row, "kineticEnergy")/mass);
    }
    const double drift = std::hypot(slope(times, x), slope(times, y), slope(times, z));
    const double none = std::nan("");
    const double viscousTime = results.radius()*results.radius()/results.nu;
    return
    {
        absoluteRow("rms speed over capillary speed", "", 0, speed/double(times.size())/scale, within),
        absoluteRow("centroid speed over capillary", "", 0, drift/scale, within),
        {"end in viscous times", "", 10, end/viscousTime, none, "", none}
    };
}

static const ComparisonTable::Add<PlainComparison<compareRest>> registered{"rest"};

}
