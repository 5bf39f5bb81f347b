// SPDX-License-Identifier: GPL-3.0-or-later
#include "AngleCaption.H"

#include "core/dictionary/Dictionary.H"
#include "core/fieldFile/FieldFile.H"
#include "core/time/Time.H"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>
#include <vector>

namespace shizuku
{

namespace
{

using Row = std::map<std::string, std::string>;     // by the column's name without its unit

std::vector<std::string> cellsOf(const std::string& line)
{
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    return cells;
}

std::vector<Row> rowsAt(const std::filesystem::path& file, double time)
{
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    std::vector<std::string> names = cellsOf(line);
    for (std::string& name : names) name = name.substr(0, name.find(' '));

    std::vector<Row> rows;
    while (std::getline(in, line))
    {
        const std::vector<std::string> cells = cellsOf(line);
        Row row;
        for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i) row[names[i]] = cells[i];
        // The table holds nine digits.
        if (std::abs(std::atof(row["time"].c_str()) - time) <= 1e-8*std::abs(time)) rows.push_back(row);
    }
    return rows;
}

std::string degrees(const std::string& text, int digits)
{
    std::ostringstream out;
    out << std::fixed << std::setprecision(digits) << std::atof(text.c_str()) << "\u00B0";
    return out.str();
}

// Those of constant/wettability, and of the solid particles at the time; none where they go on from one to the next, or no model asks for them.
std::set<double> prescribedAngles(const std::filesystem::path& casePath, double time)
{
    constexpr std::size_t most = 10;
    std::set<double> angles;
    const auto models = casePath/"constant/models", wettability = casePath/"constant/wettability";
    if (std::filesystem::exists(models) && Dictionary::read(models).lookupOr<std::string>("wetting", "none") == "none") return {};
    if (std::filesystem::exists(wettability))
    {
        const Dictionary dict = Dictionary::read(wettability);
        for (const std::string& wall : dict.dictKeys())
        {
            if (const Dictionary entry = dict.subDict(wall); entry.found("theta")) angles.insert(entry.lookupOr<double>("theta", 0));
        }
    }
    const auto folder = findInstance(casePath, time, "solid/theta");
    if (!folder.empty())
    {
        const FieldData field = readField(folder/"solid/theta");
        angles = {field.values.begin(), field.values.end()};
    }
    return angles.size() <= most ? angles : std::set<double>();
}

// The answer of a drop's row; tables of older versions have the sphere's angle alone.
std::string angleOf(Row& row)
{
    return row.contains("contactAngle") ? row["contactAngle"] : row["angle"];
}

// A table has the mean below the drop: told where it is one of those that were prescribed.
std::string describe(Row& row, const std::set<double>& angles)
{
    constexpr double digits = 0.05;     // degrees
    std::string text = row["state"] == "attached" ? "contact angle " + degrees(angleOf(row), 1) : row["state"];
    const double prescribed = std::atof(row["prescribed"].c_str());
    const bool is = std::any_of(angles.begin(), angles.end(), [&](double angle) { return std::abs(angle - prescribed) < digits; });
    if (is) text += " (prescribed " + degrees(row["prescribed"], 0) + ")";
    return text;
}

constexpr std::size_t mostLines = 3;

// "5 drops attached: contact angle 21.0° to 21.2°", a line for each state.
std::string summarise(std::vector<Row>& rows)
{
    std::map<std::string, std::vector<double>> angles;
    for (Row& row : rows) angles[row["state"]].push_back(std::atof(angleOf(row).c_str()));
    std::ostringstream out;
    out << std::fixed << std::setprecision(1);
    for (const auto& [state, values] : angles)
    {
        if (out.tellp() > 0) out << '\n';
        out << values.size() << (values.size() == 1 ? " drop " : " drops ") << state;
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        if (state == "attached") out << ": contact angle " << *least << "\u00B0 to " << *most << "\u00B0";
    }
    return out.str();
}

}

std::string angleCaption(const std::filesystem::path& casePath, double time)
{
    std::filesystem::path newest;
    const auto folder = casePath/"postProcessing";
    if (!std::filesystem::is_directory(folder)) return "";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    {
        const auto& file = entry.path();
        const bool table = file.filename() == "angle.csv" || file.filename() == "contactAngle.csv";
        if (!table || rowsAt(file, time).empty()) continue;
        const bool newer = newest.empty()
          || std::filesystem::last_write_time(file) > std::filesystem::last_write_time(newest);
        if (newer) newest = file;
    }
    if (newest.empty()) return "";

    std::vector<Row> rows = rowsAt(newest, time);
    if (rows.size() > mostLines) return summarise(rows);
    const std::set<double> angles = prescribedAngles(casePath, time);
    std::string text;
    for (Row& row : rows)
    {
        if (!text.empty()) text += '\n';
        text += describe(row, angles);
    }
    return text;
}

}
