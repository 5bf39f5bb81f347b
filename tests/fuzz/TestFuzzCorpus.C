// SPDX-License-Identifier: GPL-3.0-or-later
// Each file of the corpus, and some thousand mutations of it that are the same in every run, is taken or refused, at once. What this
// looks for in seconds tests/fuzz/Allrun looks for in hours.

#include "fuzz/FuzzTargets.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

using namespace shizuku::test;
namespace fs = std::filesystem;

namespace
{

using Random = std::mt19937;

std::vector<std::string> seedsOf(const FuzzTarget& target)
{
    std::vector<std::string> seeds;
    for (const auto& entry : fs::directory_iterator(fs::path(std::getenv("SHIZUKU_DIR"))/"tests/fuzz/corpus"/target.name))
    {
        std::ifstream file(entry.path(), std::ios::binary);
        seeds.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
    std::sort(seeds.begin(), seeds.end());
    return seeds;
}

std::size_t below(Random& random, std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random); }

// Bytes changed, taken out, doubled; a piece of another seed; what numbers and brackets go wrong with.
std::string mutated(std::string text, const std::vector<std::string>& seeds, Random& random)
{
    static const std::vector<std::string> pieces
    {
        "{", "}", "(", ")", "\"", ";", "$", "#", "/*", "-1", "0", "1e999", "nan", "4294967296", "9223372036854775807",
        "18446744073709551616", "99999999", std::string(1, '\0'), "\xff\xff\xff\xff", "\n", "#include \"x\"", "1{", "..."
    };
    for (std::size_t changes = 1 + below(random, 4); changes > 0; --changes)
    {
        const std::size_t at = below(random, text.size() + 1), length = below(random, 1 + std::min<std::size_t>(text.size() - at, 40));
        const std::string& other = seeds[below(random, seeds.size())];
        switch (below(random, 5))
        {
            case 0: text.replace(at, length, ""); break;
            case 1: text.insert(at, text.substr(at, length)); break;
            case 2: text.insert(at, other.substr(below(random, other.size() + 1), 40)); break;
            case 3: text.replace(at, std::min<std::size_t>(length, 8), pieces[below(random, pieces.size())]); break;
            default: if (at < text.size()) text[at] = char(below(random, 256));
        }
    }
    return text;
}

class Corpus : public testing::TestWithParam<FuzzTarget> {};

}

TEST_P(Corpus, IsTakenOrRefused)
{
    constexpr int mutations = 2000;
    constexpr double slow = 10;         // s, for one input: it takes below a millisecond
    const std::vector<std::string> seeds = seedsOf(GetParam());
    ASSERT_FALSE(seeds.empty());
    // A seed is a file as it should be.
    for (const std::string& seed : seeds) EXPECT_NO_THROW(GetParam().read(seed)) << seed;

    Random random(1);
    for (int i = 0; i < mutations; ++i)
    {
        const std::string text = mutated(seeds[i % seeds.size()], seeds, random);
        const auto start = std::chrono::steady_clock::now();
        EXPECT_NO_THROW(readOrRefuse(GetParam(), text)) << text;
        EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), slow) << text;
    }
}

INSTANTIATE_TEST_SUITE_P
(
    Readers, Corpus, testing::ValuesIn(fuzzTargets()), [](const testing::TestParamInfo<FuzzTarget>& info) { return info.param.name; }
);
