// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquidBodies/FilledBody.H"

#include "caseFiles/VectorField.H"

#include <algorithm>

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
    refuseTooMany(*body.shape, spacing, dict.where());
    body.positions = body.shape->fill(spacing, dict.where());
    return body;
}

// The number of particles before each body, and of all of them.
std::vector<std::size_t> particlesBefore(const std::vector<FilledBody>& bodies)
{
    std::vector<std::size_t> before{0};
    for (const FilledBody& body : bodies) before.push_back(before.back() + body.positions.size());
    return before;
}

// Components of a vector of each particle from `first` of all bodies on: vectorOf(body, x).
template<class VectorOf>
void fillVectors
(
    const std::vector<FilledBody>& bodies, const std::vector<std::size_t>& before, std::size_t first,
    std::span<double> values, const VectorOf& vectorOf
)
{
    std::size_t body = std::upper_bound(before.begin(), before.end(), first) - before.begin() - 1;
    for (std::size_t i = 0; i < values.size(); i += 3, ++first)
    {
        while (first >= before[body + 1]) ++body;
        const Vector3 v = vectorOf(body, bodies[body].positions[first - before[body]]);
        values[i] = v.x;
        values[i + 1] = v.y;
        values[i + 2] = v.z;
    }
}

void writeVelocities
(
    const std::filesystem::path& file, const std::vector<FilledBody>& bodies, const std::vector<std::size_t>& before, const WriteFormat& format
)
{
    const Vector3& first = bodies.front().velocity;
    const auto movesAlike = [&](const FilledBody& body) { return body.movesAsOne() && body.velocity == first; };
    if (std::all_of(bodies.begin(), bodies.end(), movesAlike))
    {
        FieldData field = toField("U", dimensions::velocity, {first});
        field.uniform = true;
        writeField(file, field, format);
        return;
    }
    std::vector<Vector3> centroids;
    for (const FilledBody& body : bodies) centroids.push_back(body.centroid());
    const auto fill = [&](std::size_t from, std::span<double> values)
    {
        fillVectors(bodies, before, from, values, [&](std::size_t body, const Vector3& x) { return bodies[body].velocityAt(x, centroids[body]); });
    };
    writeField(file, {FieldType::vector, dimensions::velocity, before.back(), fill}, format);
}

}

Vector3 FilledBody::centroid() const
{
    Vector3 centroid;
    for (const Vector3& x : positions) centroid += x/double(positions.size());
    return centroid;
}

Vector3 FilledBody::velocityAt(const Vector3& x, const Vector3& centroid) const
{
    return velocity + cross(angularVelocity, x - centroid) + shape->velocityAt(x);
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

void writeBodies
(
    const std::filesystem::path& folder, const std::vector<FilledBody>& bodies, double spacing, const WriteFormat& format
)
{
    const std::vector<std::size_t> before = particlesBefore(bodies);
    const auto fill = [&](std::size_t first, std::span<double> values)
    {
        fillVectors(bodies, before, first, values, [](std::size_t, const Vector3& x) { return x; });
    };
    writeField(folder/"positions", {FieldType::vector, dimensions::length, before.back(), fill, spacing}, format.ofPlaces());
    writeVelocities(folder/"U", bodies, before, format);
}

}
