// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/FieldRegistry.H"

#include "device/Device.H"
#include "particles/ParticleSet.H"

#include <gtest/gtest.h>

using namespace shizuku;

namespace
{

std::vector<scalar> xOf(const Buffer<Vec3>& field)
{
    std::vector<scalar> x;
    for (const Vec3& v : field.download()) x.push_back(v.x);
    return x;
}

}

TEST(FieldRegistry, ReordersWhatMovesWithItsParticle)
{
    FieldRegistry fields;
    fields.resize(4);
    auto& number = fields.add<scalar>({.name = "scalar", .dimensions = {}});
    auto& vector = fields.add<Vec3>({.name = "vector", .dimensions = {}});
    auto& label = fields.add<std::uint32_t>({.name = "label", .dimensions = {}});
    auto& scratch = fields.add<scalar>({.name = "scratch", .dimensions = {}, .sorted = false});
    auto& second = fields.add<scalar>({.name = "second", .dimensions = {}});
    number.upload({10, 11, 12, 13});
    vector.upload({{20, 0, 1}, {21, 0, 2}, {22, 0, 3}, {23, 0, 4}});
    label.upload({30, 31, 32, 33});
    scratch.upload({40, 41, 42, 43});
    second.upload({50, 51, 52, 53});

    fields.reorder(Buffer<std::uint32_t>(std::vector<std::uint32_t>{2, 0, 3, 1}));
    EXPECT_EQ(number.download(), (std::vector<scalar>{12, 10, 13, 11}));
    EXPECT_EQ(xOf(vector), (std::vector<scalar>{22, 20, 23, 21}));
    EXPECT_EQ(vector.download()[3].z, 2);
    EXPECT_EQ(label.download(), (std::vector<std::uint32_t>{32, 30, 33, 31}));
    EXPECT_EQ(scratch.download(), (std::vector<scalar>{40, 41, 42, 43}));
    EXPECT_EQ(second.download(), (std::vector<scalar>{52, 50, 53, 51}));
}

TEST(FieldRegistry, ReordersEveryStepWithoutAllocating)
{
    FieldRegistry fields;
    auto& a = fields.add<Vec3>({.name = "a", .dimensions = {}});
    auto& b = fields.add<Vec3>({.name = "b", .dimensions = {}});
    fields.resize(2);
    a.upload({{1, 0, 0}, {2, 0, 0}});
    b.upload({{3, 0, 0}, {4, 0, 0}});
    const Buffer<std::uint32_t> swap(std::vector<std::uint32_t>{1, 0});
    for (int i = 0; i < 3; ++i) fields.reorder(swap);
    const std::size_t bytes = deviceCounters().bytes;
    for (int i = 0; i < 4; ++i) fields.reorder(swap);
    EXPECT_EQ(deviceCounters().bytes, bytes);
    EXPECT_EQ(xOf(a), (std::vector<scalar>{2, 1}));
    EXPECT_EQ(xOf(b), (std::vector<scalar>{4, 3}));
}

TEST(FieldRegistry, SharesAFieldThatTwoModelsRequire)
{
    FieldRegistry fields;
    fields.resize(3);
    auto& first = fields.require<Vec3>({.name = "normal", .dimensions = {}});
    auto& again = fields.require<Vec3>({.name = "normal", .dimensions = {}});
    EXPECT_EQ(&first, &again);
    EXPECT_EQ(fields.entries().size(), 1u);
    EXPECT_EQ(fields.find("normal")->info.name, "normal");
    EXPECT_EQ(fields.find("absent"), nullptr);
}

TEST(FieldRegistry, FieldsOfNewParticlesAreZero)
{
    FieldRegistry fields;
    auto& early = fields.add<scalar>({.name = "early", .dimensions = {}});
    fields.resize(2);
    early.upload({7, 8});
    fields.resize(5);
    auto& late = fields.add<scalar>({.name = "late", .dimensions = {}});
    EXPECT_EQ(early.download(), (std::vector<scalar>{7, 8, 0, 0, 0}));
    EXPECT_EQ(late.download(), std::vector<scalar>(5, 0));
    fields.resize(1);
    fields.resize(3);
    EXPECT_EQ(early.download(), (std::vector<scalar>{7, 0, 0}));
}

TEST(ParticleSet, HasOwnedParticlesAndGhosts)
{
    ParticleSet particles("liquid");
    const auto& field = particles.fields().add<scalar>({.name = "a", .dimensions = {}});
    particles.resize(5, 2);
    EXPECT_EQ(particles.owned(), 5);
    EXPECT_EQ(particles.all() - particles.owned(), 2);
    EXPECT_EQ(particles.all(), 7);
    EXPECT_EQ(field.size(), 7);
}
