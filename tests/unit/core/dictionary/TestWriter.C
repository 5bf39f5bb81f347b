// SPDX-License-Identifier: GPL-3.0-or-later
// Written dictionaries read back as the same; JSON.

#include "core/dictionary/DictionaryExpansion.H"
#include "core/dictionary/DictionaryJson.H"
#include "core/dictionary/DictionaryWriter.H"

#include <gtest/gtest.h>

#include <sstream>

using namespace shizuku;

namespace
{

std::string written(const std::string& text)
{
    std::ostringstream stream;
    writeEntries(stream, *expandDictionary(SourceText(text, "text")));
    return stream.str();
}

std::string json(const std::string& text)
{
    std::ostringstream stream;
    writeJson(stream, *expandDictionary(SourceText(text, "text")));
    return stream.str();
}

}

TEST(Writer, WritesValuesThatEndWithADictionary)
{
    const std::string text = "scheme          Gauss multi {\n    CO              limited 1;\n};\n";
    EXPECT_EQ(written(text), text);
}

TEST(Writer, LaysOutAsOpenFoamDoes)
{
    EXPECT_EQ
    (
        written("a 1; averyveryverylongkeyword 2; flag; d { s \"a \\\"b\\\"\"; \"(U|k)\" [m/s] (1 2 3); e { } }"),
        "a               1;\n"
        "averyveryverylongkeyword 2;\n"
        "flag;\n"
        "d\n"
        "{\n"
        "    s               \"a \\\"b\\\"\";\n"
        "    \"(U|k)\"         [m/s] (1 2 3);\n"
        "    e\n"
        "    {\n"
        "    }\n"
        "}\n"
    );
}

TEST(Writer, WhatItWritesReadsBackTheSame)
{
    const std::string text = written
    (
        "x 3; l (1 2 3); ll ((0 0 1) 2(5 6) 3{7}); dicts ( first { a 1; } { b (1 2); } );\n"
        "long (0 1 2 3 4 5 6 7 8 9 10 11); f nonuniform List<vector> 2 ((0 0 0) (1 1 1)); c #{ verbatim ; } #};\n"
        "div(phi,U) Gauss linear; g [0 1 -2 0 0 0 0] (0 0 $x); s \"\"; \"a.*\" { b { c { } } } n #calc \"1/3\";\n"
    );
    EXPECT_EQ(written(text), text);
    EXPECT_NE(text.find("g               [0 1 -2 0 0 0 0] (0 0 3);"), std::string::npos);
    EXPECT_NE(text.find("long            (\n    0\n    1\n"), std::string::npos);
}

TEST(Json, MapsEveryKind)
{
    EXPECT_EQ
    (
        json("a 1.50; b +2; c .5; w on; s \"q\\\"\\\\\"; none; two Gauss linear; l (1 (2 x)); "
             "u 3{0}; g [0 1 0 0 0 0 0] 1; d { e nan; } z { }"),
        "{\n"
        "    \"a\": 1.5,\n"
        "    \"b\": 2,\n"
        "    \"c\": 0.5,\n"
        "    \"w\": \"on\",\n"
        "    \"s\": \"q\\\"\\\\\\\\\",\n"
        "    \"none\": null,\n"
        "    \"two\": [\"Gauss\", \"linear\"],\n"
        "    \"l\": [1, [2, \"x\"]],\n"
        "    \"u\": [0, 0, 0],\n"
        "    \"g\": [\"[0 1 0 0 0 0 0]\", 1],\n"
        "    \"d\": {\n"
        "        \"e\": \"nan\"\n"
        "    },\n"
        "    \"z\": {}\n"
        "}\n"
    );
}
