#include "geometry/liquidBodies/FilledBody.H"

namespace shizuku
{

namespace
{

constexpr Dimensions perTime{{0, 0, -1, 0, 0, 0, 0}};

FilledBody readBody(const Dictionary& dict, const std::string& name, const std::filesystem::path& casePath, double spacing)
{
    FilledBody body{name, dict.where(), nullptr, {}, {}, {}};
    body.shape = LiquidBodyTable::New("liquid body", dict.lookup<std::string>("type"), dict.where("type"), dict, casePath);
    if (dict.found("velocity")) body.velocity = dict.lookupDimensionedVector("velocity", dimensions::velocity);
    if (dict.found("angularVelocity")) body.angularVelocity = dict.lookupDimensionedVector("angularVelocity", perTime);
    body.carve = dict.lookupChoiceOr("overlaps", {"refuse", "carve"}, "refuse") == "carve";
    body.positions = fillLattice(*body.shape, spacing, dict.where());
    return body;
}

}

std::vector<Vector3> FilledBody::velocities() const
{
    Vector3 centroid;
    for (const Vector3& x : positions) centroid += x/double(positions.size());
    std::vector<Vector3> result;
    for (const Vector3& x : positions) result.push_back(velocity + cross(angularVelocity, x - centroid));
    return result;
}

std::vector<FilledBody> readBodies
(
    const Dictionary& fillLiquidDict, const std::filesystem::path& casePath, double spacing
)
{
    const Dictionary bodies = fillLiquidDict.subDict("bodies");
    std::vector<FilledBody> result;
    for (const std::string& name : bodies.dictKeys())
    {
        result.push_back(readBody(bodies.subDict(name), name, casePath, spacing));
    }
    if (result.empty())
    {
        throw FatalInputError(bodies.where(), "There is no body of liquid", "drop { type sphere; ... }");
    }
    fillLiquidDict.refuseUnused();
    return result;
}

}
