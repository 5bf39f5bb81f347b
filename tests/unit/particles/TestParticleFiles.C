// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/ParticleFiles.H"

#include "parallel/PartsOfProcess.H"
#include "support/LiquidCase.H"

#include <algorithm>
#include <limits>
#include <numeric>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// Numbers of many sizes and signs: what 9 digits must bring back, or 17 in double precision.
std::vector<Vec3> awkwardVectors(int n, unsigned seed)
{
    RandomNumbers random(seed);
    const auto number = [&] { return std::exp(random(-15, 8)) * random(-1, 1); };
    std::vector<Vec3> vectors(n);
    for (Vec3& v : vectors)
    {
        v.x = number();
        v.y = number();
        v.z = number();
    }
    return vectors;
}

std::vector<Word> bitsOf(const std::vector<Vec3>& vectors)
{
    std::vector<Word> bits;
    for (const Vec3& v : vectors)
    {
        for (const scalar c : {v.x, v.y, v.z}) bits.push_back(wordOf(c));
    }
    return bits;
}

std::vector<std::array<std::int64_t, 3>> wordsOf(const Buffer<Position>& positions)
{
    std::vector<std::array<std::int64_t, 3>> words;
    for (const Position& p : positions.download())
    {
        const Place at = placeOf(p);
        words.push_back({at.x, at.y, at.z});
    }
    return words;
}

}

TEST(ParticleFiles, ReturnEveryBitInAsciiWithEnoughDigitsAndInBinary)
{
    constexpr int n = 500;
    LiquidCase original;
    original.liquid.resize(n);
    original.liquid.position.upload(placed(awkwardVectors(n, 1)));
    original.liquid.velocity.upload(awkwardVectors(n, 2));
    std::vector<std::uint32_t> id(n);
    for (int i = 0; i < n; ++i) id[i] = std::uint32_t(7919 * i % 500);
    original.liquid.id.upload(id);

    for (const bool binary : {false, true})
    {
        SCOPED_TRACE(binary ? "binary" : "ascii");
        const auto time = original.folder.path() / (binary ? "1" : "2");
        ParticleCopy written;
        written.take(original.liquid, original.liquid.units());
        written.write(time, {.binary = binary, .precision = std::numeric_limits<scalar>::max_digits10});

        Liquid copy(original.liquid.properties(), Dictionary());
        copy.read(time);
        EXPECT_EQ(copy.owned(), n);
        EXPECT_EQ(wordsOf(copy.position), wordsOf(original.liquid.position));
        EXPECT_EQ(bitsOf(copy.velocity.download()), bitsOf(original.liquid.velocity.download()));
        EXPECT_EQ(copy.id.download(), id);
    }
    EXPECT_EQ(original.folder.list("1/liquid"), (std::vector<std::string>{"U", "densityRatio", "id", "positions"}));
}

TEST(ParticleFiles, HoldSIValuesOfOwnedParticles)
{
    LiquidCase drop;
    drop.liquid.resize(2, 1);
    drop.liquid.position.upload(placed({{1, 0, 0}, {0, -3, 0}, {9, 9, 9}}));
    ParticleWriter().copy(drop.liquid, drop.liquid.units(), {})(drop.folder.path() / "1");
    const auto file = drop.folder.path() / "1/liquid/positions";
    const FieldData positions = readField(file, FieldType::vector, dimensions::length);
    ASSERT_EQ(positions.elements(), 2u);
    EXPECT_EQ(positions(0, 0), drop.liquid.units().length);         // powers of two, short enough for nine digits
    EXPECT_EQ(positions(1, 1), -3 * drop.liquid.units().length);
}

// Particles lie in any part; keys are shared by some of them, and numbers decide then. Parts without particles write as much as the others.
TEST(ParticleFiles, SharesOfPartsAreTheFilesOfOneProcess)
{
    constexpr int n = 2000;
    const std::vector<Vec3> places = awkwardVectors(n, 3), velocities = awkwardVectors(n, 4);
    const auto keyOf = [](int particle) { return std::uint32_t(particle) * 2654435761u >> 22; };
    const auto fill = [&](Liquid& liquid, const std::vector<std::uint32_t>& which)
    {
        std::vector<Vec3> x, u;
        for (const std::uint32_t i : which) x.push_back(places[i]), u.push_back(velocities[i]);
        liquid.resize(int(which.size()));
        liquid.position.upload(placed(x));
        liquid.velocity.upload(u);
        liquid.id.upload(which);
        liquid.number("age", 0) = 7;
    };
    LiquidCase whole;
    std::vector<std::uint32_t> all(n);
    std::iota(all.begin(), all.end(), 0u);
    std::sort(all.begin(), all.end(), [&](std::uint32_t a, std::uint32_t b) { return std::pair(keyOf(int(a)), a) < std::pair(keyOf(int(b)), b); });
    fill(whole.liquid, all);

    const ScratchFolder folder;
    for (const WriteFormat& format : {WriteFormat{}, WriteFormat{.binary = true}})
    {
        SCOPED_TRACE(format.binary);
        ParticleWriter().copy(whole.liquid, whole.liquid.units(), format)(folder.path() / "1");
        std::filesystem::create_directories(folder.path() / ".1.partial/liquid");
        runParts(4, [&](const Communicator& parts)
        {
            std::vector<std::uint32_t> own;             // part 2 has none
            for (int i = 0; i < n; ++i) if ((i % 7 + i / 1500) % 4 == parts.part() && parts.part() != 2) own.push_back(std::uint32_t(i));
            for (int i = 0; i < n; ++i) if ((i % 7 + i / 1500) % 4 == 2 && parts.part() == 0) own.push_back(std::uint32_t(i));
            LiquidCase part;
            fill(part.liquid, own);
            part.liquid.ghosts().join(parts);
            std::vector<std::uint32_t> keys;
            for (const std::uint32_t i : own) keys.push_back(keyOf(int(i)));
            const FileOrder order(parts, Buffer<std::uint32_t>(keys), part.liquid.id, part.liquid.owned());
            EXPECT_EQ(order.all(), std::size_t(n));
            EXPECT_EQ(order.count(), std::size_t(n / 4));
            EXPECT_EQ(order.first(), std::size_t(n / 4 * parts.part()));
            ParticleWriter writer;
            writer.copyShare(part.liquid, part.liquid.units(), order, format, folder.path() / ".1.partial")();
        });
        for (const std::string file : {"liquid/positions", "liquid/U", "liquid/id", "liquid/densityRatio", "uniform/liquid"})
        {
            EXPECT_EQ(folder.read(".1.partial/" + file), folder.read("1/" + file)) << file;
        }
        std::filesystem::remove_all(folder.path() / ".1.partial");
    }
}

TEST(ParticleFiles, NumberParticlesThatHaveNoId)
{
    LiquidCase drop;
    const FieldData vectors{.name = "positions", .type = FieldType::vector, .dimensions = dimensions::length,
                            .values = {1e-3, 0, 0, 2e-3, 0, 0, 3e-3, 0, 0}};
    FieldData speeds = vectors;
    speeds.name = "U";
    speeds.dimensions = dimensions::velocity;
    std::filesystem::create_directories(drop.folder.path() / "0/liquid");
    writeField(drop.folder.path() / "0/liquid/positions", vectors, {});
    EXPECT_TRUE(holds(messageOf([&] { drop.liquid.read(drop.folder.path() / "0"); }), {"liquid/U"}));

    writeField(drop.folder.path() / "0/liquid/U", speeds, {});
    drop.liquid.read(drop.folder.path() / "0");
    EXPECT_EQ(drop.liquid.id.download(), (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(placeOf(drop.liquid.position.download()[2]).x, quanta::wholeOf(3e-3 / drop.liquid.units().length));
    EXPECT_EQ(drop.liquid.density.download(), std::vector<scalar>(3, 0));
}

TEST(ParticleFiles, WriteTheMomentThatWasCopied)
{
    LiquidCase drop;
    ParticleWriter writer;
    const auto copyAt = [&](int n, scalar x)
    {
        drop.liquid.resize(n);
        drop.liquid.position.upload(placed(std::vector<Vec3>(n, Vec3{x, 0, 0})));
        return writer.copy(drop.liquid, drop.liquid.units(), {.binary = true});
    };
    const auto expect = [&](const std::string& time, std::size_t n, scalar x)
    {
        const FieldData positions = readField(drop.folder.path() / time / "liquid/positions");
        ASSERT_EQ(positions.elements(), n);
        EXPECT_EQ(positions(n - 1, 0), x * drop.liquid.units().length);
    };
    {
        // Several are kept apart, in whatever order they are written, while the liquid moves on.
        const auto first = copyAt(2, 1), second = copyAt(40000, 2);     // more than are written in one go
        copyAt(3, 3);
        second(drop.folder.path() / "2");
        first(drop.folder.path() / "1");
    }
    copyAt(5, 4)(drop.folder.path() / "4");
    expect("1", 2, 1);
    expect("2", 40000, 2);
    expect("4", 5, 4);
}

TEST(ParticleFiles, AUniformFieldIsTheValueOfEachParticle)
{
    constexpr int n = 40000;                        // more than are read in one go
    LiquidCase drop;
    const auto folder = drop.folder.path() / "0/liquid";
    FieldData positions{.name = "positions", .type = FieldType::vector, .dimensions = dimensions::length, .values = {}};
    for (int i = 0; i < 3 * n; ++i) positions.values.push_back(i * drop.liquid.units().length);
    const double unit = drop.liquid.units().of(dimensions::velocity);
    writeField(folder / "positions", positions, {.binary = true});
    writeField(folder / "U", {"U", FieldType::vector, dimensions::velocity, true, {0, 2 * unit, -unit}}, {.precision = 17});
    drop.liquid.read(drop.folder.path() / "0");
    const auto velocities = drop.liquid.velocity.download();
    const auto places = drop.liquid.position.download();
    for (int i = 0; i < n; ++i)
    {
        ASSERT_EQ(quanta::lengthOf(placeOf(places[i]).z), 3 * i + 2) << i;
        ASSERT_EQ(velocities[i].y, 2) << i;
        ASSERT_EQ(velocities[i].z, -1) << i;
    }
}

// 10 m from the origin at a spacing of 50 um single precision would keep a hundredth of a spacing.
TEST(ParticleFiles, KeepPlacesFarFromTheOrigin)
{
    LiquidCase drop({.spacing = 50e-6});
    const double unit = drop.liquid.units().length;
    std::vector<Position> far;
    for (int i = 0; i < 300; ++i)
    {
        const Position p = positionAt(10 / unit + i / 7.0, -10 / unit - i / 11.0, 150 / unit + i / 13.0);
        far.push_back(p);
    }
    drop.liquid.resize(int(far.size()));
    drop.liquid.position.upload(far);
    for (const bool binary : {false, true})
    {
        ParticleCopy written;
        written.take(drop.liquid, drop.liquid.units());
        written.write(drop.folder.path() / "1", {.binary = binary});
        Liquid copy(drop.liquid.properties(), Dictionary());
        copy.read(drop.folder.path() / "1");
        EXPECT_EQ(wordsOf(copy.position), wordsOf(drop.liquid.position));
    }
}
