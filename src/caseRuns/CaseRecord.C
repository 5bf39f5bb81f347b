// SPDX-License-Identifier: GPL-3.0-or-later
#define BOOST_BIND_GLOBAL_PLACEHOLDERS      // else the JSON parser of Boost 1.74 remarks on its own placeholders

#include "caseRuns/CaseRecord.H"

#include "core/fieldFile/AtomicFile.H"
#include "core/messages/Error.H"

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

namespace shizuku
{

namespace
{

std::filesystem::path recordFile(const std::filesystem::path& casePath)
{
    return casePath/"log.runCases.json";
}

}

CaseRecord readRecord(const std::filesystem::path& casePath)
{
    const std::filesystem::path file = recordFile(casePath);
    if (!std::filesystem::exists(file)) return {};
    try
    {
        boost::property_tree::ptree tree;
        read_json(file.string(), tree);
        return
        {
            tree.get<std::string>("command"), tree.get<std::string>("status"), tree.get<int>("exit"),
            tree.get<double>("seconds"), tree.get("reason", std::string{})
        };
    }
    catch (const boost::property_tree::ptree_error& error)
    {
        warning(std::string("A case's record cannot be read, so the case runs again: ") + error.what(), {file.string(), 0});
        return {};
    }
}

void writeRecord(const std::filesystem::path& casePath, const CaseRecord& record)
{
    boost::property_tree::ptree tree;
    tree.put("command", record.command);
    tree.put("status", record.status);
    tree.put("exit", record.exit);
    tree.put("seconds", record.seconds);
    if (!record.reason.empty()) tree.put("reason", record.reason);
    writeAtomically(recordFile(casePath), [&](std::ostream& stream) { write_json(stream, tree); });
}

}
