// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/ObjFile.H"

#include "core/messages/Error.H"
#include "core/paths/Existence.H"
#include "meshes/PolygonTriangles.H"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace shizuku
{

namespace
{

class ObjReader
{
public:
    ObjReader(const std::filesystem::path& file, const std::string& unnamed)
    :
        file_(file.string()), in_(file, std::ios::binary), unnamed_{unnamed, unnamed}
    {
        if (!in_ || !isFile(file)) fail("Cannot read the surface file " + file_, "");
        if (std::filesystem::file_size(file) == 0) fail("The surface file is empty", "an OBJ surface");
    }

    PatchedSurface read()
    {
        for (std::string text; nextLine(text);)
        {
            std::istringstream words(text);
            std::string keyword;
            words >> keyword;
            if (keyword == "v") readVertex(words);
            else if (keyword == "f") readFace(words);
            else if (keyword == "g" || keyword == "o") readName(words, keyword == "g" ? group_ : object_);
        }
        line_ = 0;
        if (surface_.mesh.faces.empty()) fail("The OBJ file has no face", "lines that begin with f");
        return std::move(surface_);
    }

private:
    [[noreturn]] void fail(const std::string& found, const std::string& expected) const
    {
        throw FatalInputError({file_, line_}, found, expected);
    }

    // Without its comment; a line that ends with a backslash goes on in the next one.
    bool nextLine(std::string& text)
    {
        text.clear();
        for (std::string part; std::getline(in_, part);)
        {
            ++line_;
            if (!part.empty() && part.back() == '\r') part.pop_back();
            std::size_t comment = part.find('#');       // within a word it is part of that
            while (comment != part.npos && comment > 0 && !std::isspace(static_cast<unsigned char>(part[comment - 1])))
            {
                comment = part.find('#', comment + 1);
            }
            if (comment != part.npos) part.resize(comment);
            const std::size_t last = part.find_last_not_of(" \t");
            const bool goesOn = comment == part.npos && last != part.npos && part[last] == '\\';
            if (goesOn) part[last] = ' ';
            text += part;
            if (!goesOn) return true;
        }
        return !text.empty();
    }

    // Its first word, and all of it.
    static void readName(std::istringstream& words, PatchName& name)
    {
        name = {};
        std::getline(words >> std::ws, name.given);
        name.given.erase(name.given.find_last_not_of(" \t") + 1);
        name.word = name.given.substr(0, name.given.find_first_of(" \t"));
    }

    void readVertex(std::istringstream& words)
    {
        Vector3 vertex;
        for (int c = 0; c < 3; ++c)
        {
            std::string word;
            words >> word;
            char* end = nullptr;
            vertex[c] = std::strtod(word.c_str(), &end);
            if (word.empty() || *end != '\0' || !std::isfinite(vertex[c])) fail("Found '" + word + "'", "a finite coordinate");
        }
        surface_.mesh.vertices.push_back(vertex);
    }

    void readFace(std::istringstream& words)
    {
        std::vector<int> corners;
        for (std::string word; words >> word;) corners.push_back(vertexOf(word));
        if (corners.size() < 3) fail("A face of " + std::to_string(corners.size()) + " vertices", "three or more");
        const int patch = surface_.patchIndex(!group_.word.empty() ? group_ : !object_.word.empty() ? object_ : unnamed_);
        for (const auto& triangle : trianglesOf(surface_.mesh.vertices, corners))
        {
            surface_.mesh.faces.push_back(triangle);
            surface_.patch.push_back(patch);
        }
    }

    // "7", "7/1/3", "-1": counted from 1, or from the last vertex backwards.
    int vertexOf(const std::string& word) const
    {
        char* end = nullptr;
        const long count = long(surface_.mesh.vertices.size());
        const long index = std::strtol(word.c_str(), &end, 10);
        const long place = index > 0 ? index - 1 : count + index;
        if (end == word.c_str() || (*end != '\0' && *end != '/') || index == 0 || place < 0 || place >= count)
        {
            fail("A face names the vertex '" + word + "'", "1 to " + std::to_string(count) + ", the vertices before it");
        }
        return int(place);
    }

    std::string file_;
    std::ifstream in_;
    int line_ = 0;
    PatchName unnamed_, group_, object_;
    PatchedSurface surface_;
};

}

PatchedSurface readObj(const std::filesystem::path& file, const std::string& unnamed)
{
    return ObjReader(file, unnamed).read();
}

}
