// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/BalanceCheck.H"

#include "core/dictionary/InputLimits.H"

#include <vector>

namespace shizuku
{

namespace
{

char partnerOf(char opening)
{
    return opening == '(' ? ')' : opening == '[' ? ']' : '}';
}

bool startsWith(const std::string& text, std::size_t at, const char* what)
{
    return text.compare(at, std::char_traits<char>::length(what), what) == 0;
}

// Offset behind the comment, string or verbatim text that starts at `at`; `at` itself where none starts.
std::size_t skipQuoted(const SourceText& source, std::size_t at)
{
    const std::string& text = source.text();
    const auto skipTo = [&](const char* end, const char* what) -> std::size_t
    {
        const std::size_t found = text.find(end, at + 2);
        if (found == std::string::npos)
        {
            throw FatalInputError(source.at(at), std::string("Unclosed ") + what, std::string("closed by ") + end);
        }
        return found + 2;
    };

    if (startsWith(text, at, "//")) return std::min(text.find('\n', at), text.size());
    if (startsWith(text, at, "/*")) return skipTo("*/", "comment");
    if (startsWith(text, at, "#{")) return skipTo("#}", "verbatim text");
    if (text[at] != '"') return at;

    for (std::size_t i = at + 1; i < text.size() && text[i] != '\n'; ++i)
    {
        if (text[i] == '"') return i + 1;
        if (text[i] == '\\') i += startsWith(text, i, "\\\r\n") ? 2 : 1;
    }
    throw FatalInputError(source.at(at), "Unclosed string",
        "closed by \" on the same line (or \\ before the line's end)");
}

bool isText(char c)
{
    if (static_cast<unsigned char>(c) >= 0x20) return c != 0x7f;
    return c == '\n' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

}

void checkBalance(const SourceText& source)
{
    const std::string& text = source.text();
    std::vector<std::size_t> open;

    for (std::size_t i = 0; i < text.size();)
    {
        if (const std::size_t behind = skipQuoted(source, i); behind != i)
        {
            i = behind;
            continue;
        }
        const char c = text[i];
        if (!isText(c))
        {
            throw FatalInputError
            (
                source.at(i), "A byte that is no text: code " + std::to_string(static_cast<unsigned char>(c)),
                "an ascii dictionary; binary lists may stand in field files alone"
            );
        }
        if (c == '(' || c == '[' || c == '{') open.push_back(i);
        if (open.size() > inputLimits::nesting)
        {
            const std::string limit = "at most " + std::to_string(inputLimits::nesting) + " levels";
            throw FatalInputError(source.at(i), "Brackets are nested too deep", limit);
        }
        if (c == ')' || c == ']' || c == '}')
        {
            if (open.empty())
            {
                throw FatalInputError(source.at(i), std::string("'") + c + "' closes nothing");
            }
            const char opening = text[open.back()];
            if (partnerOf(opening) != c)
            {
                throw FatalInputError
                (
                    source.at(i), std::string("'") + c + "' does not close the '" + opening + "' of line "
                  + std::to_string(source.line(open.back())), std::string("'") + partnerOf(opening) + "'"
                );
            }
            open.pop_back();
        }
        ++i;
    }
    if (!open.empty())
    {
        const char opening = text[open.back()];
        throw FatalInputError
        (
            source.at(open.back()), std::string("Unclosed '") + opening + "'",
            std::string("closed by '") + partnerOf(opening) + "'"
        );
    }
}

}
