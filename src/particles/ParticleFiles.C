// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/ParticleFiles.H"

#include "core/dictionary/Dictionary.H"
#include "core/fieldFile/AtomicFile.H"
#include "core/fieldFile/FieldReader.H"
#include "core/fieldFile/FoamFileHeader.H"
#include "core/messages/Error.H"
#include "device/ForEach.H"
#include "parallel/AllParts.H"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace shizuku
{

namespace
{

FieldType typeOf(const AnyBuffer& values)
{
    if (std::holds_alternative<Buffer<Vec3>>(values) || std::holds_alternative<Buffer<Position>>(values)) return FieldType::vector;
    if (std::holds_alternative<Buffer<scalar>>(values)) return FieldType::scalar;
    return FieldType::label;
}

// What is too large, scaled: numbers that single precision cannot hold, nor the square of; places that are not told apart.
template<class T>
constexpr double mostOf(T) { return 1e15; }
constexpr double mostOf(Position) { return 0.99 * quanta::farthest; }

void refuseLarge
(
    const std::filesystem::path& file, std::size_t first, std::span<const double> values, int components, double unit, double most
)
{
    const double largest = most * unit;
    const auto bad = std::find_if(values.begin(), values.end(), [&](double value) { return !(std::abs(value) < largest); });
    if (bad == values.end()) return;
    std::ostringstream text;
    text << "The value " << *bad << " of element " << first + (bad - values.begin()) / components
         << " is too large for the spacing and the liquid";
    throw FatalInputError({file.string(), 0}, text.str(), "SI values here, and for spacing, rho and sigma too");
}

Vec3 scaled(const double* si, double unit, Vec3)
{
    return {scalar(si[0] / unit), scalar(si[1] / unit), scalar(si[2] / unit)};
}

Position scaled(const double* si, double unit, Position) { return positionAt(si[0] / unit, si[1] / unit, si[2] / unit); }

scalar scaled(const double* si, double unit, scalar) { return scalar(*si / unit); }

std::uint32_t scaled(const double* label, double, std::uint32_t) { return std::uint32_t(*label); }

template<class T>
void upload(Buffer<T>& values, const FieldReader& reader, const std::filesystem::path& file, const ElementRange& share, double unit)
{
    const int components = componentsOf(reader.type());
    std::vector<T> host;
    reader.read(share, [&](std::size_t first, std::span<const double> portion)
    {
        if (reader.type() != FieldType::label) refuseLarge(file, first, portion, components, unit, mostOf(T{}));
        host.resize(portion.size() / components);
        for (std::size_t i = 0; i < host.size(); ++i) host[i] = scaled(&portion[i * components], unit, T{});
        values.upload(host, int(first - share.first));
    });
}

std::filesystem::path numbersFile(const std::filesystem::path& timeFolder, const std::string& set)
{
    return timeFolder / "uniform" / set;
}

void readNumbers(ParticleSet& particles, const std::filesystem::path& file)
{
    if (!std::filesystem::exists(file)) return;
    const Dictionary dict = Dictionary::read(file);
    for (const std::string& name : dict.keys()) particles.setNumber(name, dict.lookup<double>(name));
}

void writeNumbers(const std::map<std::string, double>& numbers, const std::filesystem::path& file)
{
    writeAtomically(file, [&](std::ostream& stream)
    {
        writeFoamFileHeader(stream, file, "dictionary");
        stream.precision(std::numeric_limits<double>::max_digits10);
        for (const auto& [name, value] : numbers) stream << name << ' ' << value << ";\n";
    });
}

struct Number
{
    std::uint32_t first;
    Span<std::uint32_t> number;

    HOST_DEVICE void operator()(int i) const { number[i] = first + std::uint32_t(i); }
};

}

std::size_t readParticles(ParticleSet& particles, const Units& units, const std::filesystem::path& folder)
{
    const std::filesystem::path positionFile = folder / "positions";
    const FieldReader positions(positionFile, FieldType::vector, dimensions::length);
    const auto refuse = [&](const std::string& found, const std::string& expected)
    {
        throw FatalInputError({positionFile.string(), 0}, found, expected);
    };
    if (positions.uniform())
    {
        refuse
        (
            "All particles are at the same place: the field is uniform",
            "internalField nonuniform List<vector> ..., one position a particle"
        );
    }
    if (particles.ownSpacing() > 0) refuseOtherSpacing(positionFile, positions.spacing(), particles.ownSpacing());
    constexpr std::size_t most = std::numeric_limits<int>::max();
    if (positions.elements() > most)
    {
        refuse("There are " + std::to_string(positions.elements()) + " particles", std::to_string(most) + " at most");
    }
    const std::size_t n = positions.elements();
    const auto [first, end] = shareOf(particles.parts(), n);
    const ElementRange share{first, end};
    particles.resize(int(end - first));
    for (const auto& entry : particles.fields().entries())
    {
        const FieldInfo& info = entry->info;
        if (!info.restarted) continue;
        const auto file = folder / info.name;
        if (info.name == "id" && !std::filesystem::exists(file))
        {
            forEach(particles.owned(), Number{std::uint32_t(first), std::get<Buffer<std::uint32_t>>(entry->values).span()});
            continue;
        }
        if (!info.begins && !std::filesystem::exists(file)) continue;
        const auto read = [&](const FieldReader& reader)
        {
            std::visit([&](auto& values) { upload(values, reader, file, share, units.of(info.dimensions)); }, entry->values);
        };
        if (info.name == "positions") read(positions);
        else read(FieldReader(file, typeOf(entry->values), info.dimensions, long(n)));
    }
    readNumbers(particles, numbersFile(folder.parent_path(), particles.name()));
    return n;
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

void fill(const HostBuffer<Position>& host, double unit, std::size_t first, std::span<double> values)
{
    for (std::size_t i = 0; i < values.size(); i += 3)
    {
        const Place at = placeOf(host.data()[first + i / 3]);
        values[i] = quanta::lengthOf(at.x) * unit;
        values[i + 1] = quanta::lengthOf(at.y) * unit;
        values[i + 2] = quanta::lengthOf(at.z) * unit;
    }
}

template<class T>
void fill(const HostBuffer<T>& host, double unit, std::size_t first, std::span<double> values)
{
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = host.data()[first + i] * unit;
}

template<class T>
HostBuffer<T>& hostBufferOf(AnyHostBuffer& any)
{
    if (!std::holds_alternative<HostBuffer<T>>(any)) any = HostBuffer<T>();
    return std::get<HostBuffer<T>>(any);
}

}

// copy(values, host buffer) of each field that is written.
template<class Copy>
void ParticleCopy::takeFields(const ParticleSet& particles, const Units& units, const Copy& copy)
{
    name_ = particles.name();
    numbers_ = particles.numbers();
    spacing_ = particles.ownSpacing();
    std::size_t taken = 0;
    for (const auto& entry : particles.fields().entries())
    {
        if (!entry->info.written) continue;
        if (taken == fields_.size()) fields_.emplace_back();
        Field& field = fields_[taken++];
        field.info = entry->info;
        field.unit = units.of(entry->info.dimensions);
        std::visit([&]<class T>(const Buffer<T>& values) { copy(values, hostBufferOf<T>(field.values)); }, entry->values);
    }
    fields_.resize(taken);
}

void ParticleCopy::take(const ParticleSet& particles, const Units& units)
{
    count_ = all_ = particles.owned();
    takeFields(particles, units, [&]<class T>(const Buffer<T>& values, HostBuffer<T>& host)
    {
        host.resizeDiscarding(int(count_));
        values.download(host.data(), int(count_));
    });
}

void ParticleCopy::takeShare(const ParticleSet& particles, const Units& units, const FileOrder& order)
{
    count_ = order.count();
    first_ = order.first();
    all_ = order.all();
    parts_ = &order.parts();
    takeFields(particles, units, [&](const auto& values, auto& host) { order.bring(values, host); });
}

FieldSource ParticleCopy::sourceOf(const Field& field) const
{
    constexpr FieldType types[] = {FieldType::scalar, FieldType::vector, FieldType::label, FieldType::vector};     // as in AnyHostBuffer
    const auto portion = [&field](std::size_t first, std::span<double> values)
    {
        std::visit([&](const auto& host) { fill(host, field.unit, first, values); }, field.values);
    };
    return {types[field.values.index()], field.info.dimensions, count_, portion, field.info.name == "positions" ? spacing_ : 0};
}

WriteFormat ParticleCopy::formatOf(const Field& field, const WriteFormat& format) const
{
    if (std::holds_alternative<HostBuffer<Position>>(field.values)) return format.ofPlaces();
    WriteFormat ofScalars = format;
    ofScalars.scalarBits = 8 * sizeof(scalar);
    return ofScalars;
}

void ParticleCopy::write(const std::filesystem::path& timeFolder, const WriteFormat& format) const
{
    for (const Field& field : fields_) writeField(timeFolder / name_ / field.info.name, sourceOf(field), formatOf(field, format));
    if (!numbers_.empty()) writeNumbers(numbers_, numbersFile(timeFolder, name_));
}

std::function<void()> ParticleCopy::writingShare(const std::filesystem::path& timeFolder, const WriteFormat& format) const
{
    std::vector<std::uint64_t> before;          // bytes of the parts before this one, by field
    for (const Field& field : fields_)
    {
        const std::vector<std::uint64_t> bytes = parts_->gather(bytesOf(SharedField{sourceOf(field), first_, all_}, formatOf(field, format)));
        before.push_back(std::accumulate(bytes.begin(), bytes.begin() + parts_->part(), std::uint64_t(0)));
    }
    const bool isFirst = parts_->part() == 0;
    return [this, timeFolder, format, before, isFirst]
    {
        for (std::size_t k = 0; k < fields_.size(); ++k)
        {
            const Field& field = fields_[k];
            writeShare(timeFolder / name_ / field.info.name, {sourceOf(field), first_, all_}, before[k], formatOf(field, format));
        }
        if (isFirst && !numbers_.empty()) writeNumbers(numbers_, numbersFile(timeFolder, name_));
    };
}

// A copy that nobody writes from any more.
const std::shared_ptr<ParticleCopy>& ParticleWriter::unused()
{
    const auto isUnused = [](const std::shared_ptr<ParticleCopy>& copy) { return copy.use_count() == 1; };
    auto place = std::find_if(copies_.begin(), copies_.end(), isUnused);
    if (place == copies_.end()) place = copies_.insert(place, std::make_shared<ParticleCopy>());
    return *place;
}

std::function<void(const std::filesystem::path&)> ParticleWriter::copy
(
    const ParticleSet& particles, const Units& units, const WriteFormat& format
)
{
    const std::shared_ptr<ParticleCopy>& place = unused();
    place->take(particles, units);
    return [copy = std::shared_ptr<const ParticleCopy>(place), format](const std::filesystem::path& timeFolder)
    {
        copy->write(timeFolder, format);
    };
}

std::function<void()> ParticleWriter::copyShare
(
    const ParticleSet& particles, const Units& units, const FileOrder& order, const WriteFormat& format, const std::filesystem::path& timeFolder
)
{
    const std::shared_ptr<ParticleCopy>& place = unused();
    place->takeShare(particles, units, order);
    return [copy = std::shared_ptr<const ParticleCopy>(place), write = place->writingShare(timeFolder, format)] { write(); };
}

}
