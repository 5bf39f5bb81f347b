// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/TimedValue.H"

#include "core/messages/Error.H"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace shizuku
{

TimedValue::TimedValue(const Dictionary& dict, const std::string& key, const Dimensions& dimensions, double least)
{
    SourceLocation where = dict.where(key);
    if (dict.isDict(key))
    {
        const Dictionary table = dict.subDict(key);
        times_ = table.lookup<std::vector<double>>("times");
        values_ = table.lookup<std::vector<double>>("values");
        where = table.where("values");
        if (times_.empty() || values_.size() != times_.size())
        {
            throw FatalInputError(where, "The table " + key + " of " + dict.name() + " has " + std::to_string(times_.size()) + " times and " + std::to_string(values_.size()) + " values", "a value for each time, and one at the least");
        }
        const auto later = std::adjacent_find(times_.begin(), times_.end(), [](double a, double b) { return !(a < b); });
        if (later != times_.end())
        {
            std::ostringstream found;
            found << "The times of the table " << key << " of " << dict.name() << " are not sorted: " << later[1] << " s follows " << later[0] << " s";
            throw FatalInputError(table.where("times"), found.str(), "times that rise");
        }
    }
    else
    {
        times_ = {0};
        values_ = {dict.lookupDimensioned(key, dimensions)};
    }
    for (const double value : values_)
    {
        if (value >= least && std::isfinite(value)) continue;
        std::ostringstream found, expected;
        found << "The " << key << " of " << dict.name() << " is " << value;
        expected << "a number";
        if (std::isfinite(least)) expected << " of at least " << least;
        throw FatalInputError(where, found.str(), expected.str());
    }
}

double TimedValue::at(double time) const
{
    const std::size_t k = std::upper_bound(times_.begin(), times_.end(), time) - times_.begin();
    if (k == 0) return values_.front();
    if (k == times_.size()) return values_.back();
    const double share = (time - times_[k - 1])/(times_[k] - times_[k - 1]);
    return values_[k - 1] + share*(values_[k] - values_[k - 1]);
}

double TimedValue::most() const
{
    double most = 0;
    for (const double value : values_) most = std::max(most, std::abs(value));
    return most;
}

}
