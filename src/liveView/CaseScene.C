// SPDX-License-Identifier: GPL-3.0-or-later
#include "liveView/CaseScene.H"

#include "caseFiles/AnalyticSurface.H"
#include "caseFiles/CaseGravity.H"
#include "caseFiles/LiquidFiles.H"
#include "caseFiles/SolidParticles.H"
#include "core/messages/Error.H"
#include "wallMotions/WallMotions.H"

#include <utility>

namespace shizuku
{

namespace
{

constexpr double flatAngle = 180;                       // degrees

// null for a wall with a distribution, or none. Angles that are wrong are refused elsewhere.
std::string thetaText(const Dictionary& wettability, const std::string& wall)
{
    if (!wettability.isDict(wall)) return "null";
    const Dictionary dict = wettability.subDict(wall);
    if (!dict.found("theta") || dict.isDict("theta")) return "null";
    try { return jsonNumber(dict.lookup<double>("theta")); }
    catch (const FatalInputError&) { return "null"; }
}

std::string wallText(const AnalyticSurface& wall, const std::string& theta)
{
    std::string text = "{\"name\":" + jsonText(wall.name) + ",\"type\":" + jsonText(typeName(wall.type)) + ",\"theta\":" + theta;
    switch (wall.type)
    {
        case AnalyticSurface::Type::box: text += ",\"low\":" + jsonVector(wall.min) + ",\"high\":" + jsonVector(wall.max); break;
        case AnalyticSurface::Type::plane: text += ",\"point\":" + jsonVector(wall.point) + ",\"direction\":" + jsonVector(wall.direction); break;
        case AnalyticSurface::Type::cylinder: text += ",\"direction\":" + jsonVector(wall.direction); [[fallthrough]];
        case AnalyticSurface::Type::sphere:
            text += ",\"point\":" + jsonVector(wall.point) + ",\"radius\":" + jsonNumber(wall.radius)
                + ",\"inside\":" + (wall.liquidInside ? "true" : "false");
    }
    return text + "}";
}

std::string wallsText(const std::filesystem::path& casePath, double time)
{
    if (!std::filesystem::exists(casePath/"constant/walls")) return "[]";
    const auto angles = casePath/"constant/wettability";
    const Dictionary wettability = std::filesystem::exists(angles) ? Dictionary::read(angles) : Dictionary();
    std::string text = "[";
    const char* separator = "";
    for (const AnalyticSurface& wall : readAnalyticSurfaces(casePath, time))
    {
        text += std::exchange(separator, ",") + wallText(wall, thetaText(wettability, wall.name));
    }
    return text + "]";
}

}

std::string sceneText(const std::filesystem::path& casePath, double time, const std::string& more)
{
    std::string text = "{\"kind\":\"scene\",\"case\":" + jsonText(casePath.filename().string()) + ",\"spacing\":" + jsonNumber(readSpacing(casePath))
        + ",\"gravity\":" + jsonVector(caseGravity(casePath)) + ",\"walls\":" + wallsText(casePath, time);
    return text + (more.empty() ? "" : ",") + more + "}";
}

std::string movedWallsText(const std::filesystem::path& casePath, double time)
{
    return WallMotions::read(casePath).none() ? "" : wallsText(casePath, time);
}

bool solidMoves(const std::filesystem::path& casePath)
{
    return useSolidParticles(casePath) && haveSolidParticles(casePath) && !WallMotions::read(casePath).none();
}

std::string solidMessage(const std::filesystem::path& casePath, double time, const std::vector<double>& theta, std::size_t limit)
{
    ViewFrame frame;
    frame.kind = "solid";
    frame.spacing = readSpacing(casePath);
    frame.most = flatAngle;
    frame.unit = "deg";
    if (useSolidParticles(casePath) && haveSolidParticles(casePath)) frame.positions = readSolidParticles(casePath, time).positions;
    if (theta.size() == frame.positions.size()) frame.values = theta;
    return encodeFrame(frame, limit);
}

}
