// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/TimeSeries.H"

#include "core/fieldFile/AtomicFile.H"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <limits>

namespace shizuku
{

void writePvd(const std::filesystem::path& file, const std::vector<TimeSeriesEntry>& entries)
{
    writeAtomically(file, [&](std::ostream& out)
    {
        out.precision(std::numeric_limits<double>::digits10);
        out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
        for (const auto& [time, path] : entries)
        {
            out << "    <DataSet timestep=\"" << time << "\" part=\"0\" file=\"" << path << "\"/>\n";
        }
        out << "  </Collection>\n</VTKFile>\n";
    });
}

void writeSeries(const std::filesystem::path& file, const std::vector<TimeSeriesEntry>& entries)
{
    writeAtomically(file, [&](std::ostream& out)
    {
        out.precision(std::numeric_limits<double>::digits10);
        out << "{\n  \"file-series-version\" : \"1.0\",\n  \"files\" : [";
        const char* separator = "\n";
        for (const auto& [time, path] : entries)
        {
            out << separator << "    { \"name\" : \"" << path << "\", \"time\" : " << time << " }";
            separator = ",\n";
        }
        out << "\n  ]\n}\n";
    });
}

std::vector<TimeSeriesEntry> readPvd(const std::filesystem::path& file)
{
    if (!std::filesystem::is_regular_file(file)) return {};
    std::vector<TimeSeriesEntry> entries;
    try
    {
        boost::property_tree::ptree tree;
        boost::property_tree::read_xml(file.string(), tree);
        for (const auto& [element, set] : tree.get_child("VTKFile.Collection"))
        {
            entries.push_back({set.get<double>("<xmlattr>.timestep"), set.get<std::string>("<xmlattr>.file")});
        }
    }
    catch (const boost::property_tree::ptree_error&)
    {
        return {};
    }
    return entries;
}

}
