// SPDX-License-Identifier: GPL-3.0-or-later
#include "liveView/CaseSliders.H"

#include "core/dictionary/Dictionary.H"
#include "core/dictionary/DictionaryEditor.H"
#include "core/dictionary/DictionaryExpansion.H"
#include "core/dictionary/SetEntry.H"
#include "core/fieldFile/AtomicFile.H"
#include "core/messages/Error.H"
#include "liveView/ViewFrame.H"

#include <algorithm>
#include <array>
#include <cmath>

namespace shizuku
{

namespace
{

const char* const wettabilityPath = "constant/wettability";
const char* const liquidPath = "constant/liquidProperties";
const char* const gravityPath = "constant/g";
const char* const modelsPath = "constant/models";

Dictionary readIfThere(const std::filesystem::path& file)
{
    return std::filesystem::exists(file) ? Dictionary::read(file) : Dictionary();
}

// Of walls and patches with one angle; a distribution of angles has no slider.
void addAngles(std::vector<CaseSlider>& sliders, const std::filesystem::path& casePath)
{
    const Dictionary wettability = readIfThere(casePath/wettabilityPath);
    for (const std::string& wall : wettability.dictKeys())
    {
        const Dictionary dict = wettability.subDict(wall);
        const bool isOne = dict.found("theta") && !dict.isDict("theta") && dict.lookupOr<std::string>("type", "constant") == "constant";
        if (!isOne || wall.find_first_of(" .\"") != std::string::npos) continue;
        sliders.push_back({"theta:" + wall, "Contact angle, " + wall, "\xc2\xb0", wettabilityPath, wall + ".theta", "", -1,
            dict.lookup<double>("theta"), 0, 180, false});
    }
}

void addLiquid(std::vector<CaseSlider>& sliders, const std::filesystem::path& casePath)
{
    const Dictionary liquid = Dictionary::read(casePath/liquidPath);
    const double sigma = liquid.lookupPositive("sigma", dimensions::surfaceTension, true);
    const double nu = liquid.lookupPositive("nu", dimensions::kinematicViscosity, true);
    sliders.push_back({"sigma", "Surface tension", "N/m", liquidPath, "sigma", "[1 0 -2 0 0 0 0] ", -1, sigma, 0, std::max(2*sigma, 0.1), false});
    sliders.push_back({"nu", "Viscosity", "m\xc2\xb2/s", liquidPath, "nu", "[0 2 -1 0 0 0 0] ", -1, nu,
        std::min(nu > 0 ? nu : 1e-6, 1e-6)/10, std::max(nu, 1e-6)*1000, true});
}

void addGravity(std::vector<CaseSlider>& sliders, const std::filesystem::path& casePath)
{
    const bool acts = readIfThere(casePath/modelsPath).lookupOr<std::string>("bodyForce", "none") == "gravity";
    if (!acts || !std::filesystem::exists(casePath/gravityPath)) return;
    const auto g = Dictionary::read(casePath/gravityPath).lookup<std::array<double, 3>>("value");
    const double most = 2*std::max({9.81, std::abs(g[0]), std::abs(g[1]), std::abs(g[2])});
    for (int i = 0; i < 3; ++i)
    {
        const std::string axis(1, char('x' + i));
        sliders.push_back({"g:" + axis, "Gravity " + axis, "m/s\xc2\xb2", gravityPath, "value", "", i, g[i], -most, most, false});
    }
}

void setInFile(const std::filesystem::path& file, const std::string& entry, const std::string& value)
{
    DictionaryEditor editor(readText(file), file.string());
    setEntry(editor, entry, value, file.string());
    writeAtomically(file, [&](std::ostream& stream) { stream << editor.text(); });
}

std::vector<CaseSlider>::const_iterator slider(const std::vector<CaseSlider>& sliders, const std::string& name)
{
    return std::find_if(sliders.begin(), sliders.end(), [&](const CaseSlider& one) { return one.name == name; });
}

}

CaseSliders::CaseSliders(std::filesystem::path casePath) : case_(std::move(casePath))
{
    for (const char* const file : {wettabilityPath, liquidPath, gravityPath, modelsPath}) files_.emplace_back(case_/file);
    sliders_ = read();
}

std::vector<CaseSlider> CaseSliders::read() const
{
    std::vector<CaseSlider> sliders;
    addAngles(sliders, case_);
    addLiquid(sliders, case_);
    addGravity(sliders, case_);
    return sliders;
}

bool CaseSliders::readIfChanged()
{
    bool changed = false;
    for (WatchedFile& file : files_) changed |= file.changed();
    if (!changed) return false;
    try
    {
        std::vector<CaseSlider> now = read();
        for (CaseSlider& one : now)
        {
            const auto former = slider(sliders_, one.name);
            if (former == sliders_.end()) continue;
            one.low = std::min(one.value, former->low);
            one.high = std::max(one.value, former->high);
        }
        sliders_ = std::move(now);
    }
    catch (const FatalInputError&) {}                   // half of an edit, of which the run warns
    return true;
}

void CaseSliders::set(const std::string& name, double value)
{
    const auto one = slider(sliders_, name);
    if (one == sliders_.end())
    {
        std::vector<std::string> names;
        for (const CaseSlider& each : sliders_) names.push_back(each.name);
        throw FatalInputError({}, "There is no slider '" + name + "'", "one of those below", names, name);
    }
    if (!(value >= one->low && value <= one->high))
    {
        throw FatalInputError({}, "The slider " + name + " cannot be " + jsonNumber(value), jsonNumber(one->low) + " to " + jsonNumber(one->high));
    }
    const auto file = case_/one->file;
    if (one->component < 0) return setInFile(file, one->entry, one->dimensions + jsonNumber(value));
    auto vector = Dictionary::read(file).lookup<std::array<double, 3>>(one->entry);
    vector[one->component] = value;
    setInFile(file, one->entry, "(" + jsonNumber(vector[0]) + " " + jsonNumber(vector[1]) + " " + jsonNumber(vector[2]) + ")");
}

std::string CaseSliders::json() const
{
    std::string text = "[";
    for (const CaseSlider& one : sliders_)
    {
        text += (text.size() > 1 ? ",{" : "{") + ("\"name\":" + jsonText(one.name)) + ",\"label\":" + jsonText(one.label)
            + ",\"unit\":" + jsonText(one.unit) + ",\"value\":" + jsonNumber(one.value) + ",\"low\":" + jsonNumber(one.low)
            + ",\"high\":" + jsonNumber(one.high) + ",\"log\":" + (one.isLogarithmic ? "true" : "false") + "}";
    }
    return text + "]";
}

}
