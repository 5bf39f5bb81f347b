// SPDX-License-Identifier: GPL-3.0-or-later
#include "liveView/ViewCommand.H"

#include "core/messages/Error.H"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

namespace shizuku
{

namespace
{

using Kind = ViewCommand::Kind;

constexpr std::array<std::pair<std::string_view, Kind>, 8> commandWords
{{
    {"next", Kind::next}, {"set", Kind::set}, {"time", Kind::time}, {"pause", Kind::pause},
    {"run", Kind::run}, {"step", Kind::step}, {"write", Kind::write}, {"stop", Kind::stop}
}};

[[noreturn]] void failMessage(const std::string& found, const std::string& expected)
{
    throw FatalInputError({}, found, expected);
}

// Takes the next word off the text: up to a space.
std::string_view takeWord(std::string_view& text)
{
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return word;
}

Kind kindOf(std::string_view word)
{
    for (const auto& [name, kind] : commandWords)
    {
        if (name == word) return kind;
    }
    std::vector<std::string> choices;
    for (const auto& entry : commandWords) choices.emplace_back(entry.first);
    throw FatalInputError({}, "A message begins with an unknown word", "one of the words below", choices);
}

double finiteNumber(std::string_view text)
{
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool isNumber = error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
    if (!isNumber) failMessage("A message holds a number that is none", "a finite number");
    return value;
}

double wholeNumber(std::string_view text)
{
    constexpr double most = 1e9;
    const double value = finiteNumber(text);
    if (value < 0 || value > most || value != std::floor(value)) failMessage("A message holds a bad count", "a whole number from 0 to 1e9");
    return value;
}

}

ViewCommand ViewCommand::parse(std::string_view message)
{
    if (message.size() > longest) failMessage("A message has " + std::to_string(message.size()) + " bytes", "at most " + std::to_string(longest));
    std::string_view rest = message;
    ViewCommand command;
    command.kind = kindOf(takeWord(rest));
    switch (command.kind)
    {
        case Kind::set:
            command.name = takeWord(rest);
            if (command.name.empty()) failMessage("The message 'set' names no entry", "set NAME VALUE");
            command.value = finiteNumber(rest);
            break;
        case Kind::next:
        case Kind::time: command.value = wholeNumber(rest); break;
        default:
            if (message.find(' ') != std::string_view::npos) failMessage("A message goes on behind its word", "the word alone");
    }
    return command;
}

}
