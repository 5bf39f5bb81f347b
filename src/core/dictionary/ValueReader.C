// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/ValueReader.H"

#include "core/dictionary/InputLimits.H"

#include <charconv>
#include <cmath>
#include <map>

namespace shizuku
{

namespace
{

template<class Number>
bool toNumber(const std::string& text, Number& number)
{
    const char* first = text.data();
    const char* last = first + text.size();
    if (first != last && *first == '+') ++first;
    const auto [end, error] = std::from_chars(first, last, number);
    return error == std::errc() && end == last;
}

bool isToken(const Tree& item)
{
    return item.data().kind == NodeKind::word || item.data().kind == NodeKind::number;
}

}

ValueReader::ValueReader(const Tree& entry, std::string expected)
:
    ValueReader(entry, std::move(expected), entry.data().text)
{
    if (entry.data().kind == NodeKind::dictionary)
    {
        throw FatalInputError(entry.data().where, "'" + entry.data().text + "' is a dictionary", expected_);
    }
}

ValueReader::ValueReader(const Tree& items, std::string expected, std::string keyword)
:
    entry_(items), expected_(std::move(expected)), keyword_(std::move(keyword)), position_(items.begin()),
    last_(items.data().where)
{}

void ValueReader::fail(const std::string& found) const
{
    throw FatalInputError(last_, keyword_.empty() ? found : "Entry '" + keyword_ + "': " + found, expected_);
}

const Tree& ValueReader::next()
{
    if (atEnd()) fail(position_ == entry_.begin() ? "it has no value" : "its value ends too early");
    const Tree& item = position_->second;
    ++position_;
    last_ = item.data().where;
    return item;
}

void ValueReader::finish() const
{
    if (atEnd()) return;
    const Tree& excess = position_->second;
    const SourceLocation& at = excess.data().where;
    const bool otherLine = at.file == last_.file && at.line != last_.line;
    throw FatalInputError
    (
        otherLine ? last_ : at,
        "Entry '" + keyword_ + "': " + describe(excess) + " follows the value",
        otherLine ? expected_ + "; a ';' may be missing at the end of the line" : expected_
    );
}

template<class Number>
Number ValueReader::readNumber()
{
    const Tree& item = next();
    Number number = 0;
    if (!isToken(item) || !toNumber(item.data().text, number)) fail("found " + describe(item));
    return number;
}

template<>
double ValueReader::read<double>()
{
    const double number = readNumber<double>();
    if (!std::isfinite(number))
    {
        expected_ = "a finite number";
        fail("found " + std::to_string(number));
    }
    return number;
}

template<> long ValueReader::read<long>() { return readNumber<long>(); }
template<> int ValueReader::read<int>() { return readNumber<int>(); }

template<>
bool ValueReader::read<bool>()
{
    static const std::map<std::string, bool> switches
    {
        {"on", true}, {"yes", true}, {"true", true}, {"off", false}, {"no", false}, {"false", false}
    };
    const Tree& item = next();
    const auto found = isToken(item) ? switches.find(item.data().text) : switches.end();
    if (found == switches.end()) fail("found " + describe(item));
    return found->second;
}

template<>
std::string ValueReader::read<std::string>()
{
    const Tree& item = next();
    const NodeKind kind = item.data().kind;
    if (!isToken(item) && kind != NodeKind::string && kind != NodeKind::verbatim) fail("found " + describe(item));
    return item.data().text;
}

template<>
std::array<double, 3> ValueReader::read<std::array<double, 3>>()
{
    const Tree& item = next();
    if (item.data().kind != NodeKind::list || item.size() != 3) fail("found " + describe(item));
    ValueReader components(item, expected_, keyword_);
    const double x = components.read<double>(), y = components.read<double>(), z = components.read<double>();
    return {x, y, z};
}

std::string ValueReader::readListHead()
{
    const auto nextIs = [&](NodeKind kind) { return !atEnd() && position_->second.data().kind == kind; };
    if (nextIs(NodeKind::word) && position_->second.data().text == "nonuniform") next();
    if (nextIs(NodeKind::word) && position_->second.data().text.starts_with("List<")) next();
    return nextIs(NodeKind::number) ? next().data().text : "";
}

template<class T>
std::vector<T> ValueReader::readList()
{
    std::string size = readListHead();
    if (atEnd() && size == "0") return {};      // "nonuniform List<scalar> 0;"
    const Tree& item = next();
    const NodeData& data = item.data();
    const bool isList = data.kind == NodeKind::list || data.kind == NodeKind::uniformList;
    if (!isList) fail("found " + describe(item));
    if (size.empty()) size = data.text;
    std::size_t count = item.size();
    if (!size.empty() && !toNumber(size, count)) fail("the size of a list is " + size);

    ValueReader elements(item, expected_, keyword_);
    if (data.kind == NodeKind::uniformList)
    {
        if (count > inputLimits::listValues) fail("the size of a list is " + size + ", more than " + std::to_string(inputLimits::listValues));
        const T value = elements.read<T>();
        if (!elements.atEnd()) fail("more than one value in " + size + "{ }");
        return std::vector<T>(count, value);
    }

    std::vector<T> values;
    while (!elements.atEnd()) values.push_back(elements.read<T>());
    if (values.size() != count)
    {
        fail("the list holds " + std::to_string(values.size()) + " values, but its size is given as " + size);
    }
    return values;
}

template<> std::vector<double> ValueReader::read() { return readList<double>(); }
template<> std::vector<int> ValueReader::read() { return readList<int>(); }
template<> std::vector<long> ValueReader::read() { return readList<long>(); }
template<> std::vector<bool> ValueReader::read() { return readList<bool>(); }
template<> std::vector<std::string> ValueReader::read() { return readList<std::string>(); }
template<> std::vector<std::array<double, 3>> ValueReader::read() { return readList<std::array<double, 3>>(); }

std::optional<Dimensions> ValueReader::readDimensions()
{
    auto item = position_;
    if (item == entry_.end()) return {};
    if (item->second.data().kind == NodeKind::word && std::next(item) != entry_.end()) ++item;     // the entry's name
    if (item->second.data().kind != NodeKind::dimensions) return {};
    position_ = item;
    const Tree& set = next();
    const std::optional<Dimensions> dimensions = parseDimensions(set.data().text);
    if (!dimensions)
    {
        throw FatalInputError
        (
            set.data().where, "Entry '" + keyword_ + "': [" + set.data().text + "] is no dimension set",
            "7 exponents of kg m s K mol A cd, e.g. [0 2 -1 0 0 0 0], or units, e.g. [m^2/s]"
        );
    }
    return dimensions;
}

}
