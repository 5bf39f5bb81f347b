#include "particles/ParticleFiles.H"

#include "core/messages/Error.H"

#include <cmath>
#include <numeric>
#include <sstream>

namespace shizuku
{

namespace
{

FieldType typeOf(const AnyBuffer& values)
{
    if (std::holds_alternative<Buffer<Vec3>>(values)) return FieldType::vector;
    if (std::holds_alternative<Buffer<float>>(values)) return FieldType::scalar;
    return FieldType::label;
}

void upload(AnyBuffer& values, const FieldData& data, const std::filesystem::path& file, int n, double unit)
{
    constexpr double most = 1e15;       // scaled; its square is a float still
    const auto scaled = [&](int i, int c = 0)
    {
        const double value = data(i, c) / unit;
        if (std::abs(value) < most) return float(value);
        std::ostringstream text;
        text << "The value " << data(i, c) << " of element " << i << " is too large for the spacing and the liquid";
        throw FatalInputError({file.string(), 0}, text.str(), "SI values here, and for spacing, rho and sigma too");
    };
    if (auto* scalars = std::get_if<Buffer<float>>(&values))
    {
        std::vector<float> host(n);
        for (int i = 0; i < n; ++i) host[i] = scaled(i);
        scalars->upload(host);
    }
    else if (auto* vectors = std::get_if<Buffer<Vec3>>(&values))
    {
        std::vector<Vec3> host(n);
        for (int i = 0; i < n; ++i) host[i] = {scaled(i, 0), scaled(i, 1), scaled(i, 2)};
        vectors->upload(host);
    }
    else
    {
        std::vector<std::uint32_t> host(n);
        for (int i = 0; i < n; ++i) host[i] = std::uint32_t(data(i));
        std::get<Buffer<std::uint32_t>>(values).upload(host);
    }
}

std::vector<double> download(const AnyBuffer& values, int n, double unit)
{
    std::vector<double> result;
    if (const auto* scalars = std::get_if<Buffer<float>>(&values))
    {
        const auto host = scalars->download();
        for (int i = 0; i < n; ++i) result.push_back(host[i] * unit);
    }
    else if (const auto* vectors = std::get_if<Buffer<Vec3>>(&values))
    {
        const auto host = vectors->download();
        result.reserve(3 * n);
        for (int i = 0; i < n; ++i)
        {
            for (const float component : {host[i].x, host[i].y, host[i].z}) result.push_back(component * unit);
        }
    }
    else
    {
        const auto host = std::get<Buffer<std::uint32_t>>(values).download();
        result.assign(host.begin(), host.begin() + n);
    }
    return result;
}

void numberParticles(AnyBuffer& values, int n)
{
    std::vector<std::uint32_t> numbers(n);
    std::iota(numbers.begin(), numbers.end(), 0u);
    std::get<Buffer<std::uint32_t>>(values).upload(numbers);
}

}

void readParticles(ParticleSet& particles, const Units& units, const std::filesystem::path& folder)
{
    const FieldData positions = readField(folder / "positions", FieldType::vector, dimensions::length);
    if (positions.uniform)
    {
        throw FatalInputError
        (
            {(folder / "positions").string(), 0}, "All particles are at the same place: the field is uniform",
            "internalField nonuniform List<vector> ..., one position a particle"
        );
    }
    const int n = int(positions.elements());
    particles.resize(n);
    for (const auto& entry : particles.fields().entries())
    {
        const FieldInfo& info = entry->info;
        if (!info.restarted) continue;
        const auto file = folder / info.name;
        if (info.name == "id" && !std::filesystem::exists(file))
        {
            numberParticles(entry->values, n);
            continue;
        }
        const FieldData data =
            info.name == "positions" ? positions : readField(file, typeOf(entry->values), info.dimensions, n);
        upload(entry->values, data, file, n, units.of(info.dimensions));
    }
}

void writeParticles
(
    const ParticleSet& particles, const Units& units, const std::filesystem::path& folder, const WriteFormat& format
)
{
    for (const auto& entry : particles.fields().entries())
    {
        const FieldInfo& info = entry->info;
        if (!info.written) continue;
        FieldData data;
        data.name = info.name;
        data.type = typeOf(entry->values);
        data.dimensions = info.dimensions;
        data.values = download(entry->values, particles.owned(), units.of(info.dimensions));
        writeField(folder / info.name, data, format);
    }
}

}
