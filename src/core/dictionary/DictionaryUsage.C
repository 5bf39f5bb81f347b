#include "core/dictionary/Dictionary.H"
#include "core/dictionary/DictionaryNode.H"

namespace shizuku
{

namespace
{

void refuseUnusedBelow(const Tree& dictionary, const std::string& name)
{
    for (const auto& [key, entry] : dictionary)
    {
        const NodeData& data = entry.data();
        if (key == "FoamFile" || key.starts_with('_')) continue;
        if (!data.used)
        {
            const std::set<std::string>& asked = dictionary.data().asked;
            throw FatalInputError
            (
                data.where, "Unknown entry '" + key + "' in dictionary \"" + name + "\": nothing reads it",
                "one of the keywords below", {asked.begin(), asked.end()}, key
            );
        }
        if (data.kind == NodeKind::dictionary) refuseUnusedBelow(entry, name + "/" + key);
    }
}

}

void Dictionary::refuseUnused() const
{
    refuseUnusedBelow(*node_->tree, node_->name);
}

void Dictionary::markUsed() const
{
    shizuku::markUsed(*node_->tree);
}

}
