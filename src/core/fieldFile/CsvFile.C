// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/CsvFile.H"

#include "core/fieldFile/AtomicFile.H"

#include <charconv>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace shizuku
{

namespace
{

std::string cellText(double value)
{
    if (std::isnan(value)) return "nan";            // whatever its sign
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 9).ptr;
    return {text, end};
}

// Quoted where it has to be (RFC 4180).
std::string cellText(const std::string& value)
{
    if (value.find_first_of(",\"\r\n") == std::string::npos) return value;
    std::string quoted = "\"";
    for (const char character : value)
    {
        if (character == '"') quoted += '"';
        quoted += character;
    }
    return quoted + '"';
}

}

CsvFile::CsvFile(std::filesystem::path file, std::vector<Column> columns)
    : file_(std::move(file))
{
    const char* separator = "";
    for (const Column& column : columns)
    {
        header_ += std::exchange(separator, ",");
        columns_.push_back(column.name);
        titles_.push_back(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
        header_ += cellText(titles_.back());
    }
    header_ += '\n';
}

void CsvFile::addRow(const std::vector<Cell>& cells)
{
    if (cells.size() != columns_.size()) throw std::logic_error("CsvFile: a row has not one cell a column");
    const char* separator = "";
    for (const Cell& cell : cells)
    {
        unwritten_ += std::exchange(separator, ",");
        std::visit([&](const auto& value) { unwritten_ += cellText(value); }, cell);
    }
    unwritten_ += '\n';
    lastRow_ = cells;
    ++rows_;
}

WriteJob CsvFile::writing() const
{
    return [file = file_, header = header_, isFirst = !std::exchange(begun_, true), rows = std::exchange(unwritten_, {})]
    {
        writeAtomically(file, [&](std::ostream& stream)
        {
            std::ifstream before;
            if (!isFirst) before.open(file, std::ios::binary);
            if (before.is_open() && before.peek() != std::ifstream::traits_type::eof()) stream << before.rdbuf();
            else stream << header;
            stream << rows;
        });
    };
}

}
