// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/Dictionary.H"
#include "core/messages/Error.H"
#include "liveView/CaseSliders.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

using namespace shizuku;
namespace fs = std::filesystem;

namespace
{

class CaseSlidersTest : public testing::Test
{
protected:
    CaseSlidersTest()
    {
        fs::create_directories(folder_/"constant");
        write("wettability", "// angles\nfloor { theta 60; }\nlid { type stripes; theta (30 110); }\n");
        write("liquidProperties", "#includeEtc \"caseDefaults/liquids/water\"\n");
        write("models", "bodyForce gravity;\n");
        write("g", "dimensions [0 1 -2 0 0 0 0];\nvalue (0 0 -9.81);\n");
    }

    void write(const std::string& file, const std::string& text) const { std::ofstream(folder_/"constant"/file) << text; }
    std::string text(const std::string& file) const
    {
        std::ifstream stream(folder_/"constant"/file);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    std::vector<std::string> names() const
    {
        std::vector<std::string> names;
        const CaseSliders sliders(folder_);
        for (const CaseSlider& slider : sliders.all()) names.push_back(slider.name);
        return names;
    }

    const test::ScratchFolder scratch_;
    const fs::path folder_ = scratch_.path();
};

}

TEST_F(CaseSlidersTest, AnglesLiquidAndGravityHaveOne)
{
    EXPECT_EQ(names(), (std::vector<std::string>{"theta:floor", "sigma", "nu", "g:x", "g:y", "g:z"}));
    write("models", "bodyForce none;\n");
    EXPECT_EQ(names(), (std::vector<std::string>{"theta:floor", "sigma", "nu"}));
}

TEST_F(CaseSlidersTest, FilesAreChangedAsAnEditorDoesIt)
{
    CaseSliders sliders(folder_);
    sliders.set("theta:floor", 120.5);
    EXPECT_EQ(text("wettability"), "// angles\nfloor { theta 120.5; }\nlid { type stripes; theta (30 110); }\n");
    sliders.set("g:z", -3);
    EXPECT_NE(text("g").find("value (0 0 -3);"), std::string::npos);
    sliders.set("sigma", 0.05);                 // which an included file gives
    EXPECT_EQ(Dictionary::read(folder_/"constant/liquidProperties").lookupDimensioned("sigma", dimensions::surfaceTension), 0.05);
    EXPECT_TRUE(sliders.readIfChanged());
    EXPECT_FALSE(sliders.readIfChanged());
    EXPECT_EQ(sliders.all()[0].value, 120.5);
    EXPECT_EQ(sliders.all()[1].value, 0.05);
}

TEST_F(CaseSlidersTest, WhatIsNoSliderOrOutOfRangeChangesNothing)
{
    CaseSliders sliders(folder_);
    const std::string before = text("wettability");
    EXPECT_THROW(sliders.set("theta:lid", 60), FatalInputError);
    EXPECT_THROW(sliders.set("../system/controlDict:endTime", 60), FatalInputError);
    EXPECT_THROW(sliders.set("theta:floor", 181), FatalInputError);
    EXPECT_THROW(sliders.set("theta:floor", -1), FatalInputError);
    EXPECT_EQ(text("wettability"), before);
}

TEST_F(CaseSlidersTest, HalfAnEditLeavesTheFormerValues)
{
    CaseSliders sliders(folder_);
    write("wettability", "floor { theta ");
    EXPECT_TRUE(sliders.readIfChanged());
    EXPECT_EQ(sliders.all()[0].value, 60);
}
