// SPDX-License-Identifier: GPL-3.0-or-later
#include "SpeedAccuracyChart.H"

#include "study/Gnuplot.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <iterator>
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

bool drawable(const SpeedAccuracyPoint& point)
{
    return std::isfinite(point.cost) && std::isfinite(point.error) && point.cost > 0;
}

// The choices but for that of the series: "1000, 0.5".
std::string nameOf(const SpeedAccuracy& chart, const SpeedAccuracyPoint& point)
{
    std::string name;
    for (std::size_t i = 0; i < point.choices.size(); ++i)
    {
        if (i != chart.series) name += (name.empty() ? "" : ", ") + point.choices[i];
    }
    return name;
}

// "particles, timeStep": what the names of points tell.
std::string namedAxes(const Study& study, const SpeedAccuracy& chart)
{
    std::string names;
    for (std::size_t i = 0; i < chart.shown.size(); ++i)
    {
        if (i != chart.series) names += (names.empty() ? "" : ", ") + study.axes[chart.shown[i]].name;
    }
    return names;
}

std::string axisOf(const std::string& cost)
{
    if (cost == "particleSteps") return "particle-steps for one simulated second";
    return std::string(cost == "cpuTime" ? "processor time" : "wall-clock time") + " for one simulated second [s]";
}

std::string row(double cost, double error, const std::string& name)
{
    std::ostringstream text;
    text.precision(9);
    text << cost << ' ' << error << ' ' << quotedForGnuplot(name);
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

// Two columns at most, of which the picture has room for.
std::ptrdiff_t rowsOfKey(const std::vector<std::string>& plots)
{
    const auto isNamed = [](const std::string& plot) { return !plot.ends_with("notitle"); };
    return std::max<std::ptrdiff_t>(5, (std::ranges::count_if(plots, isNamed) + 1)/2);
}

void addSeries
(
    Parts& parts, const Study& study, const SpeedAccuracy& chart, const std::vector<SpeedAccuracyPoint>& points
)
{
    const StudyAxis& series = study.axes[chart.shown[chart.series]];
    for (std::size_t i = 0; i < series.choices.size(); ++i)
    {
        std::vector<std::string> rows;
        for (const SpeedAccuracyPoint& point : points)
        {
            if (point.choices[chart.series] != series.choices[i].name || !drawable(point)) continue;
            rows.push_back(row(point.cost, std::max(point.error, chart.least), ""));
        }
        if (rows.empty()) continue;
        const std::string block = "series" + std::to_string(i);
        parts.addBlock(block, rows);
        parts.plots.push_back
        (
            "$" + block + " using 1:2 with points pt 7 ps 1.1 lc rgb \"" + colours[i%colours.size()] + "\" title "
          + quotedForGnuplot(series.choices[i].name)
        );
    }
}

void addFront
(
    Parts& parts, const Study& study, const SpeedAccuracy& chart, const std::vector<SpeedAccuracyPoint>& points
)
{
    std::vector<SpeedAccuracyPoint> front;
    std::copy_if(points.begin(), points.end(), std::back_inserter(front), [](const SpeedAccuracyPoint& point)
    {
        return point.front && drawable(point);
    });
    const auto cheaper = [](const SpeedAccuracyPoint& a, const SpeedAccuracyPoint& b) { return a.cost < b.cost; };
    std::sort(front.begin(), front.end(), cheaper);
    std::vector<std::string> rows;
    for (const SpeedAccuracyPoint& point : front)
    {
        rows.push_back(row(point.cost, std::max(point.error, chart.least), nameOf(chart, point)));
    }
    parts.addBlock("front", rows);
    parts.plots.push_back
    (
        "$front using 1:2 with linespoints pt 6 ps 2 lw 1.5 lc rgb \"#333333\" title \"front, by "
      + namedAxes(study, chart) + "\""
    );
    parts.plots.push_back("$front using 1:2:3 with labels left offset 0.9,0.6 font \",8\" notitle");
}

void addReferences(Parts& parts, const SpeedAccuracy& chart)
{
    if (chart.references.empty()) return;
    std::vector<std::string> rows;
    for (const ReferencePoint& point : chart.references)
    {
        rows.push_back(row(point.cost, std::max(point.error, chart.least), point.source));
    }
    parts.addBlock("references", rows);
    parts.plots.push_back("$references using 1:2 with points pt 4 ps 1.5 lw 2 lc rgb \"#000000\" title \"others, named\"");
    parts.plots.push_back("$references using 1:2:3 with labels right offset 1,-1 font \",8\" notitle");
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
    for (const char* const name : {"cost", "error", "runs", "withoutError", "front", "source"}) columns.push_back({name, ""});
    CsvFile table(file, columns);
    for (const SpeedAccuracyPoint& point : points)
    {
        std::vector<CsvFile::Cell> cells(point.choices.begin(), point.choices.end());
        cells.insert
        (
            cells.end(),
            {point.cost, point.error, double(point.runs), double(point.failed), point.front ? "yes" : "no", "this study"}
        );
        table.addRow(cells);
    }
    for (const ReferencePoint& point : chart.references)
    {
        std::vector<CsvFile::Cell> cells(chart.shown.size(), "-");
        cells.insert(cells.end(), {point.cost, point.error, std::nan(""), std::nan(""), "-", point.source});
        table.addRow(cells);
    }
    table.write();
    std::cout << "Table: " << file.string() << '\n';
}

void drawPoints
(
    const std::filesystem::path& file, const Study& study, const SpeedAccuracy& chart,
    const std::vector<SpeedAccuracyPoint>& points
)
{
    if (std::none_of(points.begin(), points.end(), drawable))
    {
        std::cout << "Leaving out the chart: no point has both an error and a cost\n";
        return;
    }
    Parts parts;
    addSeries(parts, study, chart, points);
    addFront(parts, study, chart, points);
    addReferences(parts, chart);
    std::ostringstream commands;
    commands << parts.data.str()
             << "set logscale xy; set grid lc rgb \"#dddddd\"; set offsets graph 0.05, graph 0.15, graph 0.05, graph 0.05\n"
             << "set key below vertical maxrows " << rowsOfKey(parts.plots) << " samplen 2; set title " << quotedForGnuplot(chart.title) << '\n'
             << "set xlabel \"" << axisOf(chart.cost)
             << "\"; set ylabel " << quotedForGnuplot(chart.label) << "\nset format x \"%g\"; set format y \"%g\"\nplot ";
    for (std::size_t i = 0; i < parts.plots.size(); ++i) commands << (i > 0 ? ", \\\n    " : "") << parts.plots[i];
    drawChart(file, commands.str());
}

}
