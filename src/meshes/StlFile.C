// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/StlFile.H"

#include "core/messages/Error.H"
#include "core/paths/Existence.H"

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

namespace shizuku
{

using boost::algorithm::iequals;

namespace
{

constexpr std::size_t binaryHeader = 84;    // 80 bytes of text, a 32-bit count
constexpr std::size_t binaryFacet = 50;     // normal and three vertices as floats, two bytes of attributes

void addFacet(PatchedSurface& surface, const std::array<Vector3, 3>& corners, int patch)
{
    const int first = static_cast<int>(surface.mesh.vertices.size());
    surface.mesh.vertices.insert(surface.mesh.vertices.end(), corners.begin(), corners.end());
    surface.mesh.faces.push_back({first, first + 1, first + 2});
    surface.patch.push_back(patch);
}

// Splits text into words and counts lines.
class Words
{
public:
    explicit Words(std::string_view text) : rest_(text) {}

    // The next word, empty at the end. restOfLine: up to the end of this line, where there is one before that.
    std::string_view next(bool onThisLine = false)
    {
        while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_.front())))
        {
            if (isLineEnd())
            {
                if (onThisLine) return {};
                ++line_;
            }
            rest_.remove_prefix(1);
        }
        const auto end = std::find_if(rest_.begin(), rest_.end(), [](unsigned char c) { return std::isspace(c); });
        const std::string_view word = rest_.substr(0, end - rest_.begin());
        rest_.remove_prefix(word.size());
        return word;
    }

    void skipLine() { while (!next(true).empty()) {} }
    int line() const { return line_; }

private:
    // Of a carriage return and a line feed the second one.
    bool isLineEnd() const { return rest_.front() == '\n' || (rest_.front() == '\r' && !rest_.starts_with("\r\n")); }

    std::string_view rest_;
    int line_ = 1;
};

class AsciiStl
{
public:
    AsciiStl(const std::filesystem::path& file, std::string_view text, const std::string& unnamed)
    :
        file_(file.string()), words_(text), unnamed_(unnamed)
    {}

    PatchedSurface read()
    {
        PatchedSurface surface;
        int patch = -1;                         // of the solid that is open
        for (std::string word = keyword(); !word.empty(); word = keyword())
        {
            if (iequals(word, "solid"))          // keywords come in any case
            {
                PatchName name;
                for (std::string_view part = words_.next(true); !part.empty(); part = words_.next(true))
                {
                    if (name.word.empty()) name.word = part;
                    name.given += (name.given.empty() ? "" : " ") + std::string(part);
                }
                patch = surface.patchIndex(name.word.empty() ? PatchName{unnamed_, unnamed_} : name);
            }
            else if (iequals(word, "facet") && patch >= 0)
            {
                addFacet(surface, facet(), patch);
            }
            else if (iequals(word, "endsolid") && patch >= 0)
            {
                patch = -1;
                words_.skipLine();
            }
            else
            {
                fail(word, patch < 0 ? "solid" : "facet, endsolid or solid");
            }
        }
        if (patch >= 0) fail("", "facet or endsolid");
        return surface;
    }

private:
    std::array<Vector3, 3> facet()
    {
        expect("normal");
        for (int c = 0; c < 3; ++c) number();   // scanners write nan here for slivers: only the vertices count
        expect("outer");
        expect("loop");
        std::array<Vector3, 3> corners;
        for (Vector3& corner : corners)
        {
            expect("vertex");
            for (int c = 0; c < 3; ++c) corner[c] = finiteNumber();
        }
        expect("endloop");
        expect("endfacet");
        return corners;
    }

    double number()
    {
        const std::string_view word = words_.next();
        double value = 0;
        const char* first = word.data() + (!word.empty() && word.front() == '+');
        const auto [end, error] = std::from_chars(first, word.data() + word.size(), value);
        if (error != std::errc() || end != word.data() + word.size()) fail(word, "a number");
        return value;
    }

    double finiteNumber()
    {
        const double value = number();
        if (!std::isfinite(value)) fail(std::to_string(value), "a finite coordinate");
        return value;
    }

    // Some programs write the end of a block as two words, as in "end loop".
    std::string keyword()
    {
        const std::string word(words_.next());
        return iequals(word, "end") ? word + std::string(words_.next()) : word;
    }

    void expect(std::string_view expected)
    {
        const std::string word = keyword();
        if (!iequals(word, expected)) fail(word, expected);
    }

    [[noreturn]] void fail(std::string_view word, std::string_view expected) const
    {
        const std::string found = word.empty() ? "The STL file ends too early" : "Found '" + std::string(word) + "'";
        throw FatalInputError({file_, words_.line()}, found, std::string(expected));
    }

    std::string file_;
    Words words_;
    std::string unnamed_;
};

PatchedSurface readBinary(const std::string& file, std::string_view bytes, const std::string& unnamed)
{
    std::uint32_t facets = 0;
    if (bytes.size() >= binaryHeader) std::memcpy(&facets, bytes.data() + binaryHeader - sizeof(facets), sizeof(facets));
    const std::size_t size = binaryHeader + binaryFacet*std::size_t(facets);
    if (bytes.size() > size && facets > 0)
    {
        warning(std::to_string(bytes.size() - size) + " bytes behind the last facet of the binary STL are not read", {file, 0});
    }
    else if (bytes.size() != size)
    {
        throw FatalInputError
        (
            {file, 0}, "The file is no STL, or not all of one: it has " + std::to_string(bytes.size()) + " bytes",
            std::to_string(size) + " bytes for the " + std::to_string(facets) + " facets that its header announces"
        );
    }
    PatchedSurface surface;
    surface.patches = {unnamed};
    for (std::uint32_t f = 0; f < facets; ++f)
    {
        std::array<float, 12> values;
        std::memcpy(values.data(), bytes.data() + binaryHeader + binaryFacet*f, sizeof(values));
        std::array<Vector3, 3> corners;
        for (int k = 0; k < 9; ++k)
        {
            if (!std::isfinite(values[3 + k]))
            {
                throw FatalInputError
                (
                    {file, 0}, "Facet " + std::to_string(f) + " of the binary STL has a coordinate that is not finite"
                );
            }
            corners[k/3][k % 3] = values[3 + k];
        }
        addFacet(surface, corners, 0);
    }
    return surface;
}

}

PatchedSurface readStl(const std::filesystem::path& file, const std::string& unnamed)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream || !isFile(file))
    {
        throw FatalInputError({file.string(), 0}, "Cannot read the surface file " + file.string());
    }
    std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);     // some editors mark UTF-8 text so
    if (bytes.empty()) throw FatalInputError({file.string(), 0}, "The surface file is empty", "an STL surface");

    PatchedSurface surface;
    if (bytes.find('\0') != std::string::npos)      // a binary file may begin with "solid" too
    {
        surface = readBinary(file.string(), bytes, unnamed);
    }
    else if (iequals(Words(bytes).next(), "solid"))
    {
        surface = AsciiStl(file, bytes, unnamed).read();
    }
    else
    {
        throw FatalInputError({file.string(), 1}, "The file is no STL", "text that begins with 'solid', or a binary STL");
    }
    if (surface.mesh.faces.empty())
    {
        throw FatalInputError({file.string(), 0}, "The STL file has no facet", "one facet at least");
    }
    return surface;
}

}
