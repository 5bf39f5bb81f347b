// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/ExpansionLimits.H"

#include "core/dictionary/InputLimits.H"

#include <algorithm>

namespace shizuku
{

namespace
{

struct Extent
{
    std::size_t items = 1;
    std::size_t depth = 1;
};

Extent extentOf(const Tree& node)
{
    Extent extent;
    for (const auto& [key, child] : node)
    {
        const Extent inner = extentOf(child);
        extent.items += inner.items;
        extent.depth = std::max(extent.depth, inner.depth + 1);
    }
    return extent;
}

void require(bool holds, const SourceLocation& where, const std::string& found, std::size_t limit, const std::string& unit)
{
    if (!holds) throw FatalInputError(where, found, "at most " + std::to_string(limit) + " " + unit);
}

}

void ExpansionLimits::include(const SourceLocation& where, std::size_t open)
{
    require(open <= inputLimits::includesInIncludes, where, "Includes are nested too deep", inputLimits::includesInIncludes,
        "files that include one another");
    require(++includes_ <= inputLimits::includes, where, "Too many files are included", inputLimits::includes,
        "includes in one dictionary");
}

void ExpansionLimits::read(const SourceLocation& where, std::size_t bytes)
{
    bytes_ += bytes;
    require(bytes_ <= inputLimits::text, where, "The dictionary is too long", inputLimits::text >> 20,
        "MB of text with all that it includes");
}

void ExpansionLimits::copy(const SourceLocation& where, const std::string& name, const Tree& source, std::size_t level)
{
    const Extent extent = extentOf(source);
    require(extent.depth + level <= inputLimits::nesting, where, "$" + name + " nests lists or dictionaries too deep",
        inputLimits::nesting, "levels");
    items_ += extent.items;
    require(items_ <= inputLimits::macroItems, where, "Macros copy too much, the last of them $" + name,
        inputLimits::macroItems, "entries and items in one dictionary");
}

void ExpansionLimits::lookUp(const SourceLocation& where, const std::string& name, std::size_t entries)
{
    lookups_ += entries;
    require(lookups_ <= inputLimits::macroLookups, where, "Macros take too long to find, the last of them $" + name,
        inputLimits::macroLookups, "entries that are looked at in one dictionary");
}

ExpansionLimits::Nested::Nested(ExpansionLimits& limits, const SourceLocation& where) : limits_(limits)
{
    require(limits_.nested_ < inputLimits::macrosInMacros, where, "Macros are nested too deep", inputLimits::macrosInMacros,
        "macros within one another");
    ++limits_.nested_;
}

}
