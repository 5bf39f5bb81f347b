// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/VtkConversion.H"

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
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

}
