#include "meshes/PatchedSurface.H"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace shizuku
{

int PatchedSurface::patchIndex(std::string name)
{
    for (char& c : name)
    {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) || std::strchr("_-.+:", c);
        if (!plain) c = '_';
    }
    const auto found = std::find(patches.begin(), patches.end(), name);
    if (found != patches.end()) return static_cast<int>(found - patches.begin());
    patches.push_back(name);
    return static_cast<int>(patches.size()) - 1;
}

}
