// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/FieldListReader.H"

#include "core/dictionary/InputLimits.H"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <type_traits>

namespace shizuku
{

static_assert(std::endian::native == std::endian::little, "binary fields are little endian");

namespace
{

constexpr long largestExactInteger = 1L << 53;     // in a double

std::string elementName(std::size_t element)
{
    return "element " + std::to_string(element);
}

bool isGood(double value) { return std::isfinite(value); }
bool isGood(long value) { return std::labs(value) <= largestExactInteger; }

[[noreturn]] void refuse(const SourceLocation& where, double value, std::size_t element)
{
    const std::string text = std::isnan(value) ? "NaN" : "infinite";
    throw FatalInputError(where, "The value of " + elementName(element) + " is " + text, "a finite number");
}

[[noreturn]] void refuse(const SourceLocation& where, long value, std::size_t element)
{
    throw FatalInputError
    (
        where, "The label " + std::to_string(value) + " of " + elementName(element) + " is too large", "at most 2^53"
    );
}

long readLength(FieldCursor& cursor)
{
    const long length = cursor.integer("the number of elements");
    if (length >= 0) return length;
    throw FatalInputError
    (
        cursor.where(), "The list has the length " + std::to_string(length), "a number that is not negative"
    );
}

double readComponent(FieldCursor& cursor, FieldType type, std::size_t element)
{
    if (type == FieldType::label)
    {
        const long value = cursor.integer("an integer for " + elementName(element));
        if (!isGood(value)) refuse(cursor.where(), value, element);
        return static_cast<double>(value);
    }
    cursor.skipBlanks();
    const double value = cursor.number("a number for " + elementName(element));
    if (!isGood(value)) refuse(cursor.where(), value, element);
    return value;
}

void readElement(FieldCursor& cursor, FieldType type, std::vector<double>& values)
{
    const std::size_t element = values.size() / componentsOf(type);
    if (type != FieldType::vector)
    {
        values.push_back(readComponent(cursor, type, element));
        return;
    }
    if (!cursor.accept('(')) cursor.fail("'(' of the vector of " + elementName(element));
    for (int component = 0; component < 3; ++component) values.push_back(readComponent(cursor, type, element));
    if (!cursor.accept(')')) cursor.fail("')' behind three components of " + elementName(element));
}

void checkLength(const SourceLocation& where, long elements, long expectedElements)
{
    if (expectedElements < 0 || elements == expectedElements) return;
    throw FatalInputError
    (
        where, "The field has " + std::to_string(elements) + " elements",
        std::to_string(expectedElements) + " elements, one a particle"
    );
}

}

std::vector<double> readAsciiList(FieldCursor& cursor, FieldType type, long expectedElements)
{
    std::vector<double> values;
    cursor.skipBlanks();
    const SourceLocation start = cursor.where();
    const bool counted = cursor.remaining() > 0 && *cursor.data() != '(';
    const long length = counted ? readLength(cursor) : 0;
    if (counted) checkLength(start, length, expectedElements);

    if (counted && cursor.accept('{'))
    {
        if (expectedElements < 0 && length > long(inputLimits::listValues))
        {
            throw FatalInputError
            (
                start, "The list has " + std::to_string(length) + " equal elements",
                "at most " + std::to_string(inputLimits::listValues) + ", or its elements one by one"
            );
        }
        readElement(cursor, type, values);
        cursor.expect('}', "behind the value of all elements");
        const std::vector<double> element = values;
        values.clear();
        values.reserve(length * element.size());
        for (long i = 0; i < length; ++i) values.insert(values.end(), element.begin(), element.end());
        return values;
    }

    cursor.expect('(', "before the list");
    // Two characters a number is the least: a length that is a lie reserves no more than the file's size.
    values.reserve(std::min<std::size_t>(length, cursor.remaining() / 2) * componentsOf(type));
    while (!cursor.accept(')')) readElement(cursor, type, values);

    const long found = values.size() / componentsOf(type);
    if (counted && found != length)
    {
        throw FatalInputError
        (
            cursor.where(), "The list has " + std::to_string(found) + " elements",
            "the " + std::to_string(length) + " that stand before it"
        );
    }
    checkLength(start, found, expectedElements);
    return values;
}

BinaryList::BinaryList(FieldCursor& cursor, FieldType type, const BinaryLayout& layout, long expectedElements)
    : type_(type), bytes_(type == FieldType::label ? layout.labelBytes : layout.scalarBytes)
{
    cursor.skipBlanks();
    const SourceLocation start = cursor.where();
    const long length = readLength(cursor);
    checkLength(start, length, expectedElements);
    elements_ = length;
    if (length == 0)
    {
        // OpenFOAM writes an empty list as "0" alone or as "0()".
        if (cursor.accept('(')) cursor.expect(')', "of the empty list");
        return;
    }
    cursor.expect('(', "before the raw values");
    raw_ = cursor.data();
    where_ = cursor.where();

    const std::size_t size = static_cast<std::size_t>(bytes_) * componentsOf(type);
    const std::size_t there = cursor.remaining() / size;
    if (there < elements_)
    {
        throw FatalInputError
        (
            start, "The binary list is truncated: the file ends within " + elementName(there),
            std::to_string(length) + " elements of " + std::to_string(size) + " bytes"
        );
    }
    cursor.moveBy(elements_ * size);
    if (cursor.remaining() == 0 || *cursor.data() != ')')
    {
        throw FatalInputError
        (
            start, "The binary list does not end behind its " + std::to_string(length) + " elements",
            "')' there; a wrong length, or another arch than the header's"
        );
    }
    cursor.moveBy(1);
}

void BinaryList::read(std::size_t first, std::span<double> values) const
{
    if (type_ != FieldType::label) bytes_ == 4 ? convert<float>(first, values) : convert<double>(first, values);
    else bytes_ == 4 ? convert<std::int32_t>(first, values) : convert<std::int64_t>(first, values);
}

template<class T>
void BinaryList::convert(std::size_t first, std::span<double> values) const
{
    using Wide = std::conditional_t<std::is_integral_v<T>, long, double>;
    const char* const raw = raw_ + first * componentsOf(type_) * sizeof(T);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        T value;
        std::memcpy(&value, raw + i * sizeof(T), sizeof(T));
        if (!isGood(Wide(value))) refuse(where_, Wide(value), first + i / componentsOf(type_));
        values[i] = static_cast<double>(value);
    }
}

}
