// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/FlowCase.H"

#include "core/fieldFile/BackgroundWriter.H"

#include <sstream>

namespace shizuku::test
{

FlowCase::FlowCase
(
    const std::string& functions, const CaseText& text, const std::string& models, const std::string& control
)
:
    LiquidCase(text)
{
    folder.write("0/liquid/positions", "");
    folder.write
    (
        "system/controlDict",
        "endTime 100; deltaT 0.25; writeInterval 1; " + control + "\nfunctions { " + functions + " }"
    );
    folder.write
    (
        "constant/models", "pressure none; surfaceTension none; wetting none; viscosity none; bodyForce none;\n" + models
    );
    models_ = std::make_unique<Models>(folder.path(), Dictionary(), liquid, walls);
    models_->takeEffect(liquid, walls);
    hasAngles_ = false;                     // unless these models want them
    time_ = std::make_unique<Time>(folder.path());
    view_ = std::make_unique<FlowView>(*time_, liquid, near, walls, *models_);
    functions_ = std::make_unique<FunctionObjects>(*time_, text.spacing, true);
    functions_->modelsMade(*view_);
}

void FlowCase::step(const std::vector<Vec3>& positions, const std::vector<Vec3>& velocities)
{
    place(positions, velocities);
    measure();
}

void FlowCase::measure()
{
    time_->advance();
    view_->moved(time_->deltaT());
    if (functions_->lookAtSurface(*time_)) view_->gatherSurface(functions_->lookAtWholeSurface(*time_));
    functions_->execute(*view_);
    if (view_->parts().part() > 0) return;
    BackgroundWriter writer;
    functions_->write(*time_, writer);
    writer.finish();
}

std::string FlowCase::table(const std::string& name) const
{
    return folder.read("postProcessing/" + name);
}

double FlowCase::value(const std::string& name, const std::string& column, int row) const
{
    const auto cells = [](const std::string& line)
    {
        std::vector<std::string> result;
        std::istringstream stream(line);
        for (std::string cell; std::getline(stream, cell, ',');) result.push_back(cell);
        return result;
    };
    std::vector<std::string> lines;
    std::istringstream stream(table(name));
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    if (lines.size() < 2) throw FatalError("No row in " + name);
    const auto head = cells(lines.front());
    for (std::size_t c = 0; c < head.size(); ++c)
    {
        if (head[c].substr(0, head[c].find(' ')) != column) continue;
        return std::stod(cells(row < 0 ? lines.back() : lines.at(row + 1)).at(c));
    }
    throw FatalError("No column " + column + " in " + name);
}

}
