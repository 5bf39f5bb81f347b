// SPDX-License-Identifier: GPL-3.0-or-later
// type table; times (0 0.1 0.2); displacements ((0 0 0) (1e-3 0 0) (1e-3 0 5e-4));
// The displacement [m] is linear between those of the times [s after start], and stays at the last one.

#include "wallMotions/WallMotion.H"

#include <algorithm>
#include <array>
#include <sstream>
#include <vector>

namespace shizuku
{

class TableMotion : public WallMotion
{
public:
    explicit TableMotion(const Dictionary& dict) : WallMotion(dict), times_(dict.lookup<std::vector<double>>("times"))
    {
        for (const auto& displacement : dict.lookup<std::vector<std::array<double, 3>>>("displacements")) displacements_.push_back(displacement);
        if (times_.empty() || displacements_.size() != times_.size())
        {
            throw FatalInputError
            (
                dict.where("displacements"),
                dict.name() + " has " + std::to_string(times_.size()) + " times and " + std::to_string(displacements_.size()) + " displacements",
                "a displacement for each time, and one at the least"
            );
        }
        const auto later = std::adjacent_find(times_.begin(), times_.end(), [](double a, double b) { return !(a < b); });
        if (later != times_.end())
        {
            std::ostringstream found;
            found << "The times of " << dict.name() << " are not sorted: " << later[1] << " s follows " << later[0] << " s";
            throw FatalInputError(dict.where("times"), found.str(), "times that rise");
        }
        if (times_.front() != 0 || squaredLength(displacements_.front()) != 0)
        {
            std::ostringstream found;
            found << "The table of " << dict.name() << " begins at " << times_.front() << " s with " << str(displacements_.front()) << " m";
            throw FatalInputError(dict.where("times"), found.str(), "0 s and (0 0 0): the wall starts where it is");
        }
    }

protected:
    Pose after(double t) const override
    {
        const std::size_t k = std::upper_bound(times_.begin(), times_.end(), t) - times_.begin();
        if (k == times_.size()) return Pose::translation(displacements_.back());
        const double share = (t - times_[k - 1])/(times_[k] - times_[k - 1]);
        return Pose::translation(displacements_[k - 1] + share*(displacements_[k] - displacements_[k - 1]));
    }

private:
    std::vector<double> times_;             // s
    std::vector<Vector3> displacements_;    // m
};

static const WallMotionTable::Add<TableMotion> registered{"table", "displacements at times"};

}
