// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/PvtpFile.H"

#include "core/fieldFile/AtomicFile.H"
#include "core/messages/Error.H"
#include "core/paths/Existence.H"
#include "parallel/AllParts.H"
#include "vtk/VtkConversion.H"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <vtkNew.h>
#include <vtkXMLPolyDataReader.h>

namespace shizuku
{

namespace
{

namespace fs = std::filesystem;

fs::path folderOf(const fs::path& file) { return file.parent_path()/file.stem(); }

std::string pieceName(const fs::path& file, int part) { return file.stem().string() + "_" + std::to_string(part) + ".vtp"; }

// An array, as all pieces have it.
struct PieceArray
{
    char name[64];
    bool isLabel;
    int components;
};

std::vector<PieceArray> arraysOf(const VtpContent& content)
{
    std::vector<PieceArray> arrays;
    for (const FieldData& field : content.pointFields)
    {
        PieceArray array{{}, field.type == FieldType::label, componentsOf(field.type)};
        if (field.name.size() >= sizeof array.name) throw FatalError("The field's name " + field.name + " is too long for a file in pieces");
        field.name.copy(array.name, field.name.size());
        arrays.push_back(array);
    }
    return arrays;
}

boost::property_tree::ptree arrayElement(const std::string& name, bool isLabel, int components)
{
    boost::property_tree::ptree element;
    element.put("<xmlattr>.type", isLabel ? "Int32" : "Float32");
    element.put("<xmlattr>.Name", name);
    element.put("<xmlattr>.NumberOfComponents", components);
    return element;
}

void writeNames(const fs::path& file, const std::vector<PieceArray>& arrays, const std::vector<int>& parts)
{
    boost::property_tree::ptree tree, fields, points, data;
    for (const PieceArray& array : arrays)
    {
        if (std::string(array.name) == "normals") fields.put("<xmlattr>.Normals", "normals");
        fields.add_child("PDataArray", arrayElement(array.name, array.isLabel, array.components));
    }
    tree.put("VTKFile.<xmlattr>.type", "PPolyData");
    tree.put("VTKFile.<xmlattr>.version", "1.0");
    tree.put("VTKFile.<xmlattr>.byte_order", "LittleEndian");
    tree.put("VTKFile.<xmlattr>.header_type", "UInt64");
    points.add_child("PDataArray", arrayElement("Points", false, 3));
    data.put("<xmlattr>.GhostLevel", 0);
    data.add_child("PPointData", fields);
    data.add_child("PPoints", points);
    for (const int part : parts)
    {
        boost::property_tree::ptree piece;
        piece.put("<xmlattr>.Source", (file.stem()/pieceName(file, part)).string());
        data.add_child("Piece", piece);
    }
    tree.add_child("VTKFile.PPolyData", data);
    writeAtomically(file, [&](std::ostream& out)
    {
        boost::property_tree::write_xml(out, tree, boost::property_tree::xml_writer_make_settings<std::string>(' ', 2));
    });
}

// The parts whose pieces hold something; the first one where none does.
std::vector<int> partsWithPoints(const VtpContent& own, const Communicator& parts)
{
    const std::vector<std::size_t> points = parts.gather(own.points.size());
    std::vector<int> with;
    for (int part = 0; part < parts.parts(); ++part)
    {
        if (points[part] > 0) with.push_back(part);
    }
    return with.empty() ? std::vector<int>{0} : with;
}

}

void writePvtp(const fs::path& file, const VtpContent& own, VtkEncoding encoding, const Communicator& parts)
{
    const fs::path folder = folderOf(file), partial = partialPath(folder);
    const std::vector<int> with = partsWithPoints(own, parts);
    const bool isFirst = parts.part() == 0, writes = std::find(with.begin(), with.end(), parts.part()) != with.end();
    std::vector<PieceArray> arrays;
    inAllParts(parts, [&]
    {
        if (isFirst) fs::remove_all(partial);
    });
    try
    {
        inAllParts(parts, [&]
        {
            if (writes) writeVtp(partial/pieceName(file, parts.part()), own, encoding);
            if (parts.part() == with.front()) arrays = arraysOf(own);
        });
    }
    catch (...)
    {
        if (isFirst) fs::remove_all(partial);
        throw;
    }
    arrays = gatherListsAtFirst(parts, arrays);
    inAllParts(parts, [&]
    {
        if (!isFirst) return;
        fs::remove(file);
        putFolderInPlace(folder);
        writeNames(file, arrays, with);
    });
}

std::vector<fs::path> piecesOfPvtp(const fs::path& file)
{
    std::vector<fs::path> pieces;
    try
    {
        boost::property_tree::ptree tree;
        boost::property_tree::read_xml(file.string(), tree);
        for (const auto& [element, piece] : tree.get_child("VTKFile.PPolyData"))
        {
            if (element == "Piece") pieces.push_back(file.parent_path()/piece.get<std::string>("<xmlattr>.Source"));
        }
    }
    catch (const boost::property_tree::ptree_error& error)
    {
        throw FatalInputError({file.string(), 0}, std::string("The file names no pieces: ") + error.what(), "a .pvtp of meshSurface");
    }
    return pieces;
}

TriangleMesh readPieces(const std::vector<fs::path>& pieces)
{
    TriangleMesh all;
    for (const fs::path& file : pieces)
    {
        if (!isThere(file)) throw FatalInputError({file.string(), 0}, "The piece of the surface is missing", "what its .pvtp names: run meshSurface again");
        vtkNew<vtkXMLPolyDataReader> reader;
        reader->SetFileName(file.c_str());
        reader->Update();
        if (reader->GetErrorCode() != 0) throw FatalInputError({file.string(), 0}, "VTK cannot read the piece of the surface", "a .vtp of meshSurface");
        const TriangleMesh mesh = toTriangleMesh(*reader->GetOutput());
        const int before = int(all.vertices.size());
        all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
        all.normals.insert(all.normals.end(), mesh.normals.begin(), mesh.normals.end());
        for (const auto& [i, j, k] : mesh.faces) all.faces.push_back({before + i, before + j, before + k});
    }
    return all;
}

void removePvtp(const fs::path& file)
{
    fs::remove(file);
    removeFolderAtomically(folderOf(file));
}

}
