// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/arguments/Arguments.H"
#include "core/arguments/Version.H"
#include "core/arguments/runApplication.H"
#include "support/ScratchFolder.H"

#include <functional>
#include <iostream>
#include <new>
#include <stdexcept>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

ApplicationInfo info()
{
    return
    {
        "aTool", "Does something to a case.",
        {
            {"device", "auto|cuda|cpu", "Where to compute", "auto"},
            {"latestTime", "", "Only the latest time", ""},
            {"scale", "FACTOR", "Scale the surface", ""},
        },
        {"dictionary"}, false
    };
}

Arguments parse(const std::vector<const char*>& words, const ApplicationInfo& application = info())
{
    std::vector<const char*> argv{"aTool"};
    argv.insert(argv.end(), words.begin(), words.end());
    return Arguments(static_cast<int>(argv.size()), argv.data(), application);
}

std::string errorOf(const std::vector<const char*>& words, const ApplicationInfo& application = info())
{
    return messageOf([&] { parse(words, application); });
}

int runWith(const std::function<void(const Arguments&)>& body, bool quiet = false)
{
    const char* argv[] = {"aTool"};
    return runApplication(1, argv, info(), body, quiet);
}

}

TEST(Arguments, ReadsSingleDashOptionsSwitchesAndPositionals)
{
    const Arguments args = parse({"-scale", "-1.5e-3", "system/meshDict", "-latestTime", "-device", "cpu"});
    EXPECT_TRUE(args.found("latestTime"));
    EXPECT_EQ(args.get("device"), "cpu");
    EXPECT_EQ(args.getDouble("scale"), -1.5e-3);
    EXPECT_EQ(args.positional("dictionary"), "system/meshDict");
    EXPECT_EQ(args.commandLine(), "aTool -scale -1.5e-3 system/meshDict -latestTime -device cpu");
}

TEST(Arguments, TakesDoubleDashesAndEqualSigns)
{
    const Arguments args = parse({"--latestTime", "-device=cuda"});
    EXPECT_TRUE(args.found("latestTime"));
    EXPECT_EQ(args.get("device"), "cuda");
}

TEST(Arguments, ALastPositionalMayStandForMany)
{
    ApplicationInfo many = info();
    many.positional = {"dictionary", "cases..."};
    const std::vector<std::string> expected{"b", "c", "d"};
    EXPECT_EQ(parse({"a", "b", "-latestTime", "c", "d"}, many).positionals("cases..."), expected);
    EXPECT_TRUE(parse({"a"}, many).positionals("cases...").empty());
    EXPECT_TRUE(parse({}, many).positionals("cases...").empty());
    EXPECT_TRUE(holds(errorOf({"a", "b"}), {"Unexpected argument 'b'"}));
}

TEST(Arguments, OfAnApplicationThatNeedsACaseTheManyAreCases)
{
    const ScratchFolder folder;
    for (const char* name : {"a", "b"}) folder.write(std::string(name) + "/system/controlDict", "");
    folder.write("noCase/file", "");
    const std::string a = (folder.path()/"a").string(), b = (folder.path()/"b").string(), noCase = (folder.path()/"noCase").string();
    ApplicationInfo many = info();
    many.positional = {"cases..."};
    EXPECT_FALSE(parse({"nowhere"}, many).givesCases());
    many.needsCase = true;
    const Arguments args = parse({"-device", "cuda", a.c_str(), "-latestTime", b.c_str()}, many);
    EXPECT_TRUE(args.givesCases());
    EXPECT_EQ(args.positionals("cases..."), (std::vector<std::string>{a, b}));
    const Arguments ofB = args.ofCase(b);
    EXPECT_FALSE(ofB.givesCases());
    EXPECT_EQ(ofB.casePath(), b);
    EXPECT_EQ(ofB.get("device"), "cuda");
    EXPECT_TRUE(ofB.found("latestTime"));
    EXPECT_FALSE(parse({"-case", a.c_str()}, many).givesCases());
    EXPECT_TRUE(holds(errorOf({a.c_str(), noCase.c_str()}, many), {"The folder is not a case: system/controlDict is missing", noCase}));
    EXPECT_TRUE(holds(errorOf({a.c_str(), b.c_str(), a.c_str()}, many), {"The case is given twice", "file: " + a}));
    EXPECT_TRUE(holds(errorOf({a.c_str(), "-case", b.c_str()}, many), {"Option -case is given beside the case '" + a + "'"}));
}

TEST(Arguments, FallsBackToDefaults)
{
    const Arguments args = parse({});
    EXPECT_FALSE(args.found("device"));
    EXPECT_EQ(args.get("device"), "auto");
    EXPECT_EQ(args.positional("dictionary"), "");
    EXPECT_EQ(args.casePath(), std::filesystem::current_path());
    EXPECT_TRUE(holds(messageOf([&] { args.get("scale"); }), {"Option -scale is missing"}));
}

TEST(Arguments, RefusesWhatItDoesNotKnow)
{
    EXPECT_TRUE(holds(errorOf({"-latesTime"}), {"Unknown option '-latesTime'", "'-latestTime'", "-case"}));
    EXPECT_TRUE(holds(errorOf({"--latesTime"}), {"Unknown option '-latesTime'", "'-latestTime'"}));
    EXPECT_TRUE(holds(errorOf({"-late"}), {"Unknown option '-late'"}));     // no guessing from a beginning
    EXPECT_TRUE(holds(errorOf({"one", "two"}), {"Unexpected argument 'two'"}));
}

TEST(Arguments, RefusesBadValues)
{
    EXPECT_TRUE(holds(errorOf({"-scale"}), {"-scale has no value"}));
    EXPECT_TRUE(holds(errorOf({"-scale", "-latestTime"}), {"-scale has no value"}));
    EXPECT_TRUE(holds(errorOf({"-latestTime=3"}), {"-latestTime takes no value"}));
    EXPECT_TRUE(holds(errorOf({"-device", "cud"}), {"-device has the value 'cud'", "Did you mean 'cuda'?", "cpu"}));
    EXPECT_TRUE(holds(errorOf({"-scale", "1", "-scale", "2"}), {"-scale is given twice"}));
    for (const char* number : {"1.5x", "nan", "-inf", "1e999"})
    {
        const Arguments args = parse({"-scale", number});
        EXPECT_TRUE(holds(messageOf([&] { args.getDouble("scale"); }), {"'" + std::string(number) + "'", "a finite number"}));
    }
}

TEST(Arguments, ChecksTheCase)
{
    const ScratchFolder folder;
    ApplicationInfo application = info();
    application.needsCase = true;
    const std::string path = folder.path().string();
    EXPECT_TRUE(holds(errorOf({"-case", (path + "/no").c_str()}, application), {"does not exist", path + "/no"}));
    EXPECT_TRUE(holds(errorOf({"-case", path.c_str()}, application), {"system/controlDict is missing", path}));
    const std::string file = folder.write("file", "").string();
    EXPECT_TRUE(holds(errorOf({"-case", file.c_str()}, application), {"not a directory"}));

    folder.write("system/controlDict", "");
    const Arguments args = parse({"-case", (path + "/system/..").c_str()}, application);
    EXPECT_EQ(args.casePath().lexically_normal(), std::filesystem::canonical(path));
}

TEST(Arguments, HelpNamesEveryOptionItsValueAndDefault)
{
    EXPECT_TRUE
    (
        holds
        (
            helpText(info()),
            {
                "Usage: aTool [OPTIONS] <dictionary>", "Does something to a case.", "-case <DIR>",
                "-device <auto|cuda|cpu>  Where to compute (default: auto)", "-help", "-latestTime  "
            }
        )
    );
    EXPECT_EXIT(parse({"-help", "-scale", "1"}), testing::ExitedWithCode(0), "");
    EXPECT_EXIT(parse({"-h"}), testing::ExitedWithCode(0), "");
    EXPECT_EXIT(parse({"-version"}), testing::ExitedWithCode(0), "");
}

TEST(RunApplication, PrintsBannerTimesAndEnd)
{
    testing::internal::CaptureStdout();
    EXPECT_EQ(runWith([](const Arguments&) { std::cout << "body\n"; }), 0);
    const std::string text = testing::internal::GetCapturedStdout();
    EXPECT_TRUE
    (
        holds
        (
            text,
            {
                "Shizuku " + versionText() + ", ", ", host ", ", PID " + std::to_string(getpid()), "Exec   : aTool\n",
                "body\n", "ExecutionTime = ", " s  ClockTime = ", "\nEnd\n"
            }
        )
    );

    testing::internal::CaptureStdout();
    EXPECT_EQ(runWith([](const Arguments&) { std::cout << "3.5\n"; }, true), 0);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "3.5\n");
}

TEST(RunApplication, TurnsEveryErrorIntoAMessageAndStatusOne)
{
    const auto messageAfter = [](const std::function<void(const Arguments&)>& body)
    {
        testing::internal::CaptureStderr();
        EXPECT_EQ(runWith(body, true), 1);
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_TRUE
    (
        holds
        (
            messageAfter([](const Arguments&) { throw FatalInputError({"constant/g", 7}, "Bad value"); }),
            {"--> FATAL IO ERROR:\n", "Bad value", "constant/g", "7"}
        )
    );
    EXPECT_TRUE
    (
        holds(messageAfter([](const Arguments&) { throw FatalError("No device"); }), {"--> FATAL ERROR:\nNo device"})
    );
    EXPECT_TRUE(holds(messageAfter([](const Arguments&) { throw std::bad_alloc(); }), {"not enough memory"}));
    EXPECT_TRUE
    (
        holds(messageAfter([](const Arguments&) { throw std::out_of_range("at 3"); }), {"--> FATAL ERROR:\nat 3"})
    );
    // An earlier line could not be written.
    const auto failing = [](const Arguments&)
    {
        std::cerr.setstate(std::ios::badbit);
        throw FatalError("No device");
    };
    EXPECT_TRUE(holds(messageAfter(failing), {"--> FATAL ERROR:\nNo device"}));
}
