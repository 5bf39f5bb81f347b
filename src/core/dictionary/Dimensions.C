// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/Dimensions.H"

#include "core/dictionary/TextCharacters.H"

#include <boost/spirit/home/x3.hpp>

#include <algorithm>
#include <map>
#include <sstream>
#include <vector>

namespace shizuku
{

namespace
{

namespace x3 = boost::spirit::x3;

const std::map<std::string, Dimensions>& units()
{
    static const std::map<std::string, Dimensions> table
    {
        {"kg", {{1}}}, {"m", {{0, 1}}}, {"s", {{0, 0, 1}}}, {"K", {{0, 0, 0, 1}}}, {"mol", {{0, 0, 0, 0, 1}}},
        {"A", {{0, 0, 0, 0, 0, 1}}}, {"cd", {{0, 0, 0, 0, 0, 0, 1}}}, {"rad", {}}, {"Hz", {{0, 0, -1}}},
        {"N", {{1, 1, -2}}}, {"Pa", {{1, -1, -2}}}, {"J", {{1, 2, -2}}}, {"W", {{1, 2, -3}}}
    };
    return table;
}

std::optional<Dimensions> fromExponents(const std::string& text)
{
    std::vector<double> exponents;
    auto first = text.begin();
    if (!x3::phrase_parse(first, text.end(), *x3::double_ >> x3::eoi, textCharacters::space, exponents)) return {};
    if (exponents.size() != 0 && exponents.size() != 5 && exponents.size() != 7) return {};
    Dimensions result;
    std::copy(exponents.begin(), exponents.end(), result.exponents.begin());
    return result;
}

// unit(^exponent)? joined by blanks, '*' or '/'; a '/' divides by the one unit behind it.
std::optional<Dimensions> fromUnits(const std::string& text)
{
    Dimensions result;
    double sign = 1;
    std::string unit;
    bool known = true;

    const auto setUnit = [&](auto& context) { unit.assign(_attr(context).begin(), _attr(context).end()); };
    const auto divide = [&](auto&) { sign = -1; };
    const auto multiply = [&](double power)
    {
        const auto found = units().find(unit);
        known = known && found != units().end();
        for (int i = 0; known && i < 7; ++i) result.exponents[i] += sign*power*found->second.exponents[i];
        sign = 1;
    };
    const auto power = [&](auto& context) { multiply(_attr(context)); };
    const auto single = [&](auto&) { multiply(1); };

    const auto factor = x3::lexeme[x3::raw[+textCharacters::alpha][setUnit] >> ('^' >> x3::double_[power] | x3::eps[single])];
    const auto one = x3::lit('1');
    auto first = text.begin();
    const bool matched = x3::phrase_parse
    (
        first, text.end(), (factor | one) >> *(x3::lit('/')[divide] >> factor | -x3::lit('*') >> factor) >> x3::eoi,
        textCharacters::space
    );
    if (!matched || !known) return {};
    return result;
}

}

std::string Dimensions::str() const
{
    std::ostringstream text;
    text << '[';
    for (std::size_t i = 0; i < exponents.size(); ++i) text << (i ? " " : "") << exponents[i];
    text << ']';
    return text.str();
}

std::optional<Dimensions> parseDimensions(const std::string& text)
{
    if (const auto result = fromExponents(text)) return result;
    return fromUnits(text);
}

}
