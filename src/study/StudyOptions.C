// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/StudyOptions.H"

#include "caseRuns/Places.H"

#include <cstdlib>

namespace shizuku
{

namespace
{

std::string variantOf(const Arguments& args)
{
    if (args.found("quick") && args.found("variant"))
    {
        throw FatalInputError({}, "-quick and -variant exclude each other", "one of them");
    }
    return args.found("variant") ? args.get("variant") : args.found("quick") ? "quick" : "";
}

}

std::vector<Option> studyOptions()
{
    std::vector<Option> options = placeOptions(1);
    options.push_back({"output", "DIR", "where cases, tables and charts go (default: studies/<name> below $SHIZUKU_RUN or run)", ""});
    options.push_back({"variant", "NAME", "Use the choices of this variant of the study", ""});
    options.push_back({"quick", "", "Use the variant `quick`, which takes seconds", ""});
    options.push_back({"retry", "", "Run failed cases again", ""});
    options.push_back({"prepare", "", "Sample the solids only, for a machine without CGAL", ""});
    options.push_back({"draw", "", "Run nothing; measure and draw the cases that are there", ""});
    return options;
}

Study readStudy(const Arguments& args)
{
    if (args.positional("study").empty())
    {
        const std::string& name = args.info().name;
        throw FatalInputError({}, "No study is given", name + " STUDY, e.g. " + name + " studies/sessile");
    }
    return Study::read(args.positional("study"), variantOf(args));
}

std::filesystem::path studyOutput(const Arguments& args, const Study& study)
{
    namespace fs = std::filesystem;
    if (args.found("output")) return fs::absolute(args.get("output"));
    const char* const run = std::getenv("SHIZUKU_RUN");
    const std::string variant = variantOf(args);
    return fs::absolute(fs::path(run ? run : "run")/"studies"/(study.name + (variant.empty() ? "" : "-" + variant)));
}

}
