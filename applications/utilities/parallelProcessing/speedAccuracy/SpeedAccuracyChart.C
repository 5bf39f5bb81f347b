// SPDX-License-Identifier: GPL-3.0-or-later
#include "SpeedAccuracyChart.H"

#include "study/Gnuplot.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iostream>
#include <iterator>
#include <limits>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr std::array colours
{
    "#1f6fb2", "#d9822b", "#3a9d5d", "#b23a48", "#7a5195", "#5c6b73", "#8c6d31", "#17becf", "#bc80bd", "#e377c2",
    "#9acd32", "#404040"
};

std::string axisOf(const std::string& cost)
{
    if (cost == "particleSteps") return "particle-steps for one simulated second";
    return std::string(cost == "cpuTime" ? "processor time" : "wall-clock time") + " for one simulated second [s]";
}

// Cost, error, its least and its most, and a name.
std::string row(const SpeedAccuracy& chart, const SpeedAccuracyPoint& point)
{
    const auto drawn = [&](double error) { return std::max(error, chart.least); };
    std::ostringstream text;
    text.precision(9);
    text << point.cost << ' ' << drawn(point.error) << ' ' << drawn(point.errorFrom) << ' ' << drawn(point.errorTo) << ' '
         << quotedForGnuplot(chart.along ? point.choices[*chart.along] : "");
    return text.str();
}

// What a chart is made of: its data, and how they are drawn.
struct Parts
{
    std::ostringstream data;
    std::vector<std::string> plots;

    void addBlock(const std::string& name, const std::vector<std::string>& rows)
    {
        data << '$' << name << " << END\n";
        for (const std::string& each : rows) data << each << '\n';
        data << "END\n";
    }
};

// Points from the cheapest on.
std::vector<SpeedAccuracyPoint> drawn(const std::vector<SpeedAccuracyPoint>& points, const std::function<bool(const SpeedAccuracyPoint&)>& wanted)
{
    std::vector<SpeedAccuracyPoint> result;
    std::ranges::copy_if(points, std::back_inserter(result), [&](const SpeedAccuracyPoint& point) { return point.isDrawable() && wanted(point); });
    std::ranges::sort(result, {}, &SpeedAccuracyPoint::cost);
    return result;
}

// A line through the points of the best setting, in the order of the axis that it goes along, their choices beside them, and bars from the least to the most of repeats;
// what other settings gave as small rings.
void addSeries
(
    Parts& parts, const Study& study, const SpeedAccuracy& chart, const std::vector<SpeedAccuracyPoint>& points
)
{
    const StudyAxis& series = study.axes[chart.shown[chart.series]];
    for (std::size_t i = 0; i < series.choices.size(); ++i)
    {
        const auto rowsOf = [&](bool onLine)
        {
            std::vector<std::string> rows;
            const auto isOurs = [&](const SpeedAccuracyPoint& p) { return p.choices[chart.series] == series.choices[i].name && p.onLine == onLine; };
            for (const SpeedAccuracyPoint& point : drawn(points, isOurs)) rows.push_back(row(chart, point));
            return rows;
        };
        const std::vector<std::string> line = rowsOf(true), others = rowsOf(false);
        const std::string colour = " lc rgb \"" + std::string(colours[i%colours.size()]) + "\"", number = std::to_string(i);
        const std::string title = " title " + quotedForGnuplot(series.choices[i].name);
        if (!line.empty())
        {
            parts.addBlock("line" + number, line);
            parts.plots.push_back("$line" + number + " using 1:2:3:4 with yerrorbars pt 7 ps 0.1" + colour + " notitle");
            parts.plots.push_back("$line" + number + " using 1:2 with linespoints pt 7 ps 1 lw 2" + colour + title);
            parts.plots.push_back("$line" + number + " using 1:2:5 with labels left offset 0.7,0.4 font \",8\" tc rgb \"" + colours[i%colours.size()] + "\" notitle");
        }
        if (!others.empty())
        {
            parts.addBlock("others" + number, others);
            parts.plots.push_back("$others" + number + " using 1:2 with points pt 6 ps 0.6" + colour + (line.empty() ? title : " notitle"));
        }
    }
}

void addFront(Parts& parts, const SpeedAccuracy& chart, const std::vector<SpeedAccuracyPoint>& points)
{
    std::vector<std::string> rows;
    for (const SpeedAccuracyPoint& point : drawn(points, &SpeedAccuracyPoint::front)) rows.push_back(row(chart, point));
    parts.addBlock("front", rows);
    parts.plots.push_back("$front using 1:2 with lines lw 9 lc rgb \"#dfe3e6\" title \"front\"");
}

void addReferences(Parts& parts, const SpeedAccuracy& chart)
{
    if (chart.references.empty()) return;
    std::vector<std::string> rows;
    for (const ReferencePoint& point : chart.references)
    {
        std::ostringstream text;
        text << point.cost << ' ' << std::max(point.error, chart.least) << ' ' << quotedForGnuplot(point.source);
        rows.push_back(text.str());
    }
    parts.addBlock("references", rows);
    parts.plots.push_back("$references using 1:2 with points pt 4 ps 1.5 lw 2 lc rgb \"#000000\" title \"others, named\"");
    parts.plots.push_back("$references using 1:2:3 with labels right offset 1,-1 font \",8\" notitle");
}

// Where an axis has hardly a decade: 1, 2 and 5 of each that it touches, in place of its powers of ten.
std::string ticsOf(const char* axis, double low, double high)
{
    constexpr double few = 30;
    if (high/low > few) return {};
    std::ostringstream tics;
    for (int decade = int(std::floor(std::log10(low))); decade <= int(std::floor(std::log10(high))); ++decade)
    {
        for (const int digit : {1, 2, 5}) tics << (tics.tellp() > 0 ? ", " : "") << digit << 'e' << decade;
    }
    return std::string("set ") + axis + "tics (" + tics.str() + ")\n";
}

// As wide as what is drawn, and a bit.
std::string rangesOf(const SpeedAccuracy& chart, const std::vector<SpeedAccuracyPoint>& points)
{
    constexpr double margin = 1.7;
    std::vector<double> costs, errors;
    for (const SpeedAccuracyPoint& point : drawn(points, [](const SpeedAccuracyPoint&) { return true; }))
    {
        costs.push_back(point.cost);
        for (const double error : {point.errorFrom, point.errorTo}) errors.push_back(std::max(error, chart.least));
    }
    for (const ReferencePoint& point : chart.references)
    {
        costs.push_back(point.cost);
        errors.push_back(std::max(point.error, chart.least));
    }
    std::ostringstream text;
    const auto range = [&](const char* axis, const std::vector<double>& values)
    {
        const double low = std::ranges::min(values)/margin, high = std::ranges::max(values)*margin;
        text << "set " << axis << "range [" << low << ':' << high << "]\n" << ticsOf(axis, low, high);
    };
    range("x", costs);
    range("y", errors);
    return text.str();
}

}

void writePoints
(
    const std::filesystem::path& file, const Study& study, const SpeedAccuracy& chart,
    const std::vector<SpeedAccuracyPoint>& points
)
{
    std::vector<CsvFile::Column> columns;
    for (const std::size_t axis : chart.shown) columns.push_back({study.axes[axis].name, ""});
    for (const char* const name : {"cost", "error", "errorFrom", "errorTo", "runs", "withoutError", "front", "line", "source"}) columns.push_back({name, ""});
    CsvFile table(file, columns);
    for (const SpeedAccuracyPoint& point : points)
    {
        std::vector<CsvFile::Cell> cells(point.choices.begin(), point.choices.end());
        cells.insert
        (
            cells.end(),
            {
                point.cost, point.error, point.errorFrom, point.errorTo, double(point.runs), double(point.failed), point.front ? "yes" : "no",
                point.onLine ? "yes" : "no", "this study"
            }
        );
        table.addRow(cells);
    }
    for (const ReferencePoint& point : chart.references)
    {
        std::vector<CsvFile::Cell> cells(chart.shown.size(), "-");
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        cells.insert(cells.end(), {point.cost, point.error, none, none, none, none, "-", "-", point.source});
        table.addRow(cells);
    }
    table.write();
    std::cout << "Table: " << file.string() << '\n';
}

void drawPoints
(
    const std::filesystem::path& file, const Study& study, const SpeedAccuracy& chart,
    const std::vector<SpeedAccuracyPoint>& points, const std::string& foot
)
{
    if (std::ranges::none_of(points, &SpeedAccuracyPoint::isDrawable))
    {
        std::cout << "Leaving out the chart: no point has both an error and a cost\n";
        return;
    }
    Parts parts;
    addFront(parts, chart, points);
    addSeries(parts, study, chart, points);
    addReferences(parts, chart);
    std::ostringstream commands;
    commands << parts.data.str()
             << "set logscale xy; set grid lc rgb \"#eeeeee\"\n" << rangesOf(chart, points)
             << "set key outside right top Left reverse samplen 2; set title " << quotedForGnuplot(chart.title) << '\n'
             << "set label 1 " << quotedForGnuplot(foot) << " at screen 0.99, screen 0.015 right font \",8\" tc rgb \"#666666\"\n"
             << "set bmargin 5; set xlabel \"" << axisOf(chart.cost)
             << "\"; set ylabel " << quotedForGnuplot(chart.label) << "\nset format x \"%g\"; set format y \"%g\"\nplot ";
    for (std::size_t i = 0; i < parts.plots.size(); ++i) commands << (i > 0 ? ", \\\n    " : "") << parts.plots[i];
    drawChart(file, commands.str());
}

}
