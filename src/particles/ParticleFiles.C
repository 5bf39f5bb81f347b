#include "particles/ParticleFiles.H"

#include "core/messages/Error.H"

#include <algorithm>
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

namespace
{

// Components of the elements from `first` on, in SI.
void fill(const HostBuffer<Vec3>& host, double unit, std::size_t first, std::span<double> values)
{
    const Vec3* vector = host.data() + first;
    for (std::size_t i = 0; i < values.size(); i += 3, ++vector)
    {
        values[i] = vector->x * unit;
        values[i + 1] = vector->y * unit;
        values[i + 2] = vector->z * unit;
    }
}

template<class T>
void fill(const HostBuffer<T>& host, double unit, std::size_t first, std::span<double> values)
{
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = host.data()[first + i] * unit;
}

}

void ParticleCopy::take(const ParticleSet& particles, const Units& units)
{
    name_ = particles.name();
    count_ = particles.owned();
    std::size_t taken = 0;
    for (const auto& entry : particles.fields().entries())
    {
        if (!entry->info.written) continue;
        if (taken == fields_.size()) fields_.emplace_back();
        Field& field = fields_[taken++];
        field.info = entry->info;
        field.unit = units.of(entry->info.dimensions);
        std::visit([&](const auto& values) { copy(values, field.values); }, entry->values);
    }
    fields_.resize(taken);
}

template<class T>
void ParticleCopy::copy(const Buffer<T>& values, AnyHostBuffer& target) const
{
    if (!std::holds_alternative<HostBuffer<T>>(target)) target = HostBuffer<T>();
    auto& host = std::get<HostBuffer<T>>(target);
    host.resizeDiscarding(count_);
    values.download(host.data(), count_);
}

void ParticleCopy::write(const std::filesystem::path& timeFolder, const WriteFormat& format) const
{
    constexpr FieldType types[] = {FieldType::scalar, FieldType::vector, FieldType::label};     // as in AnyHostBuffer
    for (const Field& field : fields_)
    {
        const auto portion = [&](std::size_t first, std::span<double> values)
        {
            std::visit([&](const auto& host) { fill(host, field.unit, first, values); }, field.values);
        };
        const FieldSource source{types[field.values.index()], field.info.dimensions, std::size_t(count_), portion};
        writeField(timeFolder / name_ / field.info.name, source, format);
    }
}

std::function<void(const std::filesystem::path&)> ParticleWriter::copy
(
    const ParticleSet& particles, const Units& units, const WriteFormat& format
)
{
    const auto unused = [](const std::shared_ptr<ParticleCopy>& copy) { return copy.use_count() == 1; };
    auto place = std::find_if(copies_.begin(), copies_.end(), unused);
    if (place == copies_.end()) place = copies_.insert(place, std::make_shared<ParticleCopy>());
    (*place)->take(particles, units);
    return [copy = std::shared_ptr<const ParticleCopy>(*place), format](const std::filesystem::path& timeFolder)
    {
        copy->write(timeFolder, format);
    };
}

}
