// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/Dictionary.H"
#include "core/dictionary/DictionaryNode.H"
#include "core/dictionary/ValueReader.H"

#include <algorithm>
#include <array>
#include <sstream>

namespace shizuku
{

namespace
{

// What a type looks like in a dictionary, for messages.
template<class T> const char* form();
template<> const char* form<double>() { return "a number"; }
template<> const char* form<int>() { return "an integer"; }
template<> const char* form<long>() { return "an integer"; }
template<> const char* form<bool>() { return "one of on, off, yes, no, true, false"; }
template<> const char* form<std::string>() { return "one word or one string in quotes"; }
template<> const char* form<std::array<double, 3>>() { return "a vector (x y z)"; }
template<> const char* form<std::vector<double>>() { return "a list of numbers ( .. )"; }
template<> const char* form<std::vector<int>>() { return "a list of integers ( .. )"; }
template<> const char* form<std::vector<long>>() { return "a list of integers ( .. )"; }
template<> const char* form<std::vector<bool>>() { return "a list of on, off, yes, no, true, false"; }
template<> const char* form<std::vector<std::string>>() { return "a list of words or strings ( .. )"; }
template<> const char* form<std::vector<std::array<double, 3>>>() { return "a list of vectors ( (x y z) .. )"; }

// [name] [dimensions] value;
template<class T>
T readDimensioned(const Tree& entry, const Dimensions& expected)
{
    ValueReader reader(entry, std::string(form<T>()) + " with the dimensions " + expected.str() + " or none given");
    const auto dimensions = reader.readDimensions();
    if (dimensions && *dimensions != expected)
    {
        reader.fail("its dimensions are " + dimensions->str());
    }
    const T value = reader.read<T>();
    reader.finish();
    return value;
}

}

template<class T>
T Dictionary::lookup(const std::string& key) const
{
    ValueReader reader(requireEntry(*this, key), form<T>());
    const T value = reader.read<T>();
    reader.finish();
    return value;
}

template<class T>
T Dictionary::lookupOr(const std::string& key, const T& fallback) const
{
    return found(key) ? lookup<T>(key) : fallback;
}

#define INSTANTIATE_LOOKUP(...) \
    template __VA_ARGS__ Dictionary::lookup<__VA_ARGS__>(const std::string&) const; \
    template __VA_ARGS__ Dictionary::lookupOr<__VA_ARGS__>(const std::string&, const __VA_ARGS__&) const;

INSTANTIATE_LOOKUP(double)
INSTANTIATE_LOOKUP(int)
INSTANTIATE_LOOKUP(long)
INSTANTIATE_LOOKUP(bool)
INSTANTIATE_LOOKUP(std::string)
INSTANTIATE_LOOKUP(std::array<double, 3>)
INSTANTIATE_LOOKUP(std::vector<double>)
INSTANTIATE_LOOKUP(std::vector<int>)
INSTANTIATE_LOOKUP(std::vector<long>)
INSTANTIATE_LOOKUP(std::vector<bool>)
INSTANTIATE_LOOKUP(std::vector<std::string>)
INSTANTIATE_LOOKUP(std::vector<std::array<double, 3>>)

#undef INSTANTIATE_LOOKUP

double Dictionary::lookupDimensioned(const std::string& key, const Dimensions& expected) const
{
    return readDimensioned<double>(requireEntry(*this, key), expected);
}

double Dictionary::lookupDimensionedOr(const std::string& key, const Dimensions& expected, double fallback) const
{
    return found(key) ? lookupDimensioned(key, expected) : fallback;
}

std::array<double, 3> Dictionary::lookupDimensionedVector(const std::string& key, const Dimensions& expected) const
{
    return readDimensioned<std::array<double, 3>>(requireEntry(*this, key), expected);
}

Dimensions Dictionary::lookupDimensions(const std::string& key) const
{
    ValueReader reader(requireEntry(*this, key), "a dimension set, e.g. [0 1 -1 0 0 0 0] or [m/s]");
    const auto dimensions = reader.readDimensions();
    if (!dimensions) reader.fail("it has no dimension set");
    reader.finish();
    return *dimensions;
}

double Dictionary::lookupPositive(const std::string& key, const Dimensions& expected, bool zeroAllowed) const
{
    const double value = lookupDimensioned(key, expected);
    if (value < 0 || (value == 0 && !zeroAllowed))
    {
        std::ostringstream text;
        text << value;
        throw FatalInputError
        (
            where(key), "Entry '" + key + "' is " + text.str(),
            zeroAllowed ? "a number >= 0" : "a number > 0"
        );
    }
    return value;
}

std::string Dictionary::lookupChoice(const std::string& key, const std::vector<std::string>& choices) const
{
    const std::string word = lookup<std::string>(key);
    if (std::find(choices.begin(), choices.end(), word) == choices.end())
    {
        throw FatalInputError
        (
            where(key), "Entry '" + key + "' is '" + word + "'", "one of the words below", choices, word
        );
    }
    return word;
}

std::string Dictionary::lookupChoiceOr
(
    const std::string& key, const std::vector<std::string>& choices, const std::string& fallback
) const
{
    return found(key) ? lookupChoice(key, choices) : fallback;
}

}
