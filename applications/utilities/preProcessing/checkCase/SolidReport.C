// SPDX-License-Identifier: GPL-3.0-or-later
#include "SolidReport.H"

#include "caseFiles/SolidParticles.H"
#include "meshes/ConnectedPoints.H"

#include <algorithm>
#include <iostream>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr double leastGap = 0.7, leastMeanGap = 0.75, mostMeanGap = 1.25, reach = 3;        // spacings

}

void reportSolid(const std::filesystem::path& casePath, double spacing, Findings& findings)
{
    const SolidParticles solid = readSolidParticles(casePath);
    const PointGaps gaps = measureGaps(solid.positions, reach * spacing);
    std::cout << "Solid: " << solid.positions.size() << " particles";
    for (std::size_t patch = 0; patch < solid.patches.size(); ++patch)
    {
        std::cout << (patch == 0 ? ", " : "; ") << solid.patches[patch] << " "
                  << std::count(solid.patch.begin(), solid.patch.end(), int(patch));
    }
    std::cout << "\n    gap to the nearest one: minimal " << gaps.least / spacing << ", mean " << gaps.mean / spacing
              << ", maximal " << gaps.most / spacing << " spacings; without one within 3 spacings " << gaps.alone << "\n";

    const double mean = gaps.mean / spacing;
    if (!(mean >= leastMeanGap && mean <= mostMeanGap))
    {
        std::ostringstream text;
        text << "The solid particles are " << mean << " spacings apart on average, not about 1: they were sampled at "
                "another spacing\n    run sampleSurface and sampleTheta again";
        findings.error(text.str());
    }
    else if (gaps.least < leastGap * spacing)
    {
        findings.warn("some solid particles are nearer to each other than 0.7 spacings: see what sampleSurface says");
    }
}

}
