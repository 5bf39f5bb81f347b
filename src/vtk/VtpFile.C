// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/VtpFile.H"

#include "core/fieldFile/AtomicFile.H"
#include "core/messages/Error.H"
#include "vtk/VtkConversion.H"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataWriter.h>

#include <sstream>

namespace shizuku
{

namespace
{

const std::vector<std::pair<std::string, VtkEncoding>> encodings
{
    {"ascii", VtkEncoding::ascii}, {"binary", VtkEncoding::binary}, {"appended", VtkEncoding::appended}
};

// "m s^-1"; empty where there is none.
std::string unitOf(const Dimensions& dimensions)
{
    static constexpr std::array<const char*, 7> names{"kg", "m", "s", "K", "mol", "A", "cd"};
    std::ostringstream text;
    for (std::size_t k = 0; k < names.size(); ++k)
    {
        const double exponent = dimensions.exponents[k];
        if (exponent == 0) continue;
        text << (text.tellp() > 0 ? " " : "") << names[k];
        if (exponent != 1) text << '^' << exponent;
    }
    return text.str();
}

template<class Array> vtkSmartPointer<vtkDataArray> arrayOf(const FieldData& field, vtkIdType points)
{
    const auto array = vtkSmartPointer<Array>::New();
    array->SetName(field.name.c_str());
    array->SetNumberOfComponents(componentsOf(field.type));
    array->SetNumberOfTuples(points);
    for (vtkIdType i = 0; i < points; ++i)
    {
        for (int c = 0; c < componentsOf(field.type); ++c)
        {
            array->SetTypedComponent(i, c, typename Array::ValueType(field(std::size_t(i), c)));
        }
    }
    return array;
}

void addPointField(vtkPolyData& data, const FieldData& field)
{
    const vtkIdType points = data.GetNumberOfPoints();
    if (!field.uniform && vtkIdType(field.elements()) != points)
    {
        throw FatalError
        (
            "The field " + field.name + " has " + std::to_string(field.elements()) + " values for "
          + std::to_string(points) + " points"
        );
    }
    const auto array = field.type == FieldType::label
        ? arrayOf<vtkIntArray>(field, points)
        : arrayOf<vtkFloatArray>(field, points);
    const std::string unit = unitOf(field.dimensions);
    if (!unit.empty()) array->GetInformation()->Set(vtkDataArray::UNITS_LABEL(), unit.c_str());
    if (field.name == "normals") data.GetPointData()->SetNormals(array);
    else data.GetPointData()->AddArray(array);
}

vtkSmartPointer<vtkPolyData> polyDataOf(const VtpContent& content)
{
    const auto data = toPolyData({content.points, {}, content.triangles});
    if (content.triangles.empty())
    {
        vtkNew<vtkCellArray> cells;
        for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) cells->InsertNextCell(1, &i);
        data->SetVerts(cells);
    }
    for (const FieldData& field : content.pointFields) addPointField(*data, field);
    for (const auto& [name, value] : content.values)
    {
        vtkNew<vtkDoubleArray> array;
        array->SetName(name.c_str());
        array->InsertNextValue(value);
        data->GetFieldData()->AddArray(array);
    }
    return data;
}

}

std::vector<std::string> vtkEncodingWords()
{
    std::vector<std::string> words;
    for (const auto& [word, encoding] : encodings) words.push_back(word);
    return words;
}

VtkEncoding vtkEncodingFrom(const std::string& word)
{
    for (const auto& [valid, encoding] : encodings)
    {
        if (valid == word) return encoding;
    }
    throw FatalInputError({}, "Unknown format '" + word + "'", "", vtkEncodingWords(), word);
}

VtpContent vtpOf(const TriangleMesh& mesh)
{
    VtpContent content{mesh.vertices, mesh.faces, {}, {}};
    if (!mesh.normals.empty())
    {
        FieldData normals{"normals", FieldType::vector, dimensions::none, false, {}};
        for (const Vector3& n : mesh.normals) normals.values.insert(normals.values.end(), {n.x, n.y, n.z});
        content.pointFields.push_back(std::move(normals));
    }
    return content;
}

void writeVtp(const std::filesystem::path& file, const VtpContent& content, VtkEncoding encoding)
{
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(polyDataOf(content));
    writer->SetHeaderTypeToUInt64();
    writer->WriteToOutputStringOn();
    switch (encoding)
    {
        case VtkEncoding::ascii:
            writer->SetDataModeToAscii();
            break;
        case VtkEncoding::binary:
            writer->SetDataModeToBinary();
            writer->SetCompressorTypeToZLib();
            break;
        case VtkEncoding::appended:
            writer->SetDataModeToAppended();
            writer->EncodeAppendedDataOff();
            writer->SetCompressorTypeToZLib();
            break;
    }
    if (!writer->Write()) throw FatalError("VTK could not write " + file.string());
    writeAtomically(file, [&](std::ostream& out) { out << writer->GetOutputString(); });
}

}
