// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/selection/RunTimeSelection.H"
#include "support/ScratchFolder.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// A family of models, made of a dictionary and a number that stands for the rest.
class Spring
{
public:
    virtual ~Spring() = default;
    virtual double force(double extension) const = 0;
};
using SpringTable = RunTimeSelection<Spring, const Dictionary&, double&>;

class Linear : public Spring
{
public:
    Linear(const Dictionary& dict, double& made) : stiffness_(dict.lookup<double>("stiffness")) { made += 1; }
    double force(double extension) const override { return -stiffness_ * extension; }

private:
    double stiffness_;
};

class NoSpring : public Spring
{
public:
    NoSpring(const Dictionary&, double& made) { made += 10; }
    double force(double) const override { return 0; }
};

// A family of its own with a word of the same name.
class Damper
{
public:
    virtual ~Damper() = default;
};
using DamperTable = RunTimeSelection<Damper>;
class LinearDamper : public Damper {};

const SpringTable::Add<Linear> addLinear{"linear"};
const SpringTable::Add<NoSpring> addNone{"none"};
const DamperTable::Add<LinearDamper> addDamper{"linear"};

}

TEST(RunTimeSelection, MakesTheModelOfTheWord)
{
    double made = 0;
    const Dictionary dict = Dictionary::parse("stiffness 3;");
    EXPECT_EQ(SpringTable::New("spring", "linear", dict.where(), dict, made)->force(2), -6);
    EXPECT_EQ(SpringTable::New("spring", "none", dict.where(), dict, made)->force(2), 0);
    EXPECT_EQ(made, 11);        // one of each, by reference
}

TEST(RunTimeSelection, KeepsTheFamiliesApart)
{
    EXPECT_EQ(SpringTable::words(), (std::vector<std::string>{"linear", "none"}));
    EXPECT_EQ(DamperTable::words(), std::vector<std::string>{"linear"});
    EXPECT_NE(DamperTable::New("damper", "linear", {}), nullptr);
}

TEST(RunTimeSelection, RefusesAnUnknownWordWithTheValidOnes)
{
    double made = 0;
    const Dictionary dict = Dictionary::parse("\nspring linaer;\n", "constant/models");
    const auto select = [&]
    {
        SpringTable::New("spring", dict.lookup<std::string>("spring"), dict.where("spring"), dict, made);
    };
    EXPECT_TRUE
    (
        holds
        (
            messageOf(select),
            {"Unknown spring model 'linaer'", "constant/models", "line 2", "Did you mean 'linear'?", "none"}
        )
    );
    EXPECT_EQ(made, 0);
}

TEST(RunTimeSelection, PassesOnWhatTheModelRefuses)
{
    double made = 0;
    const Dictionary dict = Dictionary::parse("stiffness soft;");
    const auto select = [&] { SpringTable::New("spring", "linear", dict.where(), dict, made); };
    EXPECT_TRUE(holds(messageOf(select), {"stiffness", "soft"}));
}
