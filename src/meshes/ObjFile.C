#include "meshes/ObjFile.H"

#include "core/messages/Error.H"

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
        file_(file.string()), in_(file, std::ios::binary), unnamed_(unnamed)
    {
        if (!in_ || !std::filesystem::is_regular_file(file)) fail("Cannot read the surface file " + file_, "");
        if (std::filesystem::file_size(file) == 0) fail("The surface file is empty", "an OBJ surface");
    }

    PatchedSurface read()
    {
        for (std::string text; std::getline(in_, text);)
        {
            ++line_;
            std::istringstream words(text);
            std::string keyword;
            words >> keyword;
            if (keyword == "v") readVertex(words);
            else if (keyword == "f") readFace(words);
            else if (keyword == "g" || keyword == "o") words >> (keyword == "g" ? group_ : object_);
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
        const int patch = surface_.patchIndex(!group_.empty() ? group_ : !object_.empty() ? object_ : unnamed_);
        for (std::size_t k = 2; k < corners.size(); ++k)
        {
            surface_.mesh.faces.push_back({corners[0], corners[k - 1], corners[k]});
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
    std::string unnamed_, group_, object_;
    PatchedSurface surface_;
};

}

PatchedSurface readObj(const std::filesystem::path& file, const std::string& unnamed)
{
    return ObjReader(file, unnamed).read();
}

}
