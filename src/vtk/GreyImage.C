// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/GreyImage.H"

#include "core/messages/Error.H"
#include "vtk/PngChunks.H"

#include <vtkCallbackCommand.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkImageReader2.h>
#include <vtkJPEGReader.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkSmartPointer.h>

#include <fstream>
#include <iterator>
#include <string>

namespace shizuku
{

namespace
{

const std::string damaged = "The image is damaged: it is not whole";

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& found)
{
    throw FatalInputError({file.string(), 0}, found, "a picture, PNG or JPEG");
}

vtkSmartPointer<vtkImageReader2> readerOf(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream || !std::filesystem::is_regular_file(file)) refuse(file, "The image is missing, or cannot be read");
    const std::string content{std::istreambuf_iterator<char>(stream), {}};

    vtkSmartPointer<vtkImageReader2> reader;
    if (content.starts_with("\xff\xd8\xff")) reader = vtkSmartPointer<vtkJPEGReader>::New();
    else if (content.starts_with("\x89PNG")) reader = vtkSmartPointer<vtkPNGReader>::New();
    else refuse(file, "The image is neither PNG nor JPEG");
    if (reader->IsA("vtkPNGReader") && !isWholePng(content)) refuse(file, damaged);
    reader->SetFileName(file.c_str());
    return reader;
}

// What the reader complains of goes into a message instead of to the terminal; its warnings are damage too.
void update(vtkImageReader2& reader, const std::filesystem::path& file)
{
    bool failed = false;
    vtkNew<vtkCallbackCommand> observer;
    observer->SetClientData(&failed);
    observer->SetCallback([](vtkObject*, unsigned long, void* data, void*) { *static_cast<bool*>(data) = true; });
    reader.AddObserver("ErrorEvent", observer);
    reader.AddObserver("WarningEvent", observer);
    reader.GetExecutive()->AddObserver("ErrorEvent", observer);
    reader.Update();
    if (failed || reader.GetErrorCode() != 0) refuse(file, damaged);
}

}

GreyImage readGreyImage(const std::filesystem::path& file)
{
    const auto reader = readerOf(file);
    update(*reader, file);

    vtkImageData& image = *reader->GetOutput();
    GreyImage result;
    result.width = image.GetDimensions()[0];
    result.height = image.GetDimensions()[1];
    if (result.width < 1 || result.height < 1) refuse(file, "The image has no pixels");
    const int components = image.GetNumberOfScalarComponents();
    const double white = image.GetScalarType() == VTK_FLOAT || image.GetScalarType() == VTK_DOUBLE
        ? 1 : image.GetScalarTypeMax();
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
