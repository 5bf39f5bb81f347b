// SPDX-License-Identifier: GPL-3.0-or-later
// Edits change the bytes of their entry and no others.

#include "core/dictionary/DictionaryEditor.H"
#include "support/ScratchFolder.H"
#include "unit/core/dictionary/Refused.H"

#include <gtest/gtest.h>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

const std::string original =
    "// banner\n"
    "FoamFile { class dictionary; }\n"
    "\n"
    "floor   // the wall below\n"
    "{\n"
    "    theta     60;   // degrees\n"
    "    nested { a 1; }\n"
    "    $defaults;\n"
    "    last      /* why */ (1 2  3) ; /* kept */\n"
    "}\n"
    "empty\n"
    "{\n"
    "}\n"
    "\"(U|k)\" { b 2; }\n"
    "alpha.water 1;\n"
    "flag;\n"
    "// ****** //\n";

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    return text.replace(text.find(from), from.size(), to);
}

template<class Edit>
std::string edited(const Edit& edit, const std::string& text = original)
{
    DictionaryEditor editor(text, "someDict");
    edit(editor);
    return editor.text();
}

std::string afterSet(const std::string& path, const std::string& value)
{
    return edited([&](DictionaryEditor& editor) { editor.set(path, value); });
}

std::string afterAdd(const std::string& path, const std::string& value, const std::string& text = original)
{
    return edited([&](DictionaryEditor& editor) { editor.add(path, value); }, text);
}

std::string afterRemove(const std::string& path, const std::string& text = original)
{
    return edited([&](DictionaryEditor& editor) { editor.remove(path); }, text);
}

}

TEST(Editor, SetsValues)
{
    EXPECT_EQ(afterSet("floor.theta", "30"), replaced(original, "60;", "30;"));
    EXPECT_EQ(afterSet("floor/theta", " $x "), replaced(original, "60;", "$x;"));
    EXPECT_EQ(afterSet("floor.nested.a", "(1 2)"), replaced(original, "a 1;", "a (1 2);"));
    EXPECT_EQ(afterSet("floor.last", "5"), replaced(original, "(1 2  3) ;", "5 ;"));
    EXPECT_EQ(afterSet("(U|k).b", "3"), replaced(original, "b 2;", "b 3;"));
    EXPECT_EQ(afterSet("\"(U|k)\"/b", "3"), replaced(original, "b 2;", "b 3;"));
    EXPECT_EQ(afterSet("alpha.water", "2"), replaced(original, "water 1;", "water 2;"));
    EXPECT_EQ(afterSet("flag", "on"), replaced(original, "flag;", "flag on;"));
}

TEST(Editor, TurnsEntriesIntoDictionariesAndBack)
{
    EXPECT_EQ(afterSet("floor.nested", "{ c 3; }"), replaced(original, "{ a 1; }", "{ c 3; }"));
    EXPECT_EQ(afterSet("floor.nested", "off"), replaced(original, "{ a 1; }", "off;"));
    EXPECT_EQ(afterSet("floor.theta", "{ c 3; }"), replaced(original, "60;", "{ c 3; }"));
    EXPECT_EQ(afterSet("flag", "{ }"), replaced(original, "flag;", "flag { }"));
}

TEST(Editor, SetsTheLastOfRepeatedEntries)
{
    const std::string text = "a { x 1; } b 1; a { x 2; } a { y 3; } b 2;";
    const auto set = [](const char* path) { return [path](DictionaryEditor& editor) { editor.set(path, "9"); }; };
    EXPECT_EQ(edited(set("b"), text), replaced(text, "b 2", "b 9"));
    EXPECT_EQ(edited(set("a.x"), text), replaced(text, "x 2", "x 9"));
}

TEST(Editor, AddsEntriesInStyle)
{
    EXPECT_EQ(afterAdd("floor.b", "5"), replaced(original, "/* kept */\n", "/* kept */\n    b                   5;\n"));
    EXPECT_EQ(afterAdd("floor.nested.c", "2"), replaced(original, "{ a 1; }", "{ a 1; c 2; }"));
    EXPECT_EQ(afterAdd("empty.c", "{ d 2; }"), replaced(original, "empty\n{\n", "empty\n{\n    c { d 2; }\n"));
    EXPECT_EQ(afterAdd("roof", "1"), replaced(original, "flag;\n", "flag;\nroof            1;\n"));
    EXPECT_EQ(afterAdd("b", "", "a 1;"), "a 1;\nb;\n");
    EXPECT_EQ(afterAdd("b", "1", ""), "b               1;\n");
    EXPECT_EQ(afterAdd("b", "1", "// only a comment\n"), "// only a comment\nb               1;\n");
    EXPECT_EQ(afterAdd("a.b", "1", "a {}"), "a { b               1; }");
    EXPECT_EQ(afterAdd("a.\"(x|y)\"", "1", "a\n{\n\tc 2;\n}\n"), "a\n{\n\tc 2;\n\t\"(x|y)\" 1;\n}\n");
}

TEST(Editor, RemovesEntriesAndLeavesComments)
{
    EXPECT_EQ(afterRemove("floor.theta"),
        replaced(original, "    theta     60;   // degrees\n", "       // degrees\n"));
    EXPECT_EQ(afterRemove("floor.nested"), replaced(original, "    nested { a 1; }\n", ""));
    EXPECT_EQ(afterRemove("floor.nested.a"), replaced(original, "{ a 1; }", "{ }"));
    EXPECT_EQ(afterRemove("empty"), replaced(original, "empty\n{\n}\n", ""));
    EXPECT_EQ(afterRemove("flag"), replaced(original, "flag;\n", ""));
    EXPECT_EQ(afterRemove("a", "a 1; b 2;\na 3;\n"), " b 2;\n");        // all of the repeated ones
    EXPECT_EQ(afterRemove("b", "a 1;\nb 2;"), "a 1;\n");
}

TEST(Editor, UndoesItself)
{
    const std::string text = edited([](DictionaryEditor& editor)
    {
        editor.add("floor.extra", "1");
        editor.set("floor.theta", "30");
        editor.set("floor.theta", "60");
        editor.remove("floor.extra");
    });
    EXPECT_EQ(text, original);
}

TEST(Editor, RefusesWhatDoesNotFit)
{
    const Refusal missing = refusalOf([] { afterSet("floor.teta", "1"); });
    EXPECT_EQ(missing.line, 4);
    EXPECT_TRUE(holds(missing.message, {"'floor.teta' is not written in someDict", "Did you mean 'theta'?"}));
    EXPECT_EQ(refusalOf([] { afterAdd("floor.theta", "1"); }).line, 6);
    EXPECT_EQ(refusalOf([] { afterAdd("alpha.water.x", "1"); }).line, 15);
    EXPECT_NE(refusalOf([] { afterAdd("absent.x", "1"); }).line, -1);
    EXPECT_NE(refusalOf([] { afterRemove("absent"); }).line, -1);
    for (const char* value : {"1; b 2", "(1 2", "1)", "{ a 1; } b", "60; // comment", "\"open", "{ a 1 }"})
    {
        EXPECT_NE(refusalOf([&] { afterSet("floor.theta", value); }).line, -1) << value;
    }
    EXPECT_EQ(refusalOf([] { DictionaryEditor("a 1;\nb {", "someDict"); }).line, 2);
}
