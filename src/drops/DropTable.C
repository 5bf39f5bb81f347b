// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/DropTable.H"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace shizuku
{

CsvFile dropTable(const std::filesystem::path& file)
{
    return CsvFile
    (
        file,
        {
            {"time", "s"}, {"drop", ""}, {"state", ""}, {"prescribed", "deg"}, {"angle", "deg"},
            {"contactRadius", "m"}, {"height", "m"}, {"coveredArea", "m2"}, {"volume", "m3"}, {"particles", ""},
            {"volumeDrift", "%"}, {"volumeDriftSinceFirst", "%"},
            {"centroidX", "m"}, {"centroidY", "m"}, {"centroidZ", "m"}, {"residual", "spacings"},
            {"tangentMean", "deg"}, {"tangentMin", "deg"}, {"tangentMax", "deg"}, {"advancing", "deg"}, {"receding", "deg"},
            {"capillaryLength", "m"}, {"sigma", "N/m"}, {"lineRadius", "m"},
            {"profileRadius", "m"}, {"profileAngle", "deg"}
        }
    );
}

void addRow(CsvFile& table, const DropRecord& record)
{
    const ContactAngle& shape = record.shape;
    table.addRow
    ({
        record.time, double(record.drop), word(shape.state), record.prescribed, shape.angle,
        shape.contactRadius, shape.height, shape.coveredArea, record.volume, double(record.particles),
        100*record.particleDrift, 100*record.firstDrift,
        record.centroid.x, record.centroid.y, record.centroid.z, shape.residual,
        shape.mean, shape.min, shape.max, shape.advancing, shape.receding,
        record.capillaryLength, record.sigma, shape.lineRadius, record.profileRadius, record.profileAngle
    });
}

std::string report(const DropRecord& record, const std::string& wall)
{
    const ContactAngle& shape = record.shape;
    std::ostringstream out;
    const auto line = [&out](const std::string& name) -> std::ostream&
    {
        return out << "    " << std::left << std::setw(20) << name << std::right;
    };
    const auto fixed = [](double value, int digits, bool sign = false)
    {
        std::ostringstream text;
        text << std::fixed << std::setprecision(digits);
        if (sign) text << std::showpos;
        text << value;
        return text.str();
    };

    out << "Drop " << record.drop << " on " << wall << " at time " << record.time << " s: "
        << word(shape.state) << '\n';
    line("prescribed angle") << (std::isnan(record.prescribed) ? "none" : fixed(record.prescribed, 2) + " deg") << '\n';
    const bool cap = shape.state == DropState::attached;
    if (cap || shape.state == DropState::bridge)
    {
        if (cap)
        {
            line("measured angle") << fixed(shape.angle, 2) << " deg\n";
            line("fit residual") << fixed(shape.residual, 3) << " spacings\n";
        }
        else line("measured angle") << "none, for it is no cap: it touches another wall too, or this one from several sides\n";
        line("along the line");
        if (std::isnan(shape.mean)) out << "no contact line\n";
        else
        {
            out << fixed(shape.mean, 2) << " deg on average, from " << fixed(shape.min, 2) << " to "
                << fixed(shape.max, 2) << '\n';
        }
        if (!std::isnan(shape.advancing))
        {
            line("advancing side") << fixed(shape.advancing, 2) << " deg, receding side "
                << fixed(shape.receding, 2) << '\n';
        }
        if (!std::isnan(record.capillaryLength))
        {
            line("capillary length") << fixed(1e3*record.capillaryLength, 3) << " mm";
            if (!std::isnan(record.sigma)) out << ", sigma " << fixed(1e3*record.sigma, 2) << " mN/m";
            out << '\n';
        }
        if (!std::isnan(record.profileRadius))
        {
            line("by the profile") << fixed(record.profileAngle, 2) << " deg, contact radius "
                << fixed(1e3*record.profileRadius, 4) << " mm\n";
        }
    }
    else
    {
        const char* const reason = shape.state == DropState::film ? "a film" : "off the wall";
        line("measured angle") << "none, the drop is " << reason << '\n';
    }
    line("contact radius") << fixed(1e3*shape.contactRadius, 4) << " mm";
    if (!std::isnan(shape.lineRadius)) out << ", of the line by its tangents " << fixed(1e3*shape.lineRadius, 4) << " mm";
    out << '\n';
    line("height") << fixed(1e3*shape.height, 4) << " mm\n";
    line("covered area") << fixed(1e6*shape.coveredArea, 4) << " mm2\n";
    line("volume") << fixed(1e9*record.volume, 4) << " mm3\n";
    line("volume drift") << fixed(100*record.particleDrift, 2, true) << " % against " << record.particles
        << " particles, " << fixed(100*record.firstDrift, 2, true) << " % since the first time\n";
    return out.str();
}

}
