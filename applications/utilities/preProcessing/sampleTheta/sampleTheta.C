// SPDX-License-Identifier: GPL-3.0-or-later
// Gives every solid particle its contact angle: constant/wettability -> 0/solid/theta.

#include "core/arguments/runApplication.H"
#include "core/time/Controls.H"
#include "core/time/Time.H"
#include "thetaModels/ThetaField.H"

#include <algorithm>
#include <iostream>

using namespace shizuku;

namespace
{

const ApplicationInfo info
{
    "sampleTheta", "Give each solid particle the contact angle of its patch (constant/wettability to 0/solid/theta).", {}
};

void report(const SolidParticles& solid, const std::vector<double>& theta)
{
    for (std::size_t patch = 0; patch < solid.patches.size(); ++patch)
    {
        std::size_t count = 0;
        double low = 180, high = 0;
        for (std::size_t i = 0; i < theta.size(); ++i)
        {
            if (solid.patch[i] != static_cast<int>(patch)) continue;
            ++count;
            low = std::min(low, theta[i]);
            high = std::max(high, theta[i]);
        }
        std::cout << solid.patches[patch] << ": " << count << " particles";
        if (count > 0) std::cout << ", theta " << low << " to " << high << " degrees";
        std::cout << "\n";
    }
}

// A run whose angles were changed while it went on writes them to its times, and goes on from these with them.
void warnOfLaterTheta(const std::filesystem::path& casePath)
{
    std::string names;
    for (const TimeFolder& folder : timeFolders(casePath))
    {
        if (folder.value > 0 && std::filesystem::exists(folder.path/"solid/theta")) names += (names.empty() ? "" : ", ") + folder.name;
    }
    if (names.empty()) return;
    warning
    (
        "Later times hold contact angles of their own, which a run that starts there takes, and what looks at them: " + names
      + ".\n    Remove their solid/theta, or the times, if those of 0 shall count there"
    );
}

void run(const Arguments& args)
{
    const std::filesystem::path& casePath = args.casePath();
    const WriteFormat format = readControls(Dictionary::read(casePath/"system"/"controlDict")).format;
    const Dictionary walls = Dictionary::read(casePath/"constant"/"walls");
    const std::vector<AnalyticSurface> analytic = readAnalyticSurfaces(walls);
    const bool sampled = useSolidParticles(casePath);
    if (!sampled && analytic.empty())
    {
        std::cout << "The case has no walls: there is nothing to do\n";
        return;
    }
    if (sampled && !haveSolidParticles(casePath))
    {
        throw FatalInputError
        (
            {(casePath/"constant"/"solid").string(), 0}, "The case has no solid particles", "run sampleSurface first"
        );
    }

    const SolidParticles solid = sampled ? readSolidParticles(casePath) : SolidParticles();
    const std::vector<double> theta =
        thetaField(solid, analytic, Dictionary::read(casePath/"constant"/"wettability"), casePath);
    if (!sampled)
    {
        std::cout << "No wall is sampled with particles: the contact angles are in order, there is nothing to write\n";
        return;
    }
    if (const std::string text = otherSurfaces(casePath); !text.empty()) warning(text);
    report(solid, theta);
    writeTheta(casePath/"0", theta, format);
    std::cout << "Wrote 0/solid/theta\n";
    warnOfLaterTheta(casePath);
}

}

int main(int argc, char** argv)
{
    return runApplication(argc, argv, info, run);
}
