// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/FieldCursor.H"

#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace shizuku
{

namespace
{

bool isBlank(char character)
{
    return character == ' ' || character == '\n' || character == '\t' || character == '\r';
}

bool endsWord(char character)
{
    return isBlank(character) || std::string_view(";(){}[]\"").find(character) != std::string_view::npos;
}

}

void FieldCursor::skipBlanks()
{
    const std::size_t size = text_.size();
    while (position_ < size)
    {
        if (isBlank(text_[position_]))
        {
            ++position_;
            continue;
        }
        const std::string_view next = text_.substr(position_, 2);
        if (next == "//") skipLine();
        else if (next == "/*") position_ = std::min(text_.find("*/", position_ + 2), size - 2) + 2;
        else return;
    }
}

void FieldCursor::skipLine()
{
    position_ = std::min(text_.find('\n', position_), text_.size());
}

bool FieldCursor::accept(char character)
{
    skipBlanks();
    if (remaining() == 0 || text_[position_] != character) return false;
    ++position_;
    return true;
}

void FieldCursor::expect(char character, const std::string& what)
{
    if (!accept(character)) fail("'" + std::string(1, character) + "' " + what);
}

std::string FieldCursor::word()
{
    skipBlanks();
    const auto begin = text_.begin() + position_;
    const auto end = std::find_if(begin, text_.end(), endsWord);
    position_ += end - begin;
    return {begin, end};
}

double FieldCursor::number(const std::string& what)
{
    skipBlanks();
    const char* begin = data();
    const char* end = text_.data() + text_.size();
    if (begin != end && *begin == '+') ++begin;
    double value = 0;
    const auto result = std::from_chars(begin, end, value);
    if (result.ec == std::errc::invalid_argument) fail(what);
    if (result.ec == std::errc::result_out_of_range)
    {
        // Too small becomes 0, too large infinity.
        value = std::strtod(std::string(begin, result.ptr).c_str(), nullptr);
    }
    position_ = result.ptr - text_.data();
    return value;
}

long FieldCursor::integer(const std::string& what)
{
    skipBlanks();
    const char* end = text_.data() + text_.size();
    long value = 0;
    const auto result = std::from_chars(data(), end, value);
    const bool goesOn = result.ptr != end && (*result.ptr == '.' || *result.ptr == 'e' || *result.ptr == 'E');
    if (result.ec != std::errc() || goesOn) fail(what);
    position_ = result.ptr - text_.data();
    return value;
}

std::size_t FieldCursor::skipEntry()
{
    int depth = 0;
    while (!atEnd())
    {
        const char character = text_[position_];
        if (character == '"')
        {
            ++position_;
            while (remaining() > 0 && text_[position_] != '"') position_ = std::min(position_ + (text_[position_] == '\\' ? 2 : 1), text_.size());
            if (position_ >= text_.size()) break;
        }
        else if (character == '(' || character == '{' || character == '[') ++depth;
        else if (character == ')' || character == '}' || character == ']') --depth;
        ++position_;
        if (depth <= 0 && (character == ';' || character == '}')) return position_ - 1;
    }
    position_ = text_.size();
    return position_;
}

SourceLocation FieldCursor::where() const
{
    const auto before = text_.substr(0, position_);
    return {file_, 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'))};
}

void FieldCursor::fail(const std::string& expected)
{
    skipBlanks();
    if (remaining() == 0) throw FatalInputError(where(), "The file ends too early", expected);
    const SourceLocation place = where();
    std::string found = word();
    if (found.empty()) found = text_.substr(position_, 1);
    throw FatalInputError(place, "Found '" + found.substr(0, 40) + "'", expected);
}

}
