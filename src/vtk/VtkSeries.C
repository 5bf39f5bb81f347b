// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/VtkSeries.H"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <regex>

namespace shizuku
{

namespace
{

// A .pvd has 15 digits of a time.
bool sameTime(double a, double b)
{
    return std::abs(a - b) <= 1e-13 * std::abs(a);
}

bool names(const std::vector<TimeSeriesEntry>& entries, const std::string& file)
{
    return std::any_of(entries.begin(), entries.end(), [&](const TimeSeriesEntry& entry) { return entry.file == file; });
}

bool isOfKind(const TimeSeriesEntry& entry, const std::string& ending)
{
    return std::filesystem::path(entry.file).extension() == ending;
}

// Whether the file holds what it did: it was not written anew, or for the same time. Numbers of files move on where a time
// was removed or came in between.
bool holdsTheSame(const std::string& file, const std::vector<TimeSeriesEntry>& earlier, const std::vector<TimeSeriesEntry>& now)
{
    const auto written = std::find_if(now.begin(), now.end(), [&](const TimeSeriesEntry& entry) { return entry.file == file; });
    const auto same = [&](const TimeSeriesEntry& entry) { return entry.file == file && sameTime(entry.time, written->time); };
    return written == now.end() || std::any_of(earlier.begin(), earlier.end(), same);
}

}

VtkSeries::VtkSeries(const std::filesystem::path& casePath, std::string name, VtkEncoding encoding)
: folder_(casePath/"VTK"), name_(std::move(name)), encoding_(encoding)
{}

void VtkSeries::add(double time, int index, VtpContent content, double spacing)
{
    addPiece(time, index, std::move(content), spacing, Alone());
}

void VtkSeries::addPiece(double time, int index, VtpContent content, double spacing, const Communicator& parts)
{
    content.values = {{"TimeValue", time}, {"particleSpacing", spacing}};
    const std::string file = fileOf(index, parts.parts() > 1 ? ".pvtp" : ".vtp");
    if (parts.parts() > 1) writePvtp(folder_/file, content, encoding_, parts);
    else writeVtp(folder_/file, content, encoding_);
    entries_.push_back({time, file});
}

void VtkSeries::repeat(double time)
{
    entries_.push_back({time, entries_.back().file});
}

// Those of this series' own files that are still there.
std::vector<TimeSeriesEntry> VtkSeries::earlier() const
{
    const std::regex own(name_ + "/" + name_ + "_[0-9]+\\.p?vtp");
    std::vector<TimeSeriesEntry> entries = readPvd(pvdFile());
    std::erase_if(entries, [&](const TimeSeriesEntry& entry)
    {
        return !std::regex_match(entry.file, own) || !std::filesystem::exists(folder_/entry.file);
    });
    return entries;
}

void VtkSeries::finish(const std::vector<double>& others) const
{
    const std::vector<TimeSeriesEntry> earlier = this->earlier();
    std::vector<TimeSeriesEntry> entries = entries_;
    for (const TimeSeriesEntry& entry : earlier)
    {
        const bool other = std::any_of(others.begin(), others.end(), [&](double time) { return sameTime(time, entry.time); });
        if (other && holdsTheSame(entry.file, earlier, entries_)) entries.push_back(entry);
    }
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.time < b.time; });

    for (const std::string ending : {".vtp", ".pvtp"})
    {
        std::vector<TimeSeriesEntry> ofKind;
        std::copy_if(entries.begin(), entries.end(), std::back_inserter(ofKind), [&](const TimeSeriesEntry& entry) { return isOfKind(entry, ending); });
        const std::filesystem::path seriesFile = folder_/(name_ + ending + ".series");
        if (ofKind.empty()) std::filesystem::remove(seriesFile);
        else writeSeries(seriesFile, ofKind);
    }
    if (entries.empty()) std::filesystem::remove(pvdFile());
    else writePvd(pvdFile(), entries);
    for (const TimeSeriesEntry& entry : earlier)
    {
        if (names(entries, entry.file)) continue;
        if (isOfKind(entry, ".pvtp")) removePvtp(folder_/entry.file);
        else std::filesystem::remove(folder_/entry.file);
    }
}

}
