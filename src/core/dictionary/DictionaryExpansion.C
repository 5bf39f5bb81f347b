// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/DictionaryExpansion.H"
#include "core/dictionary/Expansion.H"
#include "core/paths/Existence.H"

#include <fstream>
#include <sstream>

namespace shizuku
{

std::string readText(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream || isFolder(file))
    {
        throw FatalInputError({file.string(), 0}, "Cannot open file " + file.string(),
            "a dictionary file that can be read");
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
