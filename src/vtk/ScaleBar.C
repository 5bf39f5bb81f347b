// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/ScaleBar.H"

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <array>
#include <cmath>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr double red = 0.15, green = 0.2, blue = 0.25;      // as of captions
constexpr double margin = 0.03;                             // parts of the picture's width
constexpr double thickness = 0.25;                          // font sizes

void addRectangle(vtkRenderer& renderer, double left, double right, double low, double high)
{
    vtkNew<vtkPoints> corners;
    for (const auto& [x, y] : {std::array{left, low}, std::array{right, low}, std::array{right, high}, std::array{left, high}}) corners->InsertNextPoint(x, y, 0);
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({0, 1, 2, 3});
    vtkNew<vtkPolyData> rectangle;
    rectangle->SetPoints(corners);
    rectangle->SetPolys(cells);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(rectangle);
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(red, green, blue);
    renderer.AddActor2D(actor);
}

}

double barLength(double width)
{
    constexpr double part = 0.25, rounding = 1 + 1e-9;
    const double longest = part*width*rounding, power = std::pow(10, std::floor(std::log10(longest))), factor = longest/power;
    return power*(factor < 2 ? 1 : factor < 5 ? 2 : 5);
}

std::string lengthText(double length)
{
    std::ostringstream text;
    text.precision(3);
    if (length < 0.999e-3) text << 1e6*length << " \u00B5m";
    else if (length < 0.999e-2) text << 1e3*length << " mm";
    else if (length < 0.999) text << 1e2*length << " cm";
    else text << length << " m";
    return text.str();
}

void addScaleBar(vtkRenderer& renderer, double width, int pixels, int fontSize)
{
    const double length = barLength(width), right = (1 - margin)*pixels, left = right - length/width*pixels, low = margin*pixels, high = low + thickness*fontSize;
    addRectangle(renderer, left, right, low, high);
    vtkNew<vtkTextActor> text;
    text->SetInput(lengthText(length).c_str());
    vtkTextProperty& font = *text->GetTextProperty();
    font.SetFontFamilyToArial();
    font.SetFontSize(fontSize);
    font.SetColor(red, green, blue);
    font.SetJustificationToCentered();
    text->SetPosition(0.5*(left + right), high + 0.3*fontSize);
    renderer.AddActor2D(text);
}

}
