// SPDX-License-Identifier: GPL-3.0-or-later
#include "AngleCaption.H"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <map>
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

std::string describe(Row& row)
{
    std::string text = row["state"] == "attached" ? "contact angle " + degrees(row["angle"], 1) : row["state"];
    const std::string& prescribed = row["prescribed"];
    if (!std::isnan(std::atof(prescribed.c_str()))) text += " (prescribed " + degrees(prescribed, 0) + ")";
    return text;
}

constexpr std::size_t mostLines = 3;

// "5 drops attached: contact angle 21.0° to 21.2°", a line for each state.
std::string summarise(std::vector<Row>& rows)
{
    std::map<std::string, std::vector<double>> angles;
    for (Row& row : rows) angles[row["state"]].push_back(std::atof(row["angle"].c_str()));
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
    std::string text;
    for (Row& row : rows)
    {
        if (!text.empty()) text += '\n';
        text += describe(row);
    }
    return text;
}

}
