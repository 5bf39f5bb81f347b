// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/FieldFile.H"
#include "support/ScratchFolder.H"

#include <ctime>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <limits>
#include <random>

using namespace shizuku;
using namespace shizuku::test;
namespace fs = std::filesystem;

namespace
{

const std::string header = "FoamFile { version 2.0; format ascii; class vectorField; object U; }\n";
const std::string velocity = "dimensions [0 1 -1 0 0 0 0];\n";

// Floats of every magnitude and sign, the smallest and largest ones too.
std::vector<float> manyFloats(std::size_t size)
{
    std::mt19937 generator(7);
    std::uniform_int_distribution<std::uint32_t> bits;
    std::vector<float> values{0.0f, -0.0f, 0.1f, -1.0f / 3, 1e-45f, std::numeric_limits<float>::max(), 16777216.0f};
    while (values.size() < size)
    {
        const std::uint32_t pattern = bits(generator);
        float value;
        std::memcpy(&value, &pattern, sizeof value);
        if (std::isfinite(value)) values.push_back(value);
    }
    return values;
}

FieldData vectorField(std::vector<double> values)
{
    return {"U", FieldType::vector, dimensions::velocity, false, std::move(values)};
}

// What reading this text as the velocities of three particles says.
std::string errorOf(const std::string& text, long expected = -1)
{
    const ScratchFolder folder;
    const fs::path file = folder.write("U", text);
    return messageOf([&] { readField(file, FieldType::vector, dimensions::velocity, expected); });
}

std::string list(const std::string& value)
{
    return header + velocity + "internalField nonuniform List<vector> " + value;
}

// The whole of a binary file of scalars.
template<class T>
std::string binaryScalars(const std::string& arch, const std::vector<T>& values, std::size_t claimed)
{
    std::string text = "FoamFile { version 2.0; format binary; arch \"" + arch + "\"; class scalarField; object T; }\n"
        "dimensions [];\ninternalField nonuniform List<scalar> " + std::to_string(claimed) + "\n(";
    text.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    return text + ");\n";
}

FieldData readScalars(const ScratchFolder& folder, const std::string& text)
{
    return readField(folder.write("T", text), FieldType::scalar, dimensions::none);
}

}

// A spacing that is not the case's is refused, one that differs by less than its nine digits is not, nor is none.
TEST(FieldFile, KeepsTheSpacingOfParticles)
{
    const ScratchFolder folder;
    FieldData field = vectorField({1, 2, 3, 4, 5, 6});
    for (const bool binary : {false, true})
    {
        for (const bool uniform : {false, true})
        {
            field.uniform = uniform;
            field.values.resize(uniform ? 3 : 6);
            for (const double spacing : {0.0, 1.28e-4, 1e-3/3})
            {
                field.spacing = spacing;
                writeField(folder.path()/"U", field, {binary});
                EXPECT_NEAR(readField(folder.path()/"U").spacing, spacing, 1e-9*spacing);
            }
        }
        field.values.resize(6);
    }
    EXPECT_NO_THROW(refuseOtherSpacing("U", 0, 1e-4));
    EXPECT_NO_THROW(refuseOtherSpacing("U", 1.00000001e-4, 1e-4));
    EXPECT_NE(messageOf([] { refuseOtherSpacing("U", 1.28e-4, 1e-4); }).find("a spacing of 0.000128 m"), std::string::npos);
}

TEST(FieldFile, KeepsEveryFloatBitwise)
{
    const auto floats = manyFloats(30000);
    const ScratchFolder folder;
    for (const bool binary : {false, true})
    {
        const fs::path file = folder.path() / "0.05/liquid/U";
        writeField(file, vectorField({floats.begin(), floats.end()}), {binary, 9});
        const FieldData field = readField(file, FieldType::vector, dimensions::velocity, 10000);
        EXPECT_EQ(field.name, "U");
        EXPECT_FALSE(field.uniform);
        ASSERT_EQ(field.values.size(), floats.size());
        std::vector<float> back(field.values.begin(), field.values.end());
        EXPECT_EQ(std::memcmp(back.data(), floats.data(), floats.size() * sizeof(float)), 0) << "binary: " << binary;
    }
}

// Of 64 bits, beside labels of 32; what overflows a float too.
TEST(FieldFile, KeepsEveryDoubleWhereNumbersHave64Bits)
{
    const std::vector<double> doubles{0.1, -1.0 / 3, 1e300, 5e-324, 0, -0.0};
    const ScratchFolder folder;
    const fs::path file = folder.path() / "0.05/liquid/U";
    for (const WriteFormat& format : {WriteFormat{true, 9, 64}, WriteFormat{false, 17, 64}})
    {
        writeField(file, vectorField(doubles), format);
        const FieldData field = readField(file, FieldType::vector, dimensions::velocity, 2);
        EXPECT_EQ(std::memcmp(field.values.data(), doubles.data(), sizeof(double) * doubles.size()), 0) << "binary: " << format.binary;
        EXPECT_EQ(bool(holds(folder.read("0.05/liquid/U"), {"LSB;label=32;scalar=64"})), format.binary);
    }
}

TEST(FieldFile, KeepsEveryLabel)
{
    const std::vector<double> labels{0, -1, 42, 2147483647, -2147483647, 7};
    const ScratchFolder folder;
    for (const bool binary : {false, true})
    {
        writeField(folder.path() / "id", {"id", FieldType::label, dimensions::none, false, labels}, {binary, 9});
        EXPECT_EQ(readField(folder.path() / "id", FieldType::label, dimensions::none, 6).values, labels);
    }
}

TEST(FieldFile, WritesOpenFoamsSyntax)
{
    const ScratchFolder folder;
    writeField(folder.path() / "case/.0.05.partial/liquid/U", vectorField({0, 0.5, 1, -1, 1e-6, 1.0 / 3}), {false, 6});
    EXPECT_EQ
    (
        folder.read("case/.0.05.partial/liquid/U"),
        "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       vectorField;\n"
        "    location    \"0.05/liquid\";\n    object      U;\n}\n\n"
        "dimensions      [0 1 -1 0 0 0 0];\n\n"
        "internalField   nonuniform List<vector> 2\n(\n(0 0.5 1)\n(-1 1e-06 0.333333)\n);\n"
    );
}

TEST(FieldFile, TakesTypeAndDimensionsFromTheFileWhereAskedTo)
{
    const ScratchFolder folder;
    const fs::path file = folder.path() / "liquid/density";
    writeField(file, {"density", FieldType::scalar, dimensions::density, false, {998, 997.5}}, {false, 9});
    const FieldData field = readField(file, 2);
    EXPECT_EQ(field.type, FieldType::scalar);
    EXPECT_EQ(field.dimensions, dimensions::density);
    EXPECT_EQ(field.values, (std::vector<double>{998, 997.5}));
    EXPECT_TRUE(holds(messageOf([&] { readField(file, 3); }), {"2 elements", "3 elements"}));
    folder.write("tensors", "FoamFile { class tensorField; }\ndimensions [];\ninternalField uniform 1;");
    EXPECT_TRUE(holds(messageOf([&] { readField(folder.path() / "tensors"); }), {"tensorField", "vectorField"}));
}

// More elements than a reader takes at once, and a share that begins and ends within what it takes.
TEST(FieldFile, ReadsTheElementsThatAreChosen)
{
    constexpr std::size_t elements = 50000, first = 20001, end = 40003;
    std::vector<double> values;
    for (std::size_t k = 0; k < 3 * elements; ++k) values.push_back(double(k));
    const ScratchFolder folder;
    for (const bool binary : {false, true})
    {
        writeField(folder.path() / "U", vectorField(values), {.binary = binary, .scalarBits = 64});
        std::size_t asked = 0;
        const auto choose = [&](std::size_t n)
        {
            asked = n;
            return ElementRange{first, end};
        };
        const FieldData read = readField(folder.path() / "U", choose, FieldType::vector, dimensions::velocity, elements);
        EXPECT_EQ(asked, elements);
        EXPECT_EQ(read.values, std::vector<double>(values.begin() + 3 * first, values.begin() + 3 * end));
        EXPECT_TRUE(readField(folder.path() / "U", [](std::size_t n) { return ElementRange{n, n}; }).values.empty());
    }
    folder.write("U", header + velocity + "internalField uniform (1 2 3);\n");
    EXPECT_EQ(readField(folder.path() / "U", [](std::size_t) { return ElementRange{5, 9}; }).values, (std::vector<double>{1, 2, 3}));
}

// Shares of a field, written in any order, are the file of one process to the byte; one without elements adds nothing.
TEST(FieldFile, SharesMakeTheFileOfOneProcess)
{
    const ScratchFolder folder;
    std::vector<double> values;
    for (const float value : manyFloats(3*50000)) values.push_back(value);
    const std::size_t all = values.size()/3, ends[] = {0, 17, 17, 40000, all};
    for (const WriteFormat& format : {WriteFormat{}, WriteFormat{.binary = true}, WriteFormat{.binary = true, .scalarBits = 64}})
    {
        SCOPED_TRACE(format.binary ? format.scalarBits : 0);
        FieldData whole = vectorField(values);
        whole.spacing = 1e-3;
        writeField(folder.path()/"whole/U", whole, format);
        const auto share = [&](int k)
        {
            const auto fill = [&values, first = ends[k]](std::size_t from, std::span<double> some)
            {
                std::copy_n(values.begin() + long(3*(first + from)), some.size(), some.begin());
            };
            return SharedField{{FieldType::vector, dimensions::velocity, ends[k + 1] - ends[k], fill, 1e-3}, ends[k], all};
        };
        fs::create_directory(folder.path()/".whole.partial");           // files name their folder as it will be
        for (const int k : {3, 1, 0, 2})
        {
            std::uint64_t before = 0;
            for (int other = 0; other < k; ++other) before += bytesOf(share(other), format);
            writeShare(folder.path()/".whole.partial/U", share(k), before, format);
        }
        EXPECT_EQ(folder.read(".whole.partial/U"), folder.read("whole/U"));
        fs::remove_all(folder.path()/".whole.partial");
    }
}

TEST(FieldFile, AShareThatCannotBeWrittenNamesItsElement)
{
    const ScratchFolder folder;
    const auto fill = [](std::size_t, std::span<double> values) { values[4] = NAN; };
    const SharedField share{{FieldType::vector, dimensions::velocity, 2, fill}, 10, 12};
    EXPECT_TRUE(holds(messageOf<FatalError>([&] { writeShare(folder.path()/"U", share, 0, {}); }), {"of element 11 is not a finite number"}));
    EXPECT_TRUE(holds(messageOf<FatalError>([&] { writeShare(folder.path()/"none/U", share, 0, {}); }), {"none/U: No such file"}));
}

TEST(FieldFile, UniformFieldsHaveOneElement)
{
    const ScratchFolder folder;
    const fs::path file = folder.path() / "solid/theta";
    writeField(file, {"theta", FieldType::scalar, dimensions::none, true, {62.5}}, {true, 9});
    const FieldData theta = readField(file, FieldType::scalar, dimensions::none, 1000);
    EXPECT_TRUE(theta.uniform);
    EXPECT_EQ(theta.elements(), 1u);
    EXPECT_EQ(theta(999), 62.5);

    folder.write("U", header + velocity + "speed 2;\ninternalField uniform (0 $speed -1);\n");
    const FieldData field = readField(folder.path() / "U", FieldType::vector, dimensions::velocity, 1000);
    EXPECT_EQ(field.values, (std::vector<double>{0, 2, -1}));
    EXPECT_EQ(field(500, 1), 2);
}

TEST(FieldFile, ReadsWhatOpenFoamWrites)
{
    const auto values = [](const std::string& text)
    {
        const ScratchFolder folder;
        return readField(folder.write("U", text), FieldType::vector, dimensions::velocity).values;
    };
    const std::vector<double> expected{1, 2, 3, 4, 5, 6};
    EXPECT_EQ(values(list("2((1 2 3)(4 5 6));")), expected);
    EXPECT_EQ(values(list("2\n(\n// a comment\n( 1 +2 3.0e0 ) /* another */\n(4\t5\r\n6)\n)\n;\n// end\n")), expected);
    EXPECT_EQ(values(list("((1 2 3)(4 5 6));")), expected);
    EXPECT_EQ(values(list("2{(1 2 3)};")), (std::vector<double>{1, 2, 3, 1, 2, 3}));
    EXPECT_EQ(values(list("0();")), std::vector<double>());
    // Of the header's form with a comment banner; the keyword in a comment is none.
    EXPECT_EQ(values("/* internalField ; */\n" + list("1((1e-400 2 3));")), (std::vector<double>{0, 2, 3}));
}

TEST(FieldFile, ReadsBothWidthsOfBinaryFiles)
{
    const ScratchFolder folder;
    const std::vector<double> wide{1.0 / 3, -1e-300, 5};
    EXPECT_EQ(readScalars(folder, binaryScalars("LSB;label=64;scalar=64", wide, 3)).values, wide);
    const std::vector<float> narrow{0.1f, -2.0f, 1e-30f};
    EXPECT_EQ
    (
        readScalars(folder, binaryScalars("LSB;label=32;scalar=32", narrow, 3)).values,
        std::vector<double>(narrow.begin(), narrow.end())
    );

    const std::int64_t labels[] = {-5, 1L << 40};
    std::string text = "FoamFile { format binary; arch \"LSB;label=64;scalar=32\"; class labelField; }\n"
        "dimensions [0 0 0 0 0 0 0];\ninternalField nonuniform List<label> 2(";
    text.append(reinterpret_cast<const char*>(labels), sizeof labels).append(");\n");
    const FieldData field = readField(folder.write("id", text), FieldType::label, dimensions::none);
    EXPECT_EQ(field.values, (std::vector<double>{-5, 1099511627776.0}));
}

TEST(FieldFile, RefusesWrongHeaders)
{
    EXPECT_TRUE
    (
        holds(messageOf([] { readField("no/U", FieldType::vector, dimensions::velocity); }), {"missing", "no/U"})
    );
    EXPECT_TRUE
    (
        holds
        (
            errorOf("FoamFile { class scalarField; }\n" + velocity + "internalField uniform 1;"),
            {"scalarField", "vectorField", "line 1"}
        )
    );
    EXPECT_TRUE
    (
        holds
        (
            errorOf(header + "dimensions [0 1 0 0 0 0 0];\ninternalField uniform (0 0 0);"),
            {"[0 1 0 0 0 0 0]", "[0 1 -1 0 0 0 0]", "line 2"}
        )
    );
    EXPECT_TRUE(holds(errorOf(header + "internalField uniform (0 0 0);"), {"dimensions"}));
    EXPECT_TRUE(holds(errorOf(velocity + "internalField uniform (0 0 0);"), {"FoamFile"}));
    EXPECT_TRUE(holds(errorOf(header + velocity), {"internalField is missing"}));
    EXPECT_TRUE(holds(errorOf(header + velocity + "internalField constant 1;"), {"'constant'", "uniform", "line 3"}));
    EXPECT_TRUE
    (
        holds
        (
            errorOf(header + velocity + "boundaryField {}\ninternalField uniform (0 0 0);"),
            {"boundaryField", "line 3"}
        )
    );
    EXPECT_TRUE
    (
        holds
        (
            errorOf(header + velocity + "internalField nonuniform List<scalar> 1(1);"),
            {"List<scalar>", "List<vector>", "line 3"}
        )
    );
}

TEST(FieldFile, RefusesWrongUniformValues)
{
    const auto uniform = [](const std::string& value) { return header + velocity + "internalField uniform " + value; };
    EXPECT_TRUE(holds(errorOf(uniform("1;")), {"internalField", "line 3"}));
    EXPECT_TRUE(holds(errorOf(uniform("(0 nan 0);")), {"line 3"}));
    EXPECT_TRUE(holds(errorOf(uniform("(0 1 0) 5;")), {"5", "line 3"}));
    EXPECT_TRUE(holds(errorOf(uniform("(0 1 0)")), {"line 3"}));
}

// What it would escape is not there; reading goes no farther.
TEST(FieldFile, ABackslashAtTheEndOfTheFileIsItsEnd)
{
    EXPECT_NE(errorOf("FoamFile { class vectorField; note \"cut\\"), "no error");
}

TEST(FieldFile, RefusesWrongLists)
{
    EXPECT_TRUE(holds(errorOf(list("3\n(\n(1 2 3)\n(1 2 3)\n);")), {"has 2 elements", "the 3 that", "line 7"}));
    EXPECT_TRUE(holds(errorOf(list("1((1 2 3)(1 2 3));")), {"has 2 elements", "the 1 that"}));
    EXPECT_TRUE(holds(errorOf(list("1((1 2 3));"), 3), {"has 1 elements", "3 elements", "line 3"}));
    EXPECT_TRUE(holds(errorOf(list("((1 2 3));"), 3), {"has 1 elements", "3 elements"}));
    EXPECT_TRUE(holds(errorOf(list("2\n(\n(1 2 3)\n(1 nan 3)\n);")), {"element 1", "NaN", "line 6"}));
    EXPECT_TRUE(holds(errorOf(list("1((1 -inf 3));")), {"element 0", "infinite", "line 3"}));
    EXPECT_TRUE(holds(errorOf(list("1((1 1e999 3));")), {"element 0", "infinite"}));
    EXPECT_TRUE(holds(errorOf(list("2\n(\n(1 2 3)\n(1 2)\n);")), {"Found ')'", "a number for element 1", "line 6"}));
    EXPECT_TRUE(holds(errorOf(list("1((1 2 3 4));")), {"Found '4'", "three components of element 0"}));
    EXPECT_TRUE(holds(errorOf(list("1((1 2x 3));")), {"Found 'x'", "element 0"}));
    EXPECT_TRUE(holds(errorOf(list("2((1 2 3) 4);")), {"Found '4'", "vector of element 1"}));
    EXPECT_TRUE(holds(errorOf(list("-2((1 2 3));")), {"length -2"}));
    EXPECT_TRUE(holds(errorOf(list("many((1 2 3));")), {"'many'", "number of elements"}));
    EXPECT_TRUE(holds(errorOf(list("2((1 2 3)\n(1 2")), {"file ends", "line 4"}));
    EXPECT_TRUE(holds(errorOf(list("1((1 2 3))")), {"file ends", "';'"}));
    EXPECT_TRUE(holds(errorOf(list("1((1 2 3));\n\nmore 1;")), {"Found 'more'", "end of the file", "line 5"}));
    // A length that is a lie asks for no memory before the file is found to be short.
    EXPECT_TRUE(holds(errorOf(list("4000000000000((1 2 3));")), {"has 1 elements"}));
    EXPECT_TRUE(holds(errorOf(list("4000000000000{(1 2 3)};")), {"has 4000000000000 equal elements", "at most 1000000", "line 3"}));
    EXPECT_EQ(errorOf(list("1000000{(1 2 3)};")), "no error");

    const ScratchFolder folder;
    const fs::path id = folder.write
    (
        "id", "FoamFile { class labelField; }\ndimensions [];\ninternalField nonuniform List<label> 2(1 2.5);"
    );
    EXPECT_TRUE
    (
        holds
        (
            messageOf([&] { readField(id, FieldType::label, dimensions::none); }),
            {"'2.5'", "an integer for element 1"}
        )
    );
}

TEST(FieldFile, RefusesWrongBinaryLists)
{
    const ScratchFolder folder;
    const auto errorOfScalars = [&](const std::string& text)
    {
        return messageOf([&] { readScalars(folder, text); });
    };
    const std::vector<float> values{1, 2, 3, 4};
    const std::string arch = "LSB;label=32;scalar=32";
    const std::string whole = binaryScalars(arch, values, 4);
    EXPECT_EQ(readScalars(folder, whole).elements(), 4u);
    // Three bytes of the last number are gone, with the ");\n" behind it.
    EXPECT_TRUE
    (
        holds
        (
            errorOfScalars(whole.substr(0, whole.size() - 6)),
            {"truncated", "element 3", "4 elements of 4 bytes", "line 3"}
        )
    );
    EXPECT_TRUE
    (
        holds(errorOfScalars(binaryScalars(arch, values, 3)), {"does not end behind its 3 elements", "line 3"})
    );
    EXPECT_TRUE(holds(errorOfScalars(binaryScalars(arch, values, 4000000000000)), {"truncated"}));
    EXPECT_TRUE(holds(errorOfScalars(binaryScalars("LSB;label=32;scalar=64", values, 4)), {"truncated", "8 bytes"}));
    EXPECT_TRUE(holds(errorOfScalars(binaryScalars("MSB;label=32;scalar=32", values, 4)), {"MSB", "\"LSB;", "line 1"}));
    EXPECT_TRUE
    (
        holds(errorOfScalars("FoamFile { format binary; class scalarField; }\ndimensions [];\n"
            "internalField nonuniform List<scalar> 1(abcd);"), {"arch"})
    );
    const std::vector<float> bad{1, 2, std::numeric_limits<float>::quiet_NaN()};
    EXPECT_TRUE(holds(errorOfScalars(binaryScalars(arch, bad, 3)), {"element 2", "NaN", "line 4"}));
    EXPECT_TRUE(holds(errorOfScalars(whole + "more"), {"Found 'more'", "end of the file"}));
}

TEST(FieldFile, WritesNothingThatCouldNotBeRead)
{
    const ScratchFolder folder;
    const fs::path file = folder.path() / "U";
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto errorOfWriting = [&](const FieldData& field, bool binary = false)
    {
        return messageOf<FatalError>([&] { writeField(file, field, {binary, 9}); });
    };
    EXPECT_TRUE(holds(errorOfWriting(vectorField({0, 0, 0, 0, nan, 0})), {file.string(), "element 1", "finite"}));
    EXPECT_TRUE(holds(errorOfWriting(vectorField({0, 0, 1e300}), true), {"element 0", "finite"}));
    EXPECT_TRUE
    (
        holds
        (
            errorOfWriting({"id", FieldType::label, dimensions::none, false, {1, 3e9}}),
            {"element 1", "32-bit label"}
        )
    );
    EXPECT_EQ(folder.list(), std::vector<std::string>());
}

// Ten times the vectors take ten times the processor's time; a hundred times where the work is that of pairs. Processor time is little disturbed by
// what else runs, and three times the expected leaves room for caches.
TEST(FieldFile, WorkGrowsWithTheElements)
{
    struct Cost { double writing, reading; };
    const auto costOf = [](long elements)
    {
        const auto floats = manyFloats(3*elements);
        const FieldData field = vectorField({floats.begin(), floats.end()});
        const ScratchFolder folder;
        const std::clock_t start = std::clock();
        writeField(folder.path() / "U", field, {false, 9});
        const std::clock_t written = std::clock();
        const FieldData back = readField(folder.path() / "U", FieldType::vector, dimensions::velocity, elements);
        EXPECT_EQ(back.elements(), std::size_t(elements));
        return Cost{double(written - start), double(std::clock() - written)};
    };
    const Cost few = costOf(100000), many = costOf(1000000);
    EXPECT_LT(many.writing, 30*few.writing);
    EXPECT_LT(many.reading, 30*few.reading);
}
