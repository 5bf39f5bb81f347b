// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/LatestTime.H"
#include "support/ScratchFolder.H"

using namespace shizuku;
using namespace shizuku::test;
namespace fs = std::filesystem;

namespace
{

using Names = std::vector<std::string>;

// Folders 0, 0.333333 (one third exactly), 0.5, 1e-05 and 2, and some that are no times.
class Case : public ScratchFolder
{
public:
    Case()
    {
        write("system/controlDict", "");
        for (const char* name : {"0", "0.5", "1e-05", "2", "constant", "0.5old", ".0.7.partial", "-"})
        {
            fs::create_directories(path() / name);
        }
        write("3", "a file, no folder");
        writeTimeState(path() / "0.333333", {1.0 / 3, 4, 1.0 / 12, 0, 0});
    }

    Arguments arguments(std::vector<const char*> words) const
    {
        const std::string casePath = path().string();
        words.insert(words.begin(), {"tool", "-case", casePath.c_str()});
        return {static_cast<int>(words.size()), words.data(), {"tool", "", timeSelectionOptions()}};
    }

    Names select(const std::vector<const char*>& words) const { return namesOf(selectTimes(arguments(words))); }

    static Names namesOf(const std::vector<TimeFolder>& folders)
    {
        Names names;
        for (const TimeFolder& folder : folders) names.push_back(folder.name);
        return names;
    }

    std::string error(const std::vector<const char*>& words) const
    {
        return messageOf([&] { select(words); });
    }
};

}

TEST(TimeFolders, AreTheNumbersSortedByValue)
{
    const Case folder;
    const auto folders = timeFolders(folder.path());
    ASSERT_EQ(folders.size(), 5u);
    const std::vector<double> values{0, 1e-5, 1.0 / 3, 0.5, 2};     // a third in full, from uniform/time
    const Names names{"0", "1e-05", "0.333333", "0.5", "2"};
    for (int i = 0; i < 5; ++i)
    {
        EXPECT_EQ(folders[i].value, values[i]);
        EXPECT_EQ(folders[i].name, names[i]);
        EXPECT_EQ(folders[i].path, folder.path() / names[i]);
    }
}

TEST(TimeFolders, AreSelectedByOptions)
{
    const Case folder;
    EXPECT_EQ(folder.select({}), (Names{"0", "1e-05", "0.333333", "0.5", "2"}));
    EXPECT_EQ(folder.select({"-latestTime"}), Names{"2"});
    EXPECT_EQ(folder.select({"-time", "0.50"}), Names{"0.5"});
    EXPECT_EQ(folder.select({"-time", "0.333333:0.5"}), (Names{"0.333333", "0.5"}));
    EXPECT_EQ(folder.select({"-time", "0.4:"}), (Names{"0.5", "2"}));
    EXPECT_EQ(folder.select({"-time", ":1e-5"}), (Names{"0", "1e-05"}));
    EXPECT_EQ(folder.select({"-time", ":"}).size(), 5u);
    EXPECT_EQ(folder.select({"-time", "0,1:"}), (Names{"0", "2"}));
}

TEST(TimeFolders, AreSelectedByWhatTheyHold)
{
    const Case folder;
    folder.write("0.5/liquid/positions", "");
    folder.write("2/liquid/positions", "");
    const auto selected = [&](const std::vector<const char*>& words)
    {
        const auto holds = [](const TimeFolder& time) { return fs::exists(time.path / "liquid"); };
        return Case::namesOf(selectTimesWith(folder.arguments(words), holds, "liquid", "some"));
    };
    EXPECT_EQ(selected({}), (Names{"0.5", "2"}));
    EXPECT_EQ(selected({"-time", ":1"}), Names{"0.5"});
    EXPECT_EQ(selected({"-latestTime"}), Names{"2"});
    EXPECT_TRUE(holds(messageOf([&] { selected({"-time", "0"}); }), {"None of the selected times holds liquid", "some", folder.path().string()}));
}

// Beside a run: the latest that has what is needed, and a word that it is not the latest.
TEST(TimeFolders, TheLatestOneIsTheLatestThatHolds)
{
    const Case folder;
    folder.write("0.333333/surface/liquid.ply", "");
    folder.write("0.5/surface/liquid.ply", "");
    const auto holdsSurface = [](const TimeFolder& time) { return fs::exists(time.path / "surface"); };
    testing::internal::CaptureStdout();
    EXPECT_EQ(Case::namesOf(selectTimesWith(folder.arguments({"-latestTime"}), holdsSurface, "a surface", "some")), Names{"0.5"});
    EXPECT_EQ(latestTimeWith(folder.path(), holdsSurface, "a surface", "some").name, "0.5");
    const std::string said = "The latest time 2 does not hold a surface. The latest one that does is 0.5\n";
    EXPECT_EQ(testing::internal::GetCapturedStdout(), said + said);
    folder.write("2/surface/liquid.ply", "");
    testing::internal::CaptureStdout();
    EXPECT_EQ(latestTimeWith(folder.path(), holdsSurface, "a surface", "some").name, "2");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    const auto never = [](const TimeFolder&) { return false; };
    EXPECT_TRUE(holds(messageOf([&] { latestTimeWith(folder.path(), never, "a surface", "some"); }), {"No time holds a surface", "some"}));
}

TEST(TimeFolders, WrongSelectionsAreErrors)
{
    const Case folder;
    EXPECT_TRUE(holds(folder.error({"-time", "0.7"}), {"-time 0.7 selects no time", "0.333333", "1e-05"}));
    EXPECT_TRUE(holds(folder.error({"-time", "0.6:0.4"}), {"selects no time"}));
    EXPECT_TRUE(holds(folder.error({"-time", "soon"}), {"'soon'", "A:B"}));
    EXPECT_TRUE(holds(folder.error({"-time", "0:1:2"}), {"'0:1:2'"}));
    EXPECT_TRUE(holds(folder.error({"-time", "0", "-latestTime"}), {"Both"}));
    for (const char* name : {"0", "1e-05", "0.333333", "0.5", "2"}) fs::remove_all(folder.path() / name);
    EXPECT_TRUE(holds(folder.error({}), {"no time folder", folder.path().string()}));
}

TEST(TimeFolders, TheNewestInstanceIsFound)
{
    const Case folder;
    const fs::path theta = "solid/theta";
    EXPECT_EQ(findInstance(folder.path(), 2, theta), fs::path());
    folder.write("constant/solid/theta", "");
    EXPECT_EQ(findInstance(folder.path(), 2, theta), folder.path() / "constant");
    folder.write("0/solid/theta", "");
    folder.write("0.333333/solid/theta", "");
    EXPECT_EQ(findInstance(folder.path(), 2, theta), folder.path() / "0.333333");
    EXPECT_EQ(findInstance(folder.path(), 1.0 / 3, theta), folder.path() / "0.333333");
    EXPECT_EQ(findInstance(folder.path(), 0.333333, theta), folder.path() / "0");       // a third is later
    EXPECT_EQ(findInstance(folder.path(), -1, theta), folder.path() / "constant");
}

TEST(TimeState, KeepsEveryBit)
{
    const ScratchFolder folder;
    const TimeState state{1.0 / 3, 123456789012, 1e-5 / 3, 0.1 + 0.2, 123456779012};      // 10000 steps from the origin
    const std::string name = "0.33333333333";
    writeTimeState(folder.path() / name, state);
    const auto back = readTimeState(folder.path() / name);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->value, state.value);
    EXPECT_EQ(back->index, state.index);
    EXPECT_EQ(back->deltaT, state.deltaT);
    EXPECT_EQ(back->origin, state.origin);
    EXPECT_EQ(back->originIndex, state.originIndex);
    EXPECT_FALSE(readTimeState(folder.path() / "0.5"));
    folder.write("0.5/uniform/time", "value 0.5;\nindex much;");
    EXPECT_TRUE(holds(messageOf([&] { readTimeState(folder.path() / "0.5"); }), {"index", "much", "line 2"}));
}

TEST(TimeState, RefusesStepsThatNobodyCounts)
{
    const ScratchFolder folder;
    const auto refusal = [&](const std::string& value, const std::string& index, const std::string& origin)
    {
        folder.write("0.5/uniform/time", "value " + value + ";\nindex " + index + ";\ndeltaT 0.001;\norigin 0;\noriginIndex " + origin + ";");
        return messageOf([&] { readTimeState(folder.path() / "0.5"); });
    };
    EXPECT_TRUE(readTimeState(folder.write("0.5/uniform/time", "value 0.5; index 500; deltaT 0.001; origin 0; originIndex 0;")
        .parent_path().parent_path()));
    EXPECT_TRUE(holds(refusal("0.5", "9223372036854775807", "0"), {"The index is 9223372036854775807", "line 2"}));
    EXPECT_TRUE(holds(refusal("0.5", "-1", "0"), {"The index is -1"}));
    EXPECT_TRUE(holds(refusal("0.5", "500", "501"), {"originIndex 501"}));
    EXPECT_TRUE(holds(refusal("0.5", "501", "0"), {"The value is not the time of the step", "line 1"}));
}
