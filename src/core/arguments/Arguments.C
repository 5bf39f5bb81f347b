// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/arguments/Arguments.H"

#include "core/arguments/Version.H"
#include "core/messages/Error.H"
#include "core/paths/Existence.H"

#include <boost/program_options.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <set>
#include <sstream>

namespace shizuku
{

namespace
{

namespace po = boost::program_options;

std::vector<Option> allOptions(const ApplicationInfo& info)
{
    std::vector<Option> options = info.options;
    options.push_back({"case", "DIR", "Case folder (default: the current folder)", ""});
    if (info.models) options.push_back({"listModels", "", "Print the models that a case may choose and stop", ""});
    options.push_back({"help", "", "Print this text and stop (also -h)", ""});
    options.push_back({"version", "", "Print the version and stop", ""});
    std::sort
    (
        options.begin(), options.end(), [](const Option& a, const Option& b) { return a.name < b.name; }
    );
    return options;
}

const Option* findOption(const std::vector<Option>& options, const std::string& name)
{
    const auto found = std::find_if
    (
        options.begin(), options.end(), [&](const Option& option) { return option.name == name; }
    );
    return found == options.end() ? nullptr : &*found;
}

std::vector<std::string> split(const std::string& text, char separator)
{
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
}

std::string withoutDashes(const std::string& token)
{
    return token.substr(std::min(token.find_first_not_of('-'), token.size()));
}

bool looksLikeOption(const std::string& token)
{
    if (token.size() < 2 || token[0] != '-') return false;
    return token[1] == '-' || std::isalpha(static_cast<unsigned char>(token[1]));
}

[[noreturn]] void failUnknown(const std::string& name, const std::vector<Option>& options)
{
    std::vector<std::string> choices;
    for (const Option& option : options) choices.push_back("-" + option.name);
    throw FatalInputError({}, "Unknown option '-" + name + "'", "one of the options below", choices, "-" + name);
}

[[noreturn]] void failMissing(const Option& option)
{
    const std::string name = "-" + option.name;
    throw FatalInputError({}, "Option " + name + " has no value", name + " <" + option.value + ">");
}

void checkValue(const Option& option, const std::string& value)
{
    if (option.value.find('|') == std::string::npos) return;
    const auto choices = split(option.value, '|');
    if (std::find(choices.begin(), choices.end(), value) != choices.end()) return;
    throw FatalInputError
    (
        {}, "Option -" + option.name + " has the value '" + value + "'", "one of the words below", choices, value
    );
}

po::options_description description(const std::vector<Option>& options)
{
    po::options_description result;
    for (const Option& option : options)
    {
        if (option.value.empty()) result.add_options()(option.name.c_str(), option.help.c_str());
        else result.add_options()(option.name.c_str(), po::value<std::string>(), option.help.c_str());
    }
    return result;
}

// The tokens in their order. An unknown single-dash option comes back as a positional argument.
std::vector<po::option> parse(int argc, const char* const* argv, const std::vector<Option>& options)
{
    using namespace po::command_line_style;
    const auto known = description(options);
    try
    {
        const auto style = allow_long | allow_long_disguise | long_allow_adjacent | long_allow_next;
        return po::command_line_parser(argc, argv).options(known).style(style).run().options;
    }
    catch (const po::unknown_option& error)
    {
        failUnknown(withoutDashes(error.get_option_name()), options);
    }
    catch (const po::invalid_command_line_syntax& error)
    {
        const Option* option = findOption(options, withoutDashes(error.get_option_name()));
        if (option && !option->value.empty()) failMissing(*option);
        throw FatalInputError({}, "Option -" + withoutDashes(error.get_option_name()) + " takes no value");
    }
}

// The last positional argument stands for any number of them: "cases...".
bool takesMany(const ApplicationInfo& info)
{
    return !info.positional.empty() && info.positional.back().ends_with("...");
}

std::string quoted(const std::string& argument)
{
    if (!argument.empty() && argument.find(' ') == std::string::npos) return argument;
    std::string result = "'";
    return result.append(argument).append("'");
}

void checkCase(const std::filesystem::path& path, const std::string& hint = "a case directory, given with -case DIR, or the current folder")
{
    const SourceLocation where{path.string(), 0};
    if (!isThere(path))
    {
        throw FatalInputError(where, "The case directory does not exist", hint);
    }
    if (!isFolder(path)) throw FatalInputError(where, "The case is not a directory", hint);
    if (!isFile(path / "system" / "controlDict"))
    {
        throw FatalInputError(where, "The folder is not a case: system/controlDict is missing", hint);
    }
}

}

std::string helpText(const ApplicationInfo& info)
{
    const auto options = allOptions(info);
    const auto usage = [](const Option& option)
    {
        return "-" + option.name + (option.value.empty() ? "" : " <" + option.value + ">");
    };
    std::size_t width = 0;
    for (const Option& option : options) width = std::max(width, usage(option).size());

    std::ostringstream text;
    text << "Usage: " << info.name << " [OPTIONS]";
    for (const std::string& name : info.positional) text << (info.needsCase && takesMany(info) ? " [" + name + "]" : " <" + name + ">");
    text << "\n\n" << info.summary << "\n\nOptions:\n";
    for (const Option& option : options)
    {
        const std::string left = usage(option);
        text << "  " << left << std::string(width - left.size() + 2, ' ') << option.help;
        if (!option.fallback.empty()) text << " (default: " << option.fallback << ")";
        text << "\n";
    }
    return text.str();
}

Arguments::Arguments(int argc, const char* const* argv, const ApplicationInfo& info)
    : info_(info)
{
    for (int i = 0; i < argc; ++i) commandLine_.append(i ? " " : "").append(quoted(argv[i]));

    const auto options = allOptions(info_);
    const bool asksForHelp = argc == 2 && std::string(argv[1]) == "-h";
    const char* const help[] = {argv[0], "-help"};
    for (const po::option& token : parse(argc, asksForHelp ? help : argv, options))
    {
        if (token.position_key >= 0)
        {
            const std::string& text = token.value.front();
            if (looksLikeOption(text)) failUnknown(withoutDashes(text), options);
            if (positional_.size() >= info_.positional.size() && !takesMany(info_))
            {
                throw FatalInputError({}, "Unexpected argument '" + text + "'", info_.name + " -help tells the usage");
            }
            positional_.push_back(text);
            continue;
        }
        store(token.string_key, token.value.empty() ? "" : token.value.front());
    }

    if (found("help"))
    {
        std::cout << helpText(info_);
        std::exit(EXIT_SUCCESS);
    }
    if (found("version"))
    {
        std::cout << "Shizuku " << versionText() << "\n";
        std::exit(EXIT_SUCCESS);
    }

    if (info_.models && found("listModels"))
    {
        std::cout << info_.models();
        std::exit(EXIT_SUCCESS);
    }

    const std::filesystem::path given = found("case") ? get("case") : ".";
    std::error_code unresolved;
    case_ = std::filesystem::weakly_canonical(given, unresolved);
    if (unresolved) case_ = given;          // which checkCase refuses
    if (givesCases()) checkCases();
    else if (info_.needsCase) checkCase(case_);
}

Arguments Arguments::ofCase(const std::filesystem::path& path) const
{
    Arguments args = *this;
    args.positional_.clear();
    args.case_ = path;
    return args;
}

bool Arguments::givesCases() const
{
    return info_.needsCase && takesMany(info_) && positional_.size() >= info_.positional.size();
}

void Arguments::checkCases() const
{
    const std::vector<std::string> names = positionals(info_.positional.back());
    if (found("case"))
    {
        throw FatalInputError({}, "Option -case is given beside the case '" + names.front() + "'", "one of both; " + info_.name + " -help tells the usage");
    }
    std::set<std::filesystem::path> paths;
    for (const std::string& name : names)
    {
        checkCase(name, "a case folder");
        if (!paths.insert(std::filesystem::canonical(name)).second) throw FatalInputError({name, 0}, "The case is given twice", "it once");
    }
}

void Arguments::store(const std::string& name, const std::string& value)
{
    const auto options = allOptions(info_);
    const Option& option = *findOption(options, name);
    if (found(name)) throw FatalInputError({}, "Option -" + name + " is given twice", "it once");
    if (!option.value.empty())
    {
        // "-case -help": the next option was taken for the value.
        if (looksLikeOption(value) && findOption(options, withoutDashes(value))) failMissing(option);
        checkValue(option, value);
    }
    values_.emplace_back(name, value);
}

bool Arguments::found(const std::string& option) const
{
    return std::any_of(values_.begin(), values_.end(), [&](const auto& entry) { return entry.first == option; });
}

std::string Arguments::get(const std::string& option) const
{
    for (const auto& [name, value] : values_)
    {
        if (name == option) return value;
    }
    const Option* declared = findOption(info_.options, option);
    if (declared && !declared->fallback.empty()) return declared->fallback;
    throw FatalInputError({}, "Option -" + option + " is missing", info_.name + " -" + option + " <value>");
}

double Arguments::getDouble(const std::string& option) const
{
    const std::string text = get(option);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    {
        throw FatalInputError({}, "Option -" + option + " has the value '" + text + "'", "a finite number");
    }
    return value;
}

std::vector<std::string> Arguments::getList(const std::string& option) const
{
    std::string text = get(option);
    std::replace_if(text.begin(), text.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
    std::istringstream words(text);
    return {std::istream_iterator<std::string>(words), {}};
}

std::string Arguments::positional(const std::string& name) const
{
    const auto found = std::find(info_.positional.begin(), info_.positional.end(), name);
    const std::size_t i = found - info_.positional.begin();
    return i < positional_.size() ? positional_[i] : "";
}

std::vector<std::string> Arguments::positionals(const std::string& name) const
{
    const auto found = std::find(info_.positional.begin(), info_.positional.end(), name);
    const std::size_t first = std::min<std::size_t>(found - info_.positional.begin(), positional_.size());
    return {positional_.begin() + long(first), positional_.end()};
}

}
