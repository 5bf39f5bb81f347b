// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/GreyImage.H"

#include "core/messages/Error.H"
#include "core/paths/Existence.H"
#include "vtk/PngFile.H"

#include <vtkCallbackCommand.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkJPEGReader.h>
#include <vtkNew.h>

#include <fstream>
#include <iterator>
#include <string>

namespace shizuku
{

namespace
{

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& found)
{
    throw FatalInputError({file.string(), 0}, found, "a picture, PNG or JPEG");
}

[[noreturn]] void refuseDamaged(const std::filesystem::path& file, const std::string& how)
{
    refuse(file, "The image is damaged, or too large: " + how);
}

// What the reader complains of goes into a message instead of to the terminal; its warnings are damage too.
class Complaints
{
public:
    explicit Complaints(vtkImageReader2& reader) : reader_(reader)
    {
        observer_->SetClientData(&any_);
        observer_->SetCallback([](vtkObject*, unsigned long, void* data, void*) { *static_cast<bool*>(data) = true; });
        reader.AddObserver("ErrorEvent", observer_);
        reader.AddObserver("WarningEvent", observer_);
        reader.GetExecutive()->AddObserver("ErrorEvent", observer_);
    }
    bool any() const { return any_ || reader_.GetErrorCode() != 0; }

private:
    vtkImageReader2& reader_;
    vtkNew<vtkCallbackCommand> observer_;
    bool any_ = false;
};

GreyImage greyOfJpeg(const std::filesystem::path& file)
{
    const std::string damage = "it is not whole";
    const vtkNew<vtkJPEGReader> reader;
    const Complaints complaints(*reader);
    reader->SetFileName(file.c_str());
    reader->UpdateInformation();
    const int* const extent = reader->GetDataExtent();
    if (complaints.any()) refuseDamaged(file, damage);
    if ((extent[1] + 1.0)*(extent[3] + 1.0) > mostPixels) refuseDamaged(file, "it has too many pixels");
    reader->Update();
    if (complaints.any()) refuseDamaged(file, damage);

    vtkImageData& image = *reader->GetOutput();
    GreyImage result;
    result.width = image.GetDimensions()[0];
    result.height = image.GetDimensions()[1];
    if (result.width < 1 || result.height < 1) refuse(file, "The image has no pixels");
    const int components = image.GetNumberOfScalarComponents();
    const double white = image.GetScalarTypeMax();
    result.grey.reserve(std::size_t(result.width)*result.height);
    for (int row = 0; row < result.height; ++row)
    {
        for (int column = 0; column < result.width; ++column)
        {
            const auto component = [&](int c) { return image.GetScalarComponentAsDouble(column, row, 0, c); };
            const double value =
                components < 3 ? component(0) : 0.299*component(0) + 0.587*component(1) + 0.114*component(2);
            result.grey.push_back(float(value/white));
        }
    }
    return result;
}

}

GreyImage readGreyImage(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream || !isFile(file)) refuse(file, "The image is missing, or cannot be read");
    const std::string content{std::istreambuf_iterator<char>(stream), {}};
    if (content.starts_with("\xff\xd8\xff")) return greyOfJpeg(file);
    if (!content.starts_with("\x89PNG")) refuse(file, "The image is neither PNG nor JPEG");
    try { return greyOfPng(content); }
    catch (const DamagedImage& damage) { refuseDamaged(file, damage.what()); }
}

}
