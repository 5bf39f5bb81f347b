// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/Gnuplot.H"

#include "core/fieldFile/AtomicFile.H"
#include "core/messages/Error.H"

#include <cstdio>
#include <cstdlib>
#include <iostream>

namespace shizuku
{

namespace fs = std::filesystem;

namespace
{

// A text in the shell's single quotes, which end where the text has one.
std::string quotedForShell(const std::string& text)
{
    std::string result = "'";
    for (const char c : text)
    {
        if (c == '\'') result += "'\\'";
        result += c;
    }
    return result + "'";
}

}

std::string quotedForGnuplot(const std::string& text)
{
    std::string result = "\"";
    for (const char c : text)
    {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + '"';
}

void drawChart(const fs::path& chart, const std::string& commands, int width, int height)
{
    const std::string name = chart.filename().string(), size = std::to_string(width) + "," + std::to_string(height);
    const fs::path script = chart.string() + ".gnuplot";
    writeAtomically(script, [&](std::ostream& stream)
    {
        stream << "# gnuplot " << script.filename().string() << "\n"
               << "set encoding utf8\n"
               << "set terminal pngcairo noenhanced size " << size << " font \",11\"; set output \"" << name << ".png\"\n"
               << commands
               << "\nset terminal svg noenhanced size " << size << " font \"sans,11\" background rgb \"white\"\n"
               << "set output \"" << name << ".svg\"\n"
               << "replot\n";
    });
    if (std::system("command -v gnuplot >/dev/null") != 0)
    {
        std::cout << "Leaving out the chart: it needs gnuplot (gnuplot " << script.string() << " draws it elsewhere)\n";
        return;
    }
    const std::string call =
        "cd " + quotedForShell(script.parent_path().string()) + " && gnuplot " + quotedForShell(script.filename().string()) + " 2>&1";
    FILE* const output = popen(call.c_str(), "r");
    std::string said;
    char line[512];
    while (output && std::fgets(line, sizeof line, output)) said += line;
    if (!output || pclose(output) != 0) throw FatalError("gnuplot cannot draw " + script.string() + ":\n" + said);
    std::cout << "Chart: " << chart.string() << ".png, .svg\n";
}

}
