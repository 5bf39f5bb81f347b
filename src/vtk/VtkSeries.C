#include "vtk/VtkSeries.H"

namespace shizuku
{

VtkSeries::VtkSeries(const std::filesystem::path& casePath, std::string name, VtkEncoding encoding)
: folder_(casePath/"VTK"), name_(std::move(name)), encoding_(encoding)
{}

void VtkSeries::add(double time, int index, VtpContent content, double spacing)
{
    content.values = {{"TimeValue", time}, {"particleSpacing", spacing}};
    const std::string file = name_ + "/" + name_ + "_" + std::to_string(index) + ".vtp";
    writeVtp(folder_/file, content, encoding_);
    entries_.push_back({time, file});
}

void VtkSeries::repeat(double time)
{
    entries_.push_back({time, entries_.back().file});
}

void VtkSeries::finish() const
{
    if (entries_.empty()) return;
    writePvd(pvdFile(), entries_);
    writeSeries(folder_/(name_ + ".vtp.series"), entries_);
}

}
