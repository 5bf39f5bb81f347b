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

constexpr std::size_t bytesEach = 4*sizeof(std::uint16_t);          // a particle
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

std::string encodeFrame(const ViewHead& head, std::string_view words)
{
    const std::size_t shown = words.size()/bytesEach;
    std::string text = "{\"kind\":" + jsonText(head.kind) + ",\"time\":" + jsonNumber(head.time) + ",\"step\":" + std::to_string(head.step)
        + ",\"particles\":" + std::to_string(head.particles) + ",\"shown\":" + std::to_string(shown) + ",\"low\":" + jsonVector(head.low)
        + ",\"high\":" + jsonVector(head.high) + ",\"spacing\":" + jsonNumber(head.spacing) + ",\"most\":" + jsonNumber(head.most)
        + ",\"unit\":" + jsonText(head.unit) + ",\"values\":" + jsonNumbers(head.numbers) + (head.walls.empty() ? "" : ",\"walls\":" + head.walls) + "}";
    text.resize((text.size() + 3)/4*4, ' ');

    const auto length = std::uint32_t(text.size());
    std::string message;
    message.reserve(sizeof length + text.size() + words.size());
    message.append(reinterpret_cast<const char*>(&length), sizeof length).append(text).append(words);
    return message;
}

std::string encodeFrame(const ViewFrame& frame, std::size_t limit)
{
    const std::size_t particles = frame.positions.size(), shown = std::min(limit, particles);
    const Box box = boxOf(frame.positions);
    ViewHead head = frame;
    head.particles = particles;
    head.low = box.low;
    head.high = box.high;
    if (!(head.most > 0) && !frame.values.empty()) head.most = *std::max_element(frame.values.begin(), frame.values.end());

    std::string all(shown*bytesEach, '\0');
    for (std::size_t k = 0; k < shown; ++k)
    {
        const std::size_t i = k*particles/shown;
        const Vector3& x = frame.positions[i];
        const std::uint16_t words[]
        {
            quantised(x.x, box.low.x, box.high.x), quantised(x.y, box.low.y, box.high.y), quantised(x.z, box.low.z, box.high.z),
            frame.values.empty() ? std::uint16_t(0) : quantised(frame.values[i], 0, head.most)
        };
        std::memcpy(all.data() + k*bytesEach, words, bytesEach);
    }
    return encodeFrame(head, all);
}

}
