// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/messages/Progress.H"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

namespace shizuku
{

namespace
{

using Clock = std::chrono::steady_clock;

double secondsBetween(Clock::time_point from, Clock::time_point to)
{
    return std::chrono::duration<double>(to - from).count();
}

constexpr double longestEstimate = 100 * 365.25 * 24 * 3600;      // s, a century: more tells nothing to anybody

// "3 min 20 s" out of 200 seconds, a minute having 60 of them.
std::string twoUnits(long count, long size, const std::string& large, const std::string& small)
{
    const std::string text = std::to_string(count / size) + " " + large;
    return count % size == 0 ? text : text + " " + std::to_string(count % size) + " " + small;
}

}

Progress::Progress(std::string what, double interval)
    : what_(std::move(what)), interval_(interval), start_(Clock::now()), last_(start_)
{}

void Progress::update(double fraction)
{
    const auto now = Clock::now();
    if (secondsBetween(last_, now) < interval_) return;
    last_ = now;
    std::cout << what_ << ": " << text(fraction) << std::endl;
}

double Progress::secondsLeft(double fraction) const
{
    if (!(fraction > 0)) return -1;
    return secondsBetween(start_, Clock::now()) * (1 - std::min(fraction, 1.0)) / fraction;
}

std::string Progress::text(double fraction) const
{
    const std::string done = std::to_string(std::lround(100 * std::clamp(fraction, 0.0, 1.0))) + " %";
    const double left = secondsLeft(fraction);
    return left < 0 || left > longestEstimate ? done : done + ", about " + durationText(left) + " left";
}

std::string Progress::ended(const std::string& name, bool succeeded, double seconds, std::size_t done, std::size_t all) const
{
    return (succeeded ? "Finished " : "FAILED   ") + name + " in " + durationText(seconds) + "  (" + std::to_string(done) + " of " + std::to_string(all) + ": "
         + text(double(done) / double(all)) + ')';
}

std::string durationText(double seconds)
{
    constexpr long minute = 60, hour = 60 * minute, day = 24 * hour;
    const long whole = std::lround(seconds);
    if (whole < minute) return std::to_string(whole) + " s";
    if (whole < hour) return twoUnits(whole, 60, "min", "s");
    if (whole < day) return twoUnits(whole / minute, 60, "h", "min");
    return twoUnits(whole / hour, 24, "d", "h");
}

}
