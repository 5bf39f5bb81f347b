// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseResults.H"

#include "caseFiles/CaseGravity.H"
#include "caseFiles/LiquidFiles.H"
#include "core/dictionary/Dictionary.H"
#include "core/time/PostProcessing.H"
#include "meshes/PlyFile.H"
#include "reference/FlowNumbers.H"

#include <cmath>
#include <numbers>

namespace shizuku
{

Vector3 meanOf(const std::vector<Vector3>& places)
{
    Vector3 mean;
    for (const Vector3& x : places) mean = mean + (1.0/double(places.size()))*x;
    return mean;
}

namespace fs = std::filesystem;

CaseResults::CaseResults(const fs::path& casePath) : casePath_(casePath), times_(timeFolders(casePath))
{
    spacing = readSpacing(casePath);
    const Dictionary liquid = Dictionary::read(casePath/"constant/liquidProperties");
    rho = liquid.lookupPositive("rho", dimensions::density);
    nu = liquid.lookupPositive("nu", dimensions::kinematicViscosity, true);
    sigma = liquid.lookupPositive("sigma", dimensions::surfaceTension, true);

    gravity = length(caseGravity(casePath));
    if (times_.empty()) throw FatalInputError({casePath.string(), 0}, "The case has no time folder", "a case that has run");
}

std::size_t CaseResults::particles() const { return positions(times_.back()).size(); }

std::vector<Vector3> CaseResults::positions(const TimeFolder& time) const { return readLiquidPositions(time.path); }

TriangleMesh CaseResults::surface(const TimeFolder& time) const { return readPly(liquidSurfaceFile(time.path)); }

double CaseResults::radius() const { return std::cbrt(3*liquidVolume()/(4*std::numbers::pi)); }

double CaseResults::capillarySpeed() const { return shizuku::capillarySpeed(sigma, rho, liquidVolume()); }

CsvTable CaseResults::table(const std::string& name, const std::string& file) const
{
    return readTable(casePath_, name, file);
}

CsvFile CaseResults::output(const std::string& file, const std::vector<CsvFile::Column>& columns) const
{
    return CsvFile(casePath_/"postProcessing/compareReference"/file, columns);
}

}
