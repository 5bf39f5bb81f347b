// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/messages/Error.H"

#include <algorithm>
#include <cctype>
#include <iostream>
#include <sstream>

namespace shizuku
{

namespace
{

std::string lower(std::string word)
{
    std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
    return word;
}

// Optimal string alignment distance: insertions, deletions, substitutions, swaps of neighbours.
std::size_t editDistance(const std::string& a, const std::string& b)
{
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
    {
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
            {
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
            }
        }
    }
    return d[a.size()][b.size()];
}

std::string position(const SourceLocation& where)
{
    if (where.file.empty()) return "";
    if (where.line <= 0) return "file: " + where.file;
    return "file: " + where.file + " at line " + std::to_string(where.line) + ".";
}

std::string layOut
(
    const SourceLocation& where,
    const std::string& found,
    const std::string& expected,
    std::vector<std::string> choices,
    const std::string& word
)
{
    std::ostringstream text;
    text << found << '\n';
    if (const std::string at = position(where); !at.empty()) text << '\n' << at << '\n';
    if (!expected.empty()) text << "\nExpected: " << expected << '\n';
    if (!choices.empty())
    {
        if (const std::string nearest = nearestWord(word, choices); !nearest.empty())
        {
            text << "\nDid you mean '" << nearest << "'?\n";
        }
        std::sort(choices.begin(), choices.end());
        choices.erase(std::unique(choices.begin(), choices.end()), choices.end());
        text << "\nValid choices:\n\n";
        for (const std::string& choice : choices) text << "    " << choice << '\n';
    }
    return text.str();
}

}

FatalInputError::FatalInputError
(
    const SourceLocation& where,
    const std::string& found,
    const std::string& expected,
    const std::vector<std::string>& choices,
    const std::string& word
)
:
    FatalError(layOut(where, found, expected, choices, word)),
    where_(where)
{}

namespace
{

// The one choice that begins with `word`, of four letters at the least: newtonian for newton; or "".
std::string continued(const std::string& word, const std::vector<std::string>& choices)
{
    constexpr std::size_t least = 4;
    if (word.size() < least) return "";
    const auto begins = [&](const std::string& choice) { return lower(choice).starts_with(lower(word)); };
    const auto first = std::find_if(choices.begin(), choices.end(), begins);
    return first != choices.end() && std::count_if(choices.begin(), choices.end(), begins) == 1 ? *first : "";
}

}

std::string nearestWord(const std::string& word, const std::vector<std::string>& choices)
{
    constexpr std::size_t longest = 100;        // letters of a word that somebody typed
    if (word.empty() || word.size() > longest) return "";
    std::string nearest;
    // One slip in three letters, to the nearest whole number, is still taken for a slip.
    std::size_t smallest = std::max<std::size_t>(1, (word.size() + 1)/3);
    for (const std::string& choice : choices)
    {
        if (choice.size() > longest) continue;
        const std::size_t distance = editDistance(lower(word), lower(choice));
        const bool shares = distance < std::max(word.size(), choice.size());
        if (shares && (distance < smallest || (distance == smallest && nearest.empty())))
        {
            smallest = distance;
            nearest = choice;
        }
    }
    return nearest.empty() ? continued(word, choices) : nearest;
}

void warning(const std::string& message, const SourceLocation& where)
{
    std::cerr << "--> WARNING: " << message << '\n';
    if (const std::string at = position(where); !at.empty()) std::cerr << "    " << at << '\n';
    std::cerr << std::flush;
}

}
