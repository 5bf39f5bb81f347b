#include "core/dictionary/DictionaryExpansion.H"
#include "core/dictionary/DictionaryGrammar.H"

#include <fstream>
#include <sstream>

namespace shizuku
{

namespace
{

void merge(Tree& target, const Tree& statements)
{
    for (const auto& [key, statement] : statements)
    {
        Tree* same = findSameKeyword(target, key, statement.data().style);
        if (!same) target.push_back({key, statement});
        else if (same->data().kind == NodeKind::dictionary && statement.data().kind == NodeKind::dictionary) merge(*same, statement);
        else *same = statement;
    }
}

}

std::string readText(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream || std::filesystem::is_directory(file))
    {
        throw FatalInputError({file.string(), 0}, "Cannot open file " + file.string(), "a dictionary file that can be read");
    }
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

std::shared_ptr<Tree> expandDictionary(const SourceText& source)
{
    auto result = std::make_shared<Tree>();
    const Tree syntax = parseSyntax(source);
    result->data() = syntax.data();
    merge(*result, syntax);
    return result;
}

}
