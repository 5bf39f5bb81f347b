// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/DictionaryExpansion.H"
#include "core/dictionary/Expansion.H"
#include "core/dictionary/IncludeFile.H"
#include "core/paths/Existence.H"

#include <fstream>
#include <sstream>

namespace shizuku
{

namespace
{

// The next step, where the tutorials have a file of that name in that folder of a case.
std::string nextStep(const std::filesystem::path& file)
{
    const std::filesystem::path inCase = file.parent_path().filename()/file.filename();
    for (const std::filesystem::path& etc : etcFolders())
    {
        const std::filesystem::path tutorials = etc.parent_path()/"tutorials";
        for (const char* tutorial : {"sessileDrop", "patternedSurface", "rainOnStreet"})
        {
            if (isFile(tutorials/tutorial/inCase)) return ": copy one to change it, e.g. " + (tutorials/tutorial/inCase).string();
        }
    }
    return "";
}

}

std::string readText(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream || isFolder(file))
    {
        throw FatalInputError({file.string(), 0}, "Cannot open file " + file.string(),
            "a dictionary file that can be read" + (isThere(file) ? "" : nextStep(file)));
    }
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

std::shared_ptr<Tree> expandDictionary(const SourceText& source)
{
    auto root = std::make_shared<Tree>();
    root->data().where = {source.name(), 1};
    Expansion(*root).addFile(source);
    return root;
}

}
