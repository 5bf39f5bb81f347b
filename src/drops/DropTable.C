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
            {"profileRadius", "m"}, {"profileAngle", "deg"}, {"contactAngle", "deg"}, {"method", ""},
            {"localAngle", "deg"}, {"lineHeld", "%"}, {"lineAdvancing", "%"}, {"lineReceding", "%"}
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
        record.capillaryLength, record.sigma, shape.lineRadius, record.profileRadius, record.profileAngle,
        record.chosen.angle, word(record.chosen.method),
        record.line.theta, 100*record.line.held, 100*record.line.advancing, 100*record.line.receding
    });
}

std::string word(AngleMethod method)
{
    switch (method)
    {
        case AngleMethod::profile: return "profile";
        case AngleMethod::cap: return "cap";
        case AngleMethod::tangents: return "tangents";
        case AngleMethod::none: break;
    }
    return "none";
}

MeasuredAngle chosenAngle(const DropRecord& record)
{
    constexpr double follows = 0.2;                 // spacings
    const ContactAngle& shape = record.shape;
    const auto as = [](MeasuredAngle measured, AngleMethod method)
    {
        measured.method = method;
        return measured;
    };
    const MeasuredAngle& profile = record.underGravity;
    const MeasuredAngle cap{shape.angle, shape.contactRadius, shape.residual};
    if (profile.residual <= follows && profile.residual <= cap.residual) return as(profile, AngleMethod::profile);
    if (cap.residual <= follows) return as(cap, AngleMethod::cap);
    if (!std::isnan(shape.mean)) return as({shape.mean, shape.lineRadius}, AngleMethod::tangents);
    return std::isnan(cap.angle) ? MeasuredAngle() : as(cap, AngleMethod::cap);
}

namespace
{

std::string fixed(double value, int digits, bool sign = false)
{
    std::ostringstream text;
    text << std::fixed << std::setprecision(digits);
    if (sign) text << std::showpos;
    text << value;
    return text.str();
}

std::string millimetres(double length, int digits = 4) { return fixed(1e3*length, digits) + " mm"; }

// Lines of a name and what it is.
class Lines
{
public:
    std::ostream& add(const std::string& name)
    {
        return out_ << "    " << std::left << std::setw(20) << name << std::right;
    }
    std::string text() const { return out_.str(); }

private:
    std::ostringstream out_;
};

// What is said of the answer.
std::string describe(const DropRecord& record)
{
    const MeasuredAngle& chosen = record.chosen;
    switch (chosen.method)
    {
        case AngleMethod::profile: return fixed(chosen.angle, 2) + " deg, by the profile of a drop under gravity";
        case AngleMethod::cap: return fixed(chosen.angle, 2) + " deg, by a sphere";
        case AngleMethod::tangents: return fixed(chosen.angle, 2) + " deg, by tangents along the contact line";
        case AngleMethod::none: break;
    }
    switch (record.shape.state)
    {
        case DropState::film: return "none, the drop is a film";
        case DropState::detached: return "none, the drop is off the wall";
        default: return "none, the drop has no contact line";
    }
}

void addMethods(Lines& lines, const DropRecord& record)
{
    const ContactAngle& shape = record.shape;
    if (!std::isnan(record.underGravity.angle))
    {
        lines.add("by the profile") << fixed(record.underGravity.angle, 2) << " deg, contact radius " << millimetres(record.underGravity.radius)
            << ", " << fixed(record.underGravity.residual, 3) << " spacings off\n";
    }
    if (!std::isnan(shape.angle))
    {
        lines.add("by a sphere") << fixed(shape.angle, 2) << " deg, contact radius " << millimetres(shape.contactRadius)
            << ", " << fixed(shape.residual, 3) << " spacings off\n";
    }
    if (!std::isnan(shape.mean))
    {
        lines.add("by tangents") << fixed(shape.mean, 2) << " deg, from " << fixed(shape.min, 2) << " to " << fixed(shape.max, 2)
            << ", contact radius " << millimetres(shape.lineRadius) << '\n';
    }
    if (std::isnan(record.capillaryLength)) return;
    std::ostream& out = lines.add("profile, sigma free");
    out << "capillary length " << millimetres(record.capillaryLength, 3);
    if (!std::isnan(record.sigma)) out << ", sigma " << fixed(1e3*record.sigma, 2) << " mN/m";
    if (!std::isnan(record.profileAngle)) out << ", " << fixed(record.profileAngle, 2) << " deg, contact radius " << millimetres(record.profileRadius);
    out << '\n';
}

}

std::string report(const DropRecord& record, const std::string& wall, bool methods)
{
    const ContactAngle& shape = record.shape;
    std::ostringstream head;
    head << "Drop " << record.drop << " on " << wall << " at time " << record.time << " s: " << word(shape.state) << '\n';
    Lines lines;
    lines.add("prescribed angle") << (std::isnan(record.prescribed) ? "none" : fixed(record.prescribed, 2) + " deg") << '\n';
    lines.add("measured angle") << describe(record) << '\n';
    if (methods) addMethods(lines, record);
    if (!std::isnan(shape.advancing))
    {
        lines.add("advancing side") << fixed(shape.advancing, 2) << " deg, receding side " << fixed(shape.receding, 2) << '\n';
    }
    if (!std::isnan(record.line.theta)) lines.add("local angle") << fixed(record.line.theta, 2) << " deg, mean along the contact line\n";
    if (!std::isnan(record.line.held))
    {
        lines.add("contact line") << "held " << fixed(100*record.line.held, 0) << " %, advancing " << fixed(100*record.line.advancing, 0)
            << " %, receding " << fixed(100*record.line.receding, 0) << " % of its length\n";
    }
    lines.add("contact radius") << millimetres(std::isnan(record.chosen.radius) ? shape.contactRadius : record.chosen.radius) << '\n';
    lines.add("height") << millimetres(shape.height) << '\n';
    lines.add("covered area") << fixed(1e6*shape.coveredArea, 4) << " mm2\n";
    lines.add("volume") << fixed(1e9*record.volume, 4) << " mm3\n";
    lines.add("volume drift") << fixed(100*record.particleDrift, 2, true) << " % against " << record.particles
        << " particles, " << fixed(100*record.firstDrift, 2, true) << " % since the first time\n";
    return head.str() + lines.text();
}

}
