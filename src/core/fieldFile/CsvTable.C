// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/CsvTable.H"

#include "core/messages/Error.H"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>

namespace shizuku
{

namespace
{

// Cells of a line (RFC 4180, but for line breaks inside of a cell).
std::vector<std::string> split(const std::string& line)
{
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i)
    {
        const char c = line[i];
        if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') cells.back() += line[++i];
        else if (c == '"') quoted = !quoted;
        else if (c == ',' && !quoted) cells.emplace_back();
        else if (c != '\r') cells.back() += c;
    }
    return cells;
}

}

CsvTable CsvTable::read(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    std::string line;
    if (!std::getline(stream, line)) throw FatalInputError({file.string(), 0}, "The table is missing or empty");

    CsvTable table;
    table.file_ = file;
    for (const std::string& name : split(line)) table.columns_.push_back(name.substr(0, name.find(" [")));
    for (int number = 2; std::getline(stream, line); ++number)
    {
        table.cells_.push_back(split(line));
        if (table.cells_.back().size() == table.columns_.size()) continue;
        throw FatalInputError
        (
            {file.string(), number}, "The line has " + std::to_string(table.cells_.back().size()) + " cells",
            std::to_string(table.columns_.size()) + ", one for each column"
        );
    }
    return table;
}

bool CsvTable::has(const std::string& column) const
{
    return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
}

std::size_t CsvTable::place(const std::string& column) const
{
    const auto found = std::find(columns_.begin(), columns_.end(), column);
    if (found != columns_.end()) return found - columns_.begin();
    throw FatalInputError
    (
        {file_.string(), 1}, "The table has no column '" + column + "'", "one of the columns below", columns_, column
    );
}

const std::string& CsvTable::text(std::size_t row, const std::string& column) const
{
    return cells_[row][place(column)];
}

double CsvTable::number(std::size_t row, const std::string& column) const
{
    const std::string& cell = text(row, column);
    double value = std::numeric_limits<double>::quiet_NaN();
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error == std::errc() && end == cell.data() + cell.size()) return value;
    throw FatalInputError({file_.string(), int(row) + 2}, "The cell '" + cell + "' of " + column + " is no number");
}

std::vector<double> CsvTable::numbers(const std::string& column) const
{
    std::vector<double> values;
    for (std::size_t row = 0; row < rows(); ++row) values.push_back(number(row, column));
    return values;
}

void CsvTable::continueWith(const CsvTable& other, const std::string& column)
{
    if (other.columns_ != columns_)
    {
        throw FatalInputError({other.file_.string(), 1}, "The columns are not those of " + file_.string());
    }
    if (other.rows() == 0) return;
    const double begin = other.number(0, column);
    while (rows() > 0 && number(rows() - 1, column) >= begin) cells_.pop_back();
    cells_.insert(cells_.end(), other.cells_.begin(), other.cells_.end());
}

}
