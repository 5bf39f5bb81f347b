// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/VtkConversion.H"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>

namespace shizuku
{

vtkSmartPointer<vtkPoints> toPoints(const std::vector<Vector3>& points)
{
    const auto result = vtkSmartPointer<vtkPoints>::New();
    result->SetDataTypeToFloat();
    result->SetNumberOfPoints(vtkIdType(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        result->SetPoint(vtkIdType(i), points[i].x, points[i].y, points[i].z);
    }
    return result;
}

vtkSmartPointer<vtkPolyData> toPolyData(const TriangleMesh& mesh)
{
    const auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(toPoints(mesh.vertices));

    vtkNew<vtkCellArray> triangles;
    for (const auto& [i, j, k] : mesh.faces) triangles->InsertNextCell({i, j, k});
    data->SetPolys(triangles);

    if (!mesh.normals.empty())
    {
        vtkNew<vtkFloatArray> normals;
        normals->SetName("normals");
        normals->SetNumberOfComponents(3);
        for (const Vector3& n : mesh.normals) normals->InsertNextTuple3(n.x, n.y, n.z);
        data->GetPointData()->SetNormals(normals);
    }
    return data;
}

TriangleMesh toTriangleMesh(vtkPolyData& data)
{
    TriangleMesh mesh;
    vtkDataArray* const normals = data.GetPointData()->GetNormals();
    for (vtkIdType i = 0; i < data.GetNumberOfPoints(); ++i)
    {
        double x[3];
        data.GetPoint(i, x);
        mesh.vertices.emplace_back(x[0], x[1], x[2]);
        if (!normals) continue;
        normals->GetTuple(i, x);
        mesh.normals.emplace_back(x[0], x[1], x[2]);
    }
    vtkNew<vtkIdList> corners;
    vtkCellArray& polygons = *data.GetPolys();
    for (polygons.InitTraversal(); polygons.GetNextCell(corners);)
    {
        if (corners->GetNumberOfIds() != 3) continue;
        mesh.faces.push_back({int(corners->GetId(0)), int(corners->GetId(1)), int(corners->GetId(2))});
    }
    return mesh;
}

}
