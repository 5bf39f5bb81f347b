#include "core/fieldFile/CsvFile.H"

#include "core/fieldFile/AtomicFile.H"

#include <charconv>
#include <cmath>
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
    : file_(std::move(file)), columns_(std::move(columns))
{}

void CsvFile::addRow(std::vector<Cell> cells)
{
    if (cells.size() != columns_.size()) throw std::logic_error("CsvFile: a row has not one cell a column");
    rows_.push_back(std::move(cells));
}

void CsvFile::write() const
{
    writeAtomically(file_, [&](std::ostream& stream)
    {
        const char* separator = "";
        for (const Column& column : columns_)
        {
            const std::string unit = column.unit.empty() ? "" : " [" + column.unit + "]";
            stream << std::exchange(separator, ",") << cellText(column.name + unit);
        }
        stream << "\n";
        for (const auto& row : rows_)
        {
            separator = "";
            for (const Cell& cell : row)
            {
                stream << std::exchange(separator, ",");
                std::visit([&](const auto& value) { stream << cellText(value); }, cell);
            }
            stream << "\n";
        }
    });
}

}
