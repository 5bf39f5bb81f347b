// SPDX-License-Identifier: GPL-3.0-or-later
#include "liveView/ViewFrame.H"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace shizuku
{

namespace
{

static_assert(std::endian::native == std::endian::little);

constexpr double fullScale = std::numeric_limits<std::uint16_t>::max();

// A value between the ends of a range as a part of it.
std::uint16_t quantised(double value, double low, double high)
{
    if (!(high > low)) return 0;
    return std::uint16_t(std::lround(fullScale*std::clamp((value - low)/(high - low), 0.0, 1.0)));
}

struct Box
{
    Vector3 low, high;
};

Box boxOf(const std::vector<Vector3>& points)
{
    if (points.empty()) return {};
    Box box{points.front(), points.front()};
    for (const Vector3& point : points)
    {
        for (int i = 0; i < 3; ++i)
        {
            box.low[i] = std::min(box.low[i], point[i]);
            box.high[i] = std::max(box.high[i], point[i]);
        }
    }
    return box;
}

}

std::string jsonText(const std::string& text)
{
    static const char* const digits = "0123456789abcdef";
    std::string quoted = "\"";
    for (const char character : text)
    {
        const auto byte = static_cast<unsigned char>(character);
        // '<' too: such text may stand within a page's script.
        if (character == '"' || character == '\\') quoted += '\\';
        if (byte < 0x20 || character == '<') quoted.append("\\u00").append({digits[byte >> 4], digits[byte & 15]});
        else quoted += character;
    }
    return quoted + '"';
}

std::string jsonNumber(double value)
{
    if (!std::isfinite(value)) return "null";
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, 9).ptr};
}

std::string jsonNumbers(const std::vector<std::pair<std::string, double>>& numbers)
{
    std::string text = "{";
    for (const auto& [name, value] : numbers)
    {
        if (text.size() > 1) text += ',';
        text.append(jsonText(name)).append(":").append(jsonNumber(value));
    }
    return text + "}";
}

std::string jsonVector(const Vector3& vector)
{
    return "[" + jsonNumber(vector.x) + "," + jsonNumber(vector.y) + "," + jsonNumber(vector.z) + "]";
}

std::string encodeFrame(const ViewFrame& frame, std::size_t limit)
{
    const std::size_t particles = frame.positions.size();
    const std::size_t shown = std::min(limit, particles);
    const Box box = boxOf(frame.positions);
    const double most = frame.most > 0 || frame.values.empty() ? frame.most : *std::max_element(frame.values.begin(), frame.values.end());

    std::string text = "{\"kind\":" + jsonText(frame.kind) + ",\"time\":" + jsonNumber(frame.time) + ",\"step\":" + std::to_string(frame.step)
        + ",\"particles\":" + std::to_string(particles) + ",\"shown\":" + std::to_string(shown) + ",\"low\":" + jsonVector(box.low)
        + ",\"high\":" + jsonVector(box.high) + ",\"spacing\":" + jsonNumber(frame.spacing) + ",\"most\":" + jsonNumber(most)
        + ",\"unit\":" + jsonText(frame.unit) + ",\"values\":" + jsonNumbers(frame.numbers) + (frame.walls.empty() ? "" : ",\"walls\":" + frame.walls) + "}";
    text.resize((text.size() + 3)/4*4, ' ');

    const auto length = std::uint32_t(text.size());
    std::string message(sizeof length + text.size() + shown*4*sizeof(std::uint16_t), '\0');
    std::memcpy(message.data(), &length, sizeof length);
    std::memcpy(message.data() + sizeof length, text.data(), text.size());
    char* next = message.data() + sizeof length + text.size();
    for (std::size_t k = 0; k < shown; ++k)
    {
        const std::size_t i = k*particles/shown;
        const Vector3& x = frame.positions[i];
        const std::uint16_t words[]
        {
            quantised(x.x, box.low.x, box.high.x), quantised(x.y, box.low.y, box.high.y), quantised(x.z, box.low.z, box.high.z),
            frame.values.empty() ? std::uint16_t(0) : quantised(frame.values[i], 0, most)
        };
        std::memcpy(next, words, sizeof words);
        next += sizeof words;
    }
    return message;
}

}
