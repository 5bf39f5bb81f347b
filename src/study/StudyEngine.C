// SPDX-License-Identifier: GPL-3.0-or-later
#define BOOST_BIND_GLOBAL_PLACEHOLDERS      // else the JSON parser of Boost 1.74 remarks on its own placeholders

#include "study/StudyEngine.H"

#include "core/fieldFile/AtomicFile.H"
#include "study/RunReason.H"
#include "study/StudyOptions.H"

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace shizuku
{

namespace
{

namespace fs = std::filesystem;

using Record = boost::property_tree::ptree;

fs::path recordFile(const fs::path& casePath) { return casePath/"study.json"; }

// The digest of the case that was run in this folder; empty where none was.
std::string digestThere(const fs::path& casePath)
{
    Record record;
    try
    {
        if (fs::exists(recordFile(casePath))) read_json(recordFile(casePath).string(), record);
    }
    catch (const boost::property_tree::ptree_error&) {}     // damaged: the run begins anew
    return record.get("digest", std::string{});
}

std::string textOf(const CsvFile::Cell& cell)
{
    if (const auto* text = std::get_if<std::string>(&cell)) return *text;
    std::ostringstream stream;
    stream << std::setprecision(9) << std::get<double>(cell);
    return stream.str();
}

// Paths below the case as the case has them.
std::string withoutFolder(std::string text, const fs::path& folder)
{
    const std::string part = folder.string() + "/";
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part)) text.erase(at, part.size());
    return text;
}

// One line, without what would divide a row of a table.
std::string asCell(std::string text)
{
    for (char& c : text)
    {
        if (c == '\n' || c == ',') c = c == ',' ? ';' : ' ';
    }
    return text;
}

}

std::string nameOf(RunEnd end)
{
    switch (end)
    {
        case RunEnd::finished: return "finished";
        case RunEnd::died: return "died";
        case RunEnd::unmeasured: return "unmeasured";
        default: return "not run";
    }
}

void reportDeaths(const std::vector<RunOutcome>& outcomes)
{
    for (const RunOutcome& outcome : outcomes)
    {
        if (outcome.end == RunEnd::finished) continue;
        std::cout << "No result: " << outcome.run.name << ", " << nameOf(outcome.end)
                  << (outcome.reason.empty() ? "" : ": " + outcome.reason) << '\n';
    }
}

StudyEngine::StudyEngine(const Study& study, const Arguments& args, const RunMeasure& measure)
: study_(study), args_(args), measure_(measure), output_(studyOutput(args, study))
{
    for (const StudyRun& run : runsOf(study))
    {
        cases_.push_back(composeCase(study, run));
        outcomes_.push_back({run, output_/"runs"/run.name, cases_.back().values});
    }
}

std::string StudyEngine::commandOf(const RunOutcome& outcome) const
{
    std::map<std::string, std::string> words = outcome.values;
    const bool choosesDevice = study_.command.text.find("@device@") != std::string::npos;
    if (choosesDevice && args_.found("device") && words["device"] == "auto") words["device"] = args_.get("device");
    const std::string command = withWords(study_.command.text, words, study_.command.where);
    if (args_.found("prepare")) return "SHIZUKU_PREPARE_ONLY=yes " + command;
    return args_.found("device") && !choosesDevice ? command + " -device " + args_.get("device") : command;
}

void StudyEngine::prepare(std::size_t i)
{
    const fs::path& path = outcomes_[i].path;
    if (RunningCase::isBeingRun(path)) throw FatalError("The case is being run already: " + path.string());
    cases_[i].write(path);
    Record record;
    record.put("digest", cases_[i].digest());
    writeAtomically(recordFile(path), [&](std::ostream& stream) { write_json(stream, record); });
}

void StudyEngine::run()
{
    std::vector<CaseRun> runs;
    for (std::size_t i = 0; i < outcomes_.size(); ++i)
    {
        const RunOutcome& outcome = outcomes_[i];
        const std::string command = commandOf(outcome);
        CaseRecord record;
        if (digestThere(outcome.path) == cases_[i].digest()) record = readRecord(outcome.path);
        const bool same = record.command == command || args_.found("draw");
        const bool ended = record.status == "finished" || (record.status == "failed" && !args_.found("retry"));
        runs.push_back
        ({
            outcome.run.name, outcome.path, command, record, same && ended, study_.timeLimit, [this, i] { prepare(i); }
        });
        if (same && ended && !args_.found("prepare")) judge(i, record);
    }
    writeTable();
    if (args_.found("draw")) return;

    const std::vector<Place> where = places(args_);
    const auto before = std::count_if(runs.begin(), runs.end(), [](const CaseRun& run) { return run.finishedBefore; });
    std::cout << "Runs : " << runs.size() << " in " << (output_/"runs").string() << ", of which ended before " << before
              << "; at a time " << where.size() << "\n\n";
    CaseRuns(runs, where, [&](const CaseRun& ended)
    {
        if (args_.found("prepare")) return;
        judge(&ended - runs.data(), ended.record);
        writeTable();
    }).toTheEnd();
}

void StudyEngine::judge(std::size_t i, const CaseRecord& record)
{
    RunOutcome& outcome = outcomes_[i];
    outcome.seconds = record.seconds;
    outcome.end = record.status == "finished" ? RunEnd::finished : RunEnd::died;
    outcome.reason = record.reason;
    if (outcome.end == RunEnd::died && outcome.reason.empty()) outcome.reason = reasonOf(outcome.path, record.exit);
    outcome.reason = withoutFolder(outcome.reason, outcome.path);
    try
    {
        outcome.measured = measure_.measure(outcome);
    }
    catch (const FatalInputError& error)
    {
        if (fs::path(error.where().file).parent_path() == study_.folder) throw;
        outcome.measured.clear();
        if (outcome.end == RunEnd::finished)
        {
            outcome.end = RunEnd::unmeasured;
            outcome.reason = error.what();
        }
    }
    writeRecord(outcome);
}

void StudyEngine::writeRecord(const RunOutcome& outcome) const
{
    if (!fs::is_directory(outcome.path)) return;
    Record record;
    record.put("digest", cases_[&outcome - outcomes_.data()].digest());
    for (std::size_t axis = 0; axis < study_.axes.size(); ++axis)
    {
        record.put("choices." + study_.axes[axis].name, study_.axes[axis].choices[outcome.run.choices[axis]].name);
    }
    for (const auto& [word, value] : outcome.values) record.put("values." + word, value);
    record.put("end", nameOf(outcome.end));
    record.put("reason", outcome.reason);
    record.put("seconds", outcome.seconds);
    for (const auto& [column, cell] : outcome.measured) record.put("measured." + column, textOf(cell));
    writeAtomically(recordFile(outcome.path), [&](std::ostream& stream) { write_json(stream, record); });
}

void StudyEngine::writeTable() const
{
    std::vector<CsvFile::Column> columns;
    for (const StudyAxis& axis : study_.axes) columns.push_back({axis.name, ""});
    const std::vector<CsvFile::Column> measured = measure_.columns();
    columns.push_back({"end", ""});
    columns.insert(columns.end(), measured.begin(), measured.end());
    columns.push_back({"seconds", "s"});
    columns.push_back({"reason", ""});
    CsvFile table(output_/"runs.csv", columns);
    for (const RunOutcome& outcome : outcomes_)
    {
        std::vector<CsvFile::Cell> row;
        for (std::size_t axis = 0; axis < study_.axes.size(); ++axis)
        {
            row.emplace_back(study_.axes[axis].choices[outcome.run.choices[axis]].name);
        }
        row.emplace_back(nameOf(outcome.end));
        for (const CsvFile::Column& column : measured)
        {
            const auto cell = outcome.measured.find(column.name);
            row.push_back(cell == outcome.measured.end() ? CsvFile::Cell(std::nan("")) : cell->second);
        }
        row.emplace_back(outcome.seconds);
        row.emplace_back(asCell(outcome.reason));
        table.addRow(row);
    }
    table.write();
}

}
