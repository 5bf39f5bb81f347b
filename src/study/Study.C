// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/Study.H"

#include "core/dictionary/EntryText.H"
#include "core/paths/Existence.H"

#include <algorithm>
#include <cctype>
#include <utility>

namespace shizuku
{

namespace
{

namespace fs = std::filesystem;

StudyText textOf(const Dictionary& dict, const std::string& key)
{
    return {entryText(dict, key), dict.where(key)};
}

std::vector<StudyText> listOf(const Dictionary& dict, const std::string& key)
{
    std::vector<StudyText> texts;
    if (!dict.found(key)) return texts;
    for (const std::string& text : listTexts(dict, key)) texts.push_back({text, dict.where(key)});
    return texts;
}

std::vector<std::pair<std::string, StudyText>> pairsOf(const Dictionary& dict, const std::string& key)
{
    std::vector<std::pair<std::string, StudyText>> pairs;
    const Dictionary sub = dict.subDictOrEmpty(key);
    for (const std::string& word : sub.keys()) pairs.emplace_back(word, textOf(sub, word));
    return pairs;
}

CaseChoice readChoice(const std::string& name, const Dictionary& dict)
{
    CaseChoice choice{name, pairsOf(dict, "values"), listOf(dict, "layers"), pairsOf(dict, "folders"), {}};
    const Dictionary set = dict.subDictOrEmpty("set");
    for (const std::string& file : set.keys())
    {
        for (const auto& [entry, value] : pairsOf(set, file)) choice.entries.push_back({file, entry, value});
    }
    return choice;
}

// Names become folders: letters, digits and a few signs stay.
std::string nameOf(std::string text)
{
    for (char& c : text)
    {
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '+' && c != '-') c = '_';
    }
    return text;
}

StudyAxis readAxis(const Dictionary& axes, const std::string& name)
{
    StudyAxis axis{name, {}};
    if (axes.isDict(name))
    {
        const Dictionary choices = axes.subDict(name);
        for (const std::string& choice : choices.keys())
        {
            axis.choices.push_back(readChoice(nameOf(choice), choices.subDict(choice)));
        }
    }
    else
    {
        for (const StudyText& value : listOf(axes, name))
        {
            axis.choices.push_back({nameOf(value.text), {{name, value}}, {}, {}, {}});
        }
    }
    if (axis.choices.empty())
    {
        throw FatalInputError(axes.where(name), "Axis '" + name + "' has no choice: the grid is empty", "one at least, (a b c)");
    }
    for (std::size_t i = 0; i < axis.choices.size(); ++i)
    {
        for (std::size_t j = 0; j < i; ++j)
        {
            if (axis.choices[i].name != axis.choices[j].name) continue;
            throw FatalInputError(axes.where(name), "Axis '" + name + "' has the choice '" + axis.choices[i].name + "' twice");
        }
    }
    return axis;
}

void replaceValue(CaseChoice& choice, const std::string& word, const StudyText& value)
{
    const auto there = std::find_if
    (
        choice.values.begin(), choice.values.end(), [&](const auto& each) { return each.first == word; }
    );
    if (there == choice.values.end()) choice.values.emplace_back(word, value);
    else there->second = value;
}

// Other choices of the same axes, other values, further axes behind.
void vary(Study& study, const Dictionary& variant)
{
    const Dictionary axes = variant.subDictOrEmpty("axes");
    for (const std::string& name : axes.keys())
    {
        const auto isNamed = [&](const StudyAxis& each) { return each.name == name; };
        if (std::none_of(study.axes.begin(), study.axes.end(), isNamed))
        {
            study.axes.push_back(readAxis(axes, name));
            continue;
        }
        const std::size_t axis = study.axis({name, axes.where(name)});
        std::vector<CaseChoice> chosen;
        for (const StudyText& choice : listOf(axes, name))
        {
            const auto& all = study.axes[axis].choices;
            const bool isWord = !all.front().values.empty() && all.front().values.front().first == name;
            const auto isChosen = [&](const CaseChoice& each) { return each.name == nameOf(choice.text); };
            if (!isWord || std::any_of(all.begin(), all.end(), isChosen)) chosen.push_back(all[study.axes[axis].find(choice)]);
            else chosen.push_back({nameOf(choice.text), {{name, choice}}, {}, {}, {}});
        }
        if (chosen.empty()) throw FatalInputError(axes.where(name), "Axis '" + name + "' has no choice: the grid is empty");
        study.axes[axis].choices = chosen;
    }
    for (const auto& [word, value] : pairsOf(variant, "values")) replaceValue(study.common, word, value);
}

// strict: the axes have all choices that it names.
void readLeftOut(Study& study, const Dictionary& leaveOut, bool strict)
{
    for (const std::string& name : leaveOut.keys())
    {
        const Dictionary each = leaveOut.subDict(name);
        study.leftOut.emplace_back();
        for (const std::string& word : each.keys())
        {
            const std::size_t axis = study.axis({word, each.where(word)});
            study.leftOut.back().push_back({axis, {}});
            for (const StudyText& choice : listOf(each, word))
            {
                if (strict) study.axes[axis].find(choice);
                study.leftOut.back().back().second.push_back(nameOf(choice.text));
            }
        }
    }
}

bool isLeftOut(const Study& study, const StudyRun& run)
{
    const auto matches = [&](const auto& one)
    {
        const auto& [axis, names] = one;
        return std::find(names.begin(), names.end(), study.axes[axis].choices[run.choices[axis]].name) != names.end();
    };
    return std::any_of(study.leftOut.begin(), study.leftOut.end(), [&](const auto& rule)
    {
        return std::all_of(rule.begin(), rule.end(), matches);
    });
}

// Words that valuesFile does not have would change nothing.
void checkWords(const Study& study)
{
    const Dictionary values = Dictionary::read(study.valuesFile);
    const std::vector<std::string> known = values.keys();
    const auto check = [&](const CaseChoice& choice)
    {
        for (const auto& [word, value] : choice.values)
        {
            if (values.found(word)) continue;
            throw FatalInputError
            (
                value.where, "The case has no value '" + word + "'",
                "a word that " + study.valuesFile.string() + " gives a default", known, word
            );
        }
    };
    check(study.common);
    for (const StudyAxis& axis : study.axes)
    {
        for (const CaseChoice& choice : axis.choices) check(choice);
    }
}

}

std::size_t StudyAxis::find(const StudyText& choice) const
{
    std::vector<std::string> names;
    for (const CaseChoice& each : choices) names.push_back(each.name);
    const auto found = std::find(names.begin(), names.end(), nameOf(choice.text));
    if (found != names.end()) return found - names.begin();
    throw FatalInputError
    (
        choice.where, "Axis '" + name + "' has no choice '" + choice.text + "'", "one of its choices", names, choice.text
    );
}

Study Study::read(const fs::path& given, const std::string& variant)
{
    const fs::path file = isFolder(given) ? given/"studyDict" : given;
    Study study;
    study.dict = Dictionary::read(file);
    study.folder = fs::absolute(file).lexically_normal().parent_path();
    study.name = study.folder.filename().string();

    const Dictionary caseDict = study.dict.subDict("case");
    study.common = readChoice("case", caseDict);
    if (study.common.layers.empty())
    {
        throw FatalInputError(caseDict.where(), "The case has no layers", "layers (\"FOLDER\" ...);");
    }
    study.valuesFile = (study.folder/caseDict.lookup<std::string>("valuesFile")).lexically_normal();
    study.command = {caseDict.lookupOr("command", std::string("./Allrun")), caseDict.where()};
    study.timeLimit = study.dict.found("timeLimit") ? study.dict.lookupPositive("timeLimit", dimensions::time) : 0;

    const Dictionary axes = study.dict.subDict("axes");
    for (const std::string& name : axes.keys()) study.axes.push_back(readAxis(axes, name));
    if (study.axes.empty()) throw FatalInputError(axes.where(), "There is no axis: the grid is empty", "particles (500 1000);");
    const Dictionary variants = study.dict.subDictOrEmpty("variants"), leaveOut = study.dict.subDictOrEmpty("leaveOut");
    for (const std::string& name : variants.keys())
    {
        if (name != variant) variants.subDict(name).markUsed();
    }
    if (variant.empty()) readLeftOut(study, leaveOut, true);
    else
    {
        if (!variants.found(variant))
        {
            throw FatalInputError
            (
                study.dict.where(), "The study has no variant '" + variant + "'", "one of its variants", variants.keys(),
                variant
            );
        }
        const Dictionary chosen = variants.subDict(variant);
        vary(study, chosen);
        const bool leavesOutOthers = chosen.found("leaveOut");
        if (leavesOutOthers) leaveOut.markUsed();
        readLeftOut(study, leavesOutOthers ? chosen.subDict("leaveOut") : leaveOut, leavesOutOthers);     // those of the study may be of choices that the variant has not
        chosen.refuseUnused();
    }
    checkWords(study);
    return study;
}

std::size_t Study::axis(const StudyText& wanted) const
{
    std::vector<std::string> names;
    for (const StudyAxis& each : axes) names.push_back(each.name);
    const auto found = std::find(names.begin(), names.end(), wanted.text);
    if (found != names.end()) return found - names.begin();
    throw FatalInputError(wanted.where, "The study has no axis '" + wanted.text + "'", "one of its axes", names, wanted.text);
}

std::vector<StudyRun> runsOf(const Study& study)
{
    constexpr std::size_t mostRuns = 100'000;       // before any is left out
    std::vector<StudyRun> runs{{}};
    for (const StudyAxis& axis : study.axes)
    {
        if (runs.size() * axis.choices.size() > mostRuns)
        {
            throw FatalInputError
            (
                study.dict.where(), "The grid has " + std::to_string(runs.size()) + " combinations before the axis '" + axis.name + "' of "
                    + std::to_string(axis.choices.size()) + " choices", "at most " + std::to_string(mostRuns) + " in all"
            );
        }
        std::vector<StudyRun> longer;
        for (const StudyRun& run : runs)
        {
            for (std::size_t i = 0; i < axis.choices.size(); ++i)
            {
                longer.push_back(run);
                longer.back().name += (run.name.empty() ? "" : "-") + axis.choices[i].name;
                longer.back().choices.push_back(i);
            }
        }
        runs = std::move(longer);
    }
    std::erase_if(runs, [&](const StudyRun& run) { return isLeftOut(study, run); });
    if (runs.empty()) throw FatalInputError(study.dict.where("leaveOut"), "Every combination is left out: the grid is empty");
    return runs;
}

}
