#include "support/FlowCase.H"

namespace shizuku::test
{

FlowCase::FlowCase(const std::string& functions, const CaseText& text, const std::string& models) : LiquidCase(text)
{
    folder.write("0/liquid/positions", "");
    folder.write("system/controlDict", "endTime 100; deltaT 0.25; writeInterval 1; functions { " + functions + " }");
    folder.write
    (
        "constant/models", "pressure none; surfaceTension none; wetting none; viscosity none; bodyForce none;\n" + models
    );
    models_ = std::make_unique<Models>(folder.path(), Dictionary(), liquid, walls);
    time_ = std::make_unique<Time>(folder.path());
    functions_ = std::make_unique<FunctionObjects>(*time_, true);
    view_ = std::make_unique<FlowView>(*time_, liquid, near, walls, *models_);
}

void FlowCase::step(const std::vector<Vec3>& positions, const std::vector<Vec3>& velocities)
{
    place(positions, velocities);
    time_->advance();
    view_->moved();
    functions_->execute(*view_);
}

std::string FlowCase::table(const std::string& name)
{
    functions_->write();
    return folder.read("postProcessing/" + name);
}

}
