// SPDX-License-Identifier: GPL-3.0-or-later
#include "StabilityChart.H"

#include "core/fieldFile/AtomicFile.H"
#include "study/Gnuplot.H"

#include <algorithm>
#include <iostream>
#include <sstream>

namespace shizuku
{

namespace
{

const char* colourOf(Stability stability)
{
    switch (stability)
    {
        case Stability::notANumber: return "#222222";
        case Stability::exploded: return "#b2182b";
        case Stability::refused: return "#999999";
        case Stability::died: return "#666666";
        case Stability::leaked: return "#7a5195";
        case Stability::clustered: return "#c51b7d";
        case Stability::volumeLost: return "#d9822b";
        case Stability::frozen: return "#4575b4";
        case Stability::wrong: return "#e6c84c";
        case Stability::noisy: return "#a6d96a";
        default: return "#1a9850";
    }
}

const StudyAxis& axisOf(const Study& study, std::size_t axis) { return study.axes[axis]; }

// The runs of each choice of `maps`, by their places; all of them where there is none.
std::vector<std::pair<std::string, std::vector<std::size_t>>> mapsOf
(
    const Study& study, const MapLayout& layout, const std::vector<RunOutcome>& outcomes
)
{
    std::vector<std::pair<std::string, std::vector<std::size_t>>> maps;
    if (layout.maps.empty()) maps.push_back({"", {}});
    else
    {
        for (const CaseChoice& choice : axisOf(study, layout.maps.front()).choices) maps.push_back({choice.name, {}});
    }
    for (std::size_t i = 0; i < outcomes.size(); ++i)
    {
        maps[layout.maps.empty() ? 0 : outcomes[i].run.choices[layout.maps.front()]].second.push_back(i);
    }
    return maps;
}

std::string ticsOf(const StudyAxis& axis)
{
    std::string tics;
    for (std::size_t i = 0; i < axis.choices.size(); ++i)
    {
        tics += (i > 0 ? ", " : "") + quotedForGnuplot(axis.choices[i].name) + " " + std::to_string(i);
    }
    return "(" + tics + ")";
}

// Whether a name is wider than its column.
bool namesOverlap(const StudyAxis& axis)
{
    return std::ranges::any_of(axis.choices, [](const CaseChoice& choice) { return choice.name.size() > 13; });
}

}

MapLayout MapLayout::read(const Study& study)
{
    const Dictionary map = study.dict.subDict("map");
    const auto axis = [&](const char* key) { return study.axis({map.lookup<std::string>(key), map.where(key)}); };
    MapLayout layout{study.dict.lookupOr("title", study.name), "", "", axis("x"), axis("y"), {}};
    layout.xLabel = map.lookupOr("xLabel", axisOf(study, layout.x).name);
    layout.yLabel = map.lookupOr("yLabel", axisOf(study, layout.y).name);
    if (map.found("maps")) layout.maps.push_back(axis("maps"));
    for (std::size_t i = 0; i < study.axes.size(); ++i)
    {
        const bool shown = i == layout.x || i == layout.y || (!layout.maps.empty() && i == layout.maps.front());
        if (shown || study.axes[i].choices.size() == 1) continue;
        throw FatalInputError
        (
            map.where(), "The map shows no axis '" + study.axes[i].name + "', which has several choices",
            "x, y or maps " + study.axes[i].name
        );
    }
    return layout;
}

void drawMaps
(
    const std::filesystem::path& folder, const Study& study, const MapLayout& layout,
    const std::vector<RunOutcome>& outcomes, const std::vector<Stability>& classes
)
{
    const StudyAxis& x = axisOf(study, layout.x);
    const StudyAxis& y = axisOf(study, layout.y);
    for (const auto& [name, runs] : mapsOf(study, layout, outcomes))
    {
        std::ostringstream commands;
        commands << "unset key; set style fill solid 1 noborder; set title "
                 << quotedForGnuplot(layout.title + (name.empty() ? "" : ": " + name)) << '\n'
                 << "set xrange [-0.5:" << double(x.choices.size()) - 0.5 << "]\n"
                 << "set yrange [-0.5:" << double(y.choices.size()) - 0.5 << "]\n"
                 << "set xtics" << (namesOverlap(x) ? " rotate by -20 " : " ") << ticsOf(x) << "; set ytics " << ticsOf(y) << "; set tics scale 0\n"
                 << "set xlabel " << quotedForGnuplot(layout.xLabel) << "; set ylabel " << quotedForGnuplot(layout.yLabel) << '\n';
        int object = 0;
        for (const std::size_t i : runs)
        {
            const std::size_t column = outcomes[i].run.choices[layout.x], line = outcomes[i].run.choices[layout.y];
            const bool known = outcomes[i].end != RunEnd::notRun;
            const bool bright = !known || classes[i] == Stability::wrong || classes[i] == Stability::noisy;
            ++object;
            commands << "set object " << object << " rectangle center " << column << ',' << line << " size 0.96,0.96 fc rgb \""
                     << (known ? colourOf(classes[i]) : "#ffffff") << "\"\n"
                     << "set label " << object << ' ' << quotedForGnuplot(known ? nameOf(classes[i]) : "not run") << " at "
                     << column << ',' << line << " center front textcolor rgb \"" << (bright ? "#222222" : "#ffffff")
                     << "\" font \",9\"\n";
        }
        commands << "plot NaN notitle";
        const int width = 220 + 95*int(x.choices.size()), height = 140 + 44*int(y.choices.size());
        drawChart(folder/("stabilityMap" + (name.empty() ? "" : "-" + name)), commands.str(), width, height);
    }
}

void writeTables
(
    const std::filesystem::path& folder, const Study& study, const MapLayout& layout,
    const std::vector<RunOutcome>& outcomes, const std::vector<Stability>& classes
)
{
    const StudyAxis& x = axisOf(study, layout.x);
    const StudyAxis& y = axisOf(study, layout.y);
    writeAtomically(folder/"stabilityMap.md", [&](std::ostream& stream)
    {
        stream << "# " << layout.title << '\n';
        for (const auto& [name, runs] : mapsOf(study, layout, outcomes))
        {
            const std::vector<std::string> empty(x.choices.size(), "-");
            std::vector<std::vector<std::string>> cells(y.choices.size(), empty);
            std::string reasons;
            for (const std::size_t i : runs)
            {
                const RunOutcome& outcome = outcomes[i];
                const bool known = outcome.end != RunEnd::notRun;
                cells[outcome.run.choices[layout.y]][outcome.run.choices[layout.x]] = known ? nameOf(classes[i]) : "not run";
                if (!outcome.reason.empty()) reasons += "- " + outcome.run.name + ": " + outcome.reason + "\n";
            }
            stream << (name.empty() ? "" : "\n## " + name + "\n") << "\n| " << y.name << " |";
            for (const CaseChoice& choice : x.choices) stream << ' ' << choice.name << " |";
            stream << "\n| --- |";
            for (std::size_t i = 0; i < x.choices.size(); ++i) stream << " --- |";
            for (std::size_t line = 0; line < y.choices.size(); ++line)
            {
                stream << "\n| " << y.choices[line].name << " |";
                for (const std::string& cell : cells[line]) stream << ' ' << cell << " |";
            }
            stream << '\n' << (reasons.empty() ? "" : "\nWhat was told of those that did not end:\n\n" + reasons);
        }
    });
    std::cout << "Table: " << (folder/"stabilityMap.md").string() << '\n';
}

}
