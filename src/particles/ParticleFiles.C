#include "particles/ParticleFiles.H"

#include <numeric>

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

void upload(AnyBuffer& values, const FieldData& data, int n, double unit)
{
    const auto scaled = [&](int i, int c = 0) { return float(data(i, c) / unit); };
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
    const int n = int(positions.elements());
    particles.resize(n);
    for (const auto& entry : particles.fields().entries())
    {
        const FieldInfo& info = entry->info;
        if (!info.restarted) continue;
        const auto file = folder / info.name;
        const bool optional = info.name != "U";
        if (info.name == "positions")
        {
            upload(entry->values, positions, n, units.of(info.dimensions));
        }
        else if (!optional || std::filesystem::exists(file))
        {
            upload(entry->values, readField(file, typeOf(entry->values), info.dimensions, n), n, units.of(info.dimensions));
        }
        else if (info.name == "id")
        {
            numberParticles(entry->values, n);
        }
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
