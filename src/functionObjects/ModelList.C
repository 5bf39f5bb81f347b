// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/ModelList.H"

#include "functionObjects/FunctionObject.H"
#include "models/Models.H"

#include <iomanip>
#include <sstream>

namespace shizuku
{

namespace
{

template<class Table>
std::string paragraph(const std::string& heading)
{
    constexpr int column = 24;              // where what it is begins
    std::ostringstream text;
    text << heading << "\n";
    for (const auto& [word, summary] : Table::summaries()) text << "    " << std::left << std::setw(column) << word << summary << "\n";
    return text.str();
}

}

std::string modelList()
{
    return paragraph<PressureTable>("pressure") + paragraph<SurfaceTensionTable>("surfaceTension") + paragraph<WettingTable>("wetting") +
        paragraph<ViscosityTable>("viscosity") + paragraph<VelocityCorrectionTable>("velocityCorrection") +
        paragraph<ParticleShiftingTable>("particleShifting") + paragraph<BodyForceTable>("bodyForce") +
        paragraph<FunctionObjectTable>("functions (system/controlDict)");
}

}
