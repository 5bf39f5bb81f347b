#include "vtk/TimeSeries.H"

#include "core/fieldFile/AtomicFile.H"

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

}
