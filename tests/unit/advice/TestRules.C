// SPDX-License-Identifier: GPL-3.0-or-later
// Each rule turns where a formula of its own, written out here, says so: just below and just above the tolerance.

#include "advice/Rule.H"
#include "unit/advice/FakeStudies.H"

#include <cmath>
#include <numbers>

namespace shizuku::test
{

namespace
{

constexpr double close = 1e-6;          // relative, of the tolerance about the turning point; doubles
constexpr double pi = std::numbers::pi;

class RuleTest : public FakeStudies
{
protected:
    // A drop of water of 2000 particles that stands on a level floor.
    RuleTest()
    {
        scene_.studies = &*studies_;
        scene_.tolerance = 0.05;
        scene_.density = 1000;
        scene_.viscosity = 1e-6;
        scene_.surfaceTension = 0.07;
        scene_.spacing = 1e-4;
        scene_.duration = 0.05;
        scene_.models =
        {
            {"pressure", "completedPbf"}, {"surfaceTension", "laplacePressure"}, {"wetting", "extendedSurface"},
            {"viscosity", "XSPH"}, {"bodyForce", "none"}, {"particleShifting", "none"}
        };
        scene_.maxCapillaryCo = 0.7;
        scene_.smoothing = 0.2;
        scene_.support = 2;
        scene_.maxIterations = 8;
        scene_.refillable = true;
        scene_.subStep = 2e-5;
        scene_.limit = "capillary";
        scene_.walls = {{"floor", "plane", Plane{{}, {0, 0, 1}}, {}, {}, 60.0, true}};
        fill(2000);
    }

    void fill(double particles, double impactSpeed = 0)
    {
        SeparateBody liquid;
        liquid.volume = particles*std::pow(scene_.spacing, 3);
        scene_.bodies = {{liquid, 0, 0, impactSpeed}};
    }

    double diameter() const { return std::cbrt(6*scene_.bodies[0].liquid.volume/pi); }

    std::optional<Advice> ask(const std::string& rule, double tolerance) const
    {
        Scene scene = scene_;
        scene.tolerance = tolerance;
        return AdviceRules::New("advice", rule, {})->advise(scene);
    }

    // "models.surfaceTension=none ..." of what is changed.
    static std::string changes(const std::optional<Advice>& advice)
    {
        std::string text = advice ? "" : "no advice";
        for (const CaseChange& change : advice ? advice->changes : std::vector<CaseChange>())
        {
            text += (text.empty() ? "" : " ") + change.entry + "=" + change.value;
        }
        return text;
    }

    Scene scene_;
};

TEST_F(RuleTest, TensionOfWhatIsHeavyOrFast)
{
    scene_.walls.front().type = "box";              // which holds the liquid
    scene_.gravity = {0, 0, -10};
    fill(2000, 3);
    const double D = diameter(), Bo = 1000*10*D*D/0.07, We = 1000*9*D/0.07, effect = 1/(Bo + We);
    EXPECT_EQ(changes(ask("tension", effect*(1 - close))), "");
    EXPECT_EQ(changes(ask("tension", effect*(1 + close))), "surfaceTension=none wetting=none");
    scene_.models["surfaceTension"] = scene_.models["wetting"] = "none";
    EXPECT_EQ(changes(ask("tension", effect*(1 + close))), "");
    EXPECT_EQ(changes(ask("tension", effect*(1 - close))), "surfaceTension=laplacePressure wetting=extendedSurface");
}

TEST_F(RuleTest, TensionStopsWhatSpreads)
{
    scene_.gravity = {0, 0, -10};
    fill(2e9);                                       // 0.12 to 0.16 m: Bo above 2000
    const double D = diameter(), l2 = 0.07/(1000*10);
    const double h = D*D*D/std::pow(D + std::sqrt(10*D)*scene_.duration, 2), effect = l2/(h*h);
    ASSERT_GT(effect, l2/(D*D));
    EXPECT_EQ(changes(ask("tension", effect*(1 - close))), "");
    EXPECT_EQ(changes(ask("tension", effect*(1 + close))), "surfaceTension=none wetting=none");
}

TEST_F(RuleTest, KnownFaultsAreToldAndChangeNothing)
{
    EXPECT_EQ(changes(ask("knownFaults", 0.05)), "no advice");
    scene_.faults = {"one", "two"};
    const auto advice = ask("knownFaults", 0.05);
    EXPECT_EQ(changes(advice), "");
    EXPECT_EQ(advice->reason, "one\n    two");
}

// A hemisphere under little gravity is lower by Bo (ln(2)/3 - 1/12), Bo = (R/l)^2: the perturbed Young-Laplace equation,
// (1 - x^2) e')' + 2 e = Bo (x - 2/3 + 2 k), x = cos(phi), e'(0) = 0 and no change of the volume, has
// e = Bo (k - x ln(1 + x)/3), k = 1/12. The next order is of Bo^2, some percent of it here.
TEST_F(RuleTest, GravityOnASmallDrop)
{
    constexpr double nextOrder = 0.02;
    scene_.availableGravity = {0, 0, -10};
    fill(100);
    scene_.walls.front().theta = 90;
    const double R = std::cbrt(3*scene_.bodies[0].liquid.volume/(2*pi)), Bo = 1000*10*R*R/0.07;
    ASSERT_LT(Bo, 0.02);
    const double effect = Bo*(std::log(2)/3 - 1.0/12);
    EXPECT_EQ(changes(ask("gravity", effect*(1 - nextOrder))), "bodyForce=gravity");
    EXPECT_EQ(changes(ask("gravity", effect*(1 + nextOrder))), "");
    scene_.models["bodyForce"] = "gravity";
    EXPECT_EQ(changes(ask("gravity", effect*(1 - nextOrder))), "");
    EXPECT_EQ(changes(ask("gravity", effect*(1 + nextOrder))), "bodyForce=none");
    // What has to fall, or slides, keeps it.
    scene_.bodies[0].gap = 2e-4;
    EXPECT_EQ(changes(ask("gravity", 0.9)), "");
    scene_.bodies[0].gap = 0;
    scene_.walls.front().plane->normal = normalized(Vector3(0.1, 0, 1));
    EXPECT_EQ(changes(ask("gravity", 0.9)), "");
    scene_.availableGravity = {};
    EXPECT_EQ(changes(ask("gravity", 0.9)), "no advice");
}

TEST_F(RuleTest, GravityOnAFreeBody)
{
    scene_.availableGravity = {0, 0, -10};
    scene_.walls.clear();
    const double fallen = 0.5*10*scene_.duration*scene_.duration/diameter();
    scene_.duration *= std::sqrt(0.1/fallen);        // a tenth of the diameter
    EXPECT_EQ(changes(ask("gravity", 0.1*(1 - close))), "bodyForce=gravity");
    EXPECT_EQ(changes(ask("gravity", 0.1*(1 + close))), "");
}

TEST_F(RuleTest, ViscosityInTheTimeOfTheRun)
{
    const double R = diameter()/2, effect = 1 - std::exp(-5*1e-6*scene_.duration/(R*R));
    scene_.models["viscosity"] = "laminar";
    EXPECT_EQ(changes(ask("viscosity", effect*(1 - close))), "");
    EXPECT_EQ(changes(ask("viscosity", effect*(1 + close))), "viscosity=none");
    scene_.models["viscosity"] = "none";
    const std::string newtonian = "viscosity=newtonian laplacePressureCoeffs/curvatureAt=start pressure/orderRemoved=1";
    EXPECT_EQ(changes(ask("viscosity", effect*(1 - close))), newtonian);
    EXPECT_EQ(changes(ask("viscosity", effect*(1 + close))), "");
    // XSPH is as thick as c (3/40) h^2/(2 dt).
    scene_.models["viscosity"] = "XSPH";
    const double smoothing = 0.2*3.0/40*4e-8/(2*2e-5);
    const double more = std::exp(-5*1e-6*scene_.duration/(R*R)) - std::exp(-5*smoothing*scene_.duration/(R*R));
    EXPECT_EQ(changes(ask("viscosity", more*(1 - close))), newtonian);
    EXPECT_EQ(changes(ask("viscosity", more*(1 + close))), "");
    scene_.viscosity = 10*smoothing;                    // of a thick liquid it takes too little
    EXPECT_EQ(changes(ask("viscosity", 1e-3)), newtonian);
    scene_.viscosity = smoothing;
    EXPECT_EQ(changes(ask("viscosity", 1e-3)), "");
    // With a share of a capillary step, sqrt(1e-9/(2 pi 0.07)) s = 4.768e-5 s, of which this step is 0.4194: 1 - 0.5^0.4194 = 0.2523.
    scene_.smoothingPerCapillaryStep = 0.5;
    EXPECT_NEAR(scene_.modelViscosity(), smoothing*0.2523/0.2, 1e-4*smoothing);
    scene_.smoothingPerCapillaryStep = 0.3;             // 0.139, less than c
    EXPECT_NEAR(scene_.modelViscosity(), smoothing, 1e-12);
    scene_.duration = 1e-6;
    EXPECT_EQ(changes(ask("viscosity", 1e-3)), "viscosity=none");
}

TEST_F(RuleTest, PlanesNeedNoParticles)
{
    scene_.walls = {{"floor", "particles", Plane{{0, 0, 0.5}, {0, 0, 1}}, {-1, -1, 0.5}, {1, 1, 0.5}, 60.0, true}};
    EXPECT_EQ(changes(ask("analyticWall", 0.0041)), "floor={ type plane; point (0 0 0.5); normal (0 0 1); }");
    EXPECT_EQ(changes(ask("analyticWall", 0.0039)), "");           // 0.004 is stored
    scene_.bodies[0].liquid.low = {-0.5, -0.5, 0.5};
    scene_.bodies[0].liquid.high = {1.1, 0.5, 1};
    EXPECT_TRUE(holds(ask("analyticWall", 0.05)->reason, {"beyond the edge of 'floor'"}));
    scene_.bodies[0].liquid.high.x = 0.9;
    EXPECT_NE(changes(ask("analyticWall", 0.05)), "");
    scene_.walls[0].evenTheta = false;
    EXPECT_TRUE(holds(ask("analyticWall", 0.05)->reason, {"not the same everywhere"}));
    scene_.walls[0].plane.reset();
    EXPECT_TRUE(holds(ask("analyticWall", 0.05)->reason, {"no plane"}));
    scene_.walls[0].type = "sphere";
    EXPECT_EQ(changes(ask("analyticWall", 0.05)), "no advice");
}

TEST_F(RuleTest, FormulationOfTheLeastError)
{
    EXPECT_EQ(changes(ask("formulation", 0.05)), "no advice");
    scene_.models["pressure"] = "pbf";
    scene_.models["surfaceTension"] = "Fujisawa2014";
    scene_.models["wetting"] = "contactAngle";
    const auto advice = ask("formulation", 0.05);   // 30 % against 10 % at 2000 particles
    EXPECT_EQ(changes(advice), "pressure=completedPbf surfaceTension=laplacePressure wetting=extendedSurface");
    EXPECT_TRUE(holds(advice->reason, {"the default " + percent(typical(60, 2000, 0.7)), "the case's models 30 %"}));
}

TEST_F(RuleTest, SpacingThatTheToleranceAsksFor)
{
    // In steps of 2 % of the particles, and the spacing has three digits, rounded down.
    const auto spacing = [&](double tolerance)
    {
        const std::string text = changes(ask("spacing", tolerance));
        return text.empty() ? 1e-4 : std::stod(text.substr(text.find('=') + 1));
    };
    const double ofFourThousand = typical(60, 4000, 0.7), ofCoarsest = typical(60, 1000, 0.7), finest = typical(60, 10000, 0.7);
    EXPECT_NEAR(spacing(ofFourThousand), 1e-4*std::cbrt(2000.0/4000), 0.0101e-4);
    EXPECT_LE(spacing(ofFourThousand), 1e-4*std::cbrt(2000.0/4000));
    EXPECT_NEAR(spacing(ofCoarsest*(1 + close)), 1e-4*std::cbrt(2000.0/1000), 0.0101e-4);     // never fewer than were run
    EXPECT_EQ(changes(ask("spacing", typical(60, 2000, 0.7))), "");                           // as it is
    EXPECT_TRUE(holds(ask("spacing", 0.9*finest)->reason,
        {"no stored study reaches the tolerance: " + percent(finest) + " with 10000"}));
    scene_.refillable = false;
    EXPECT_TRUE(holds(ask("spacing", ofFourThousand)->verdict, {"no system/fillLiquidDict fills it anew"}));
    EXPECT_EQ(changes(ask("spacing", ofFourThousand)), "");
}

TEST_F(RuleTest, SpacingTrustsNoLuck)
{
    scene_.walls.clear();                                                   // period of a free drop: 1 % coarse, 20 % fine
    EXPECT_EQ(changes(ask("spacing", 0.05)), "");
    EXPECT_TRUE(holds(ask("spacing", 0.05)->reason, {"no stored study reaches the tolerance"}));
}

TEST_F(RuleTest, StepThatIsCalmAndWithinTheTolerance)
{
    fill(10000);
    const double atLonger = typical(60, 10000, 2.8);
    ASSERT_GT(atLonger, typical(60, 10000, 0.7));
    EXPECT_EQ(changes(ask("timeStep", atLonger*(1 + close))), "maxCapillaryCo=2.8");
    EXPECT_EQ(changes(ask("timeStep", 0.5)), "maxCapillaryCo=2.8");         // 5 is not calm
    EXPECT_EQ(changes(ask("timeStep", atLonger*(1 - close))), "");
    scene_.maxCapillaryCo = 3.5;
    EXPECT_EQ(changes(ask("timeStep", atLonger*(1 - close))), "maxCapillaryCo=0.7");
    scene_.limit = "Courant";
    EXPECT_EQ(changes(ask("timeStep", 0.5)), "");
    scene_.models["surfaceTension"] = "none";
    EXPECT_EQ(changes(ask("timeStep", 0.5)), "no advice");
}

TEST_F(RuleTest, IterationsOfADropAtRest)
{
    fill(1000);
    const auto angle = [&](double most) { return mean(iterationRuns_, "sessile", 60, 1000, most); };
    const auto volume = [&](double n) { return mean(iterationRuns_, "volume", 0, n, 2); };
    ASSERT_GT(angle(2), angle(4));
    ASSERT_GT(angle(4), angle(8));
    EXPECT_EQ(changes(ask("iterations", std::max(angle(2), volume(1000))*(1 + close))), "pressure/maxIterations=2");
    EXPECT_EQ(changes(ask("iterations", angle(2)*(1 - close))), "pressure/maxIterations=4");
    EXPECT_EQ(changes(ask("iterations", angle(4)*(1 - close))), "");
    fill(2000);                                                     // more of the volume is lost with more particles
    ASSERT_GT(volume(2000), angle(2));
    EXPECT_EQ(changes(ask("iterations", volume(2000)*(1 + close))), "pressure/maxIterations=2");
    EXPECT_EQ(changes(ask("iterations", volume(2000)*(1 - close))), "pressure/maxIterations=4");
    fill(5000);
    EXPECT_TRUE(holds(ask("iterations", 0.031)->reason, {"no stored study tells of drops of 5000 particles"}));
    scene_.relaxation = 0.5;                                               // not that of the study
    EXPECT_EQ(changes(ask("iterations", 0.031)), "no advice");
    scene_.relaxation = 0.3;
    fill(1000, 1);
    ASSERT_GT(1000*diameter()/0.07, 0.1);
    EXPECT_EQ(changes(ask("iterations", 0.031)), "no advice");
}

// A column of 40 spacings that falls 0.05 m, U^2 = 2 g fall; eight iterations of a support of two spacings reach 16.
// Two drops of 1.2 mm radius on 60 degrees: stored studies tell of one. At four millimetres they stay apart; what moves them together
// within the time of the run does not.
TEST_F(RuleTest, DropsThatMayMeet)
{
    const auto place = [&](double x, double speed)
    {
        fill(2000);
        const double R = 0.5*diameter();
        scene_.bodies.front().liquid.low = {-R, -R, 0};
        scene_.bodies.front().liquid.high = {R, R, R};
        scene_.bodies.push_back(scene_.bodies.front());
        scene_.bodies.back().liquid.low.x += x;
        scene_.bodies.back().liquid.high.x += x;
        scene_.bodies.back().liquid.velocity.x = -speed;
    };
    const double c = 0.5, a = std::sin(pi/3)*std::cbrt(3*2000e-12/(pi*(2 + c)*(1 - c)*(1 - c))), near = 2*a + scene_.support*scene_.spacing;
    place(near*(1 + close), 0);
    EXPECT_FALSE(scene_.mayMeet());
    EXPECT_EQ(scene_.answer().scene, "sessile");
    place(near*(1 - close), 0);
    EXPECT_TRUE(scene_.mayMeet());
    EXPECT_EQ(scene_.answer().scene, "");
    EXPECT_EQ(changes(ask("iterations", 0.5)), "no advice");
    place(2*near, near/scene_.duration*(1 + close));
    EXPECT_TRUE(scene_.mayMeet());
    place(2*near, near/scene_.duration*(1 - close));
    EXPECT_FALSE(scene_.mayMeet());
    place(2*near, -near/scene_.duration);
    EXPECT_FALSE(scene_.mayMeet());
}

TEST_F(RuleTest, CoarseGridForDeepLiquid)
{
    scene_.gravity = {0, 0, -10};
    const double d = scene_.spacing, H = 40*d, U = std::sqrt(2*10*0.05);
    scene_.bodies[0].liquid.low = {0, 0, 0};
    scene_.bodies[0].liquid.high = {5*d, 5*d, H};
    scene_.bodies[0].impactSpeed = U;
    const double step = d*std::sqrt(0.1/(10*H + U*U));                     // throws it by 0.1 of a spacing
    scene_.subStep = step*(1 + close);
    EXPECT_EQ(changes(ask("deepLiquid", 0.05)), "pressure/coarseGrid=yes particleShifting=closePairs");
    scene_.models["particleShifting"] = "closePairs";
    EXPECT_EQ(changes(ask("deepLiquid", 0.05)), "pressure/coarseGrid=yes");
    EXPECT_TRUE(holds(ask("deepLiquid", 0.05)->reason, {"reach 16 of 40 spacings", "0.1 of one"}));
    scene_.coarseGrid = true;
    EXPECT_EQ(changes(ask("deepLiquid", 0.05)), "");
    scene_.subStep = step*(1 - close);
    EXPECT_EQ(changes(ask("deepLiquid", 0.05)), "pressure/coarseGrid=no particleShifting=none");
    scene_.coarseGrid = false;
    scene_.models["particleShifting"] = "none";
    EXPECT_EQ(changes(ask("deepLiquid", 0.05)), "");
    scene_.maxIterations = 20;                                             // which reach all of it
    EXPECT_EQ(changes(ask("deepLiquid", 0.05)), "no advice");
    scene_.maxIterations = 8;
    scene_.models["pressure"] = "DFSPH";                                   // has none
    EXPECT_EQ(changes(ask("deepLiquid", 0.05)), "no advice");
}

// A half sphere, of which pi (r^2 d - d^3/3) is within a spacing d: (2 - cos theta) 2^(2/3) = 4.391 on a wall of 140 degrees,
// where a free sphere has 4, times pi sigma R^2. The cap at rest: 3.949 (src/reference/CapOnWall.H).
TEST_F(RuleTest, StartThatMayJumpOff)
{
    EXPECT_EQ(changes(ask("start", 0.05)), "no advice");                 // it is not known to stand on anything
    const double V = scene_.bodies[0].liquid.volume, r = std::cbrt(3*V/(2*pi)), d = scene_.spacing;
    scene_.bodies[0].footing = Footing{0, pi*(r*r*d - d*d*d/3), d};
    scene_.models["viscosity"] = "laminar";
    const auto verdict = [&] { return ask("start", 0.05)->verdict; };
    scene_.walls[0].theta = 121;                                          // a half sphere's turn is at 121.3
    EXPECT_EQ(verdict(), "keep");
    EXPECT_EQ(scene_.answer().scene, "sessile");
    scene_.walls[0].theta = 122;
    EXPECT_TRUE(holds(verdict(), {"it may jump off the wall: start with a cap of 92 degrees"}));

    scene_.walls[0].theta = 140;
    const double enough = std::sqrt(0.07*diameter()/2/1000);               // Oh = 1
    scene_.viscosity = enough*(1 - close);
    EXPECT_TRUE(holds(verdict(), {"start with a cap of ", "or with a viscosity of " + number(enough) + " m2/s"}));
    EXPECT_TRUE(holds(ask("start", 0.05)->reason, {"'floor' of 140 degrees as a cap of 90 would", "1.1 times", "rest has 0.987"}));
    scene_.viscosity = enough*(1 + close);
    EXPECT_EQ(verdict(), "keep: too thick or heavy to jump off");
    EXPECT_TRUE(scene_.answer().scene.empty());
    EXPECT_FALSE(scene_.error());                                         // no stored run starts so, thick or not
    EXPECT_TRUE(holds(scene_.answer().text, {"the energy to leave its wall"}));
    // XSPH has c (3/40) h^2/(2 dt) in place of it.
    scene_.models["viscosity"] = "XSPH";
    scene_.smoothing = enough*(1 - close)/(3.0/40*4e-8/(2*2e-5));
    EXPECT_TRUE(holds(verdict(), {"may jump off"}));
    scene_.smoothing *= (1 + close)/(1 - close);
    EXPECT_EQ(verdict(), "keep: too thick or heavy to jump off");
    scene_.models["viscosity"] = "none";
    EXPECT_TRUE(holds(verdict(), {"may jump off"}));

    scene_.spacing *= 2;                                                  // as a rule before it may advise: the start stays
    EXPECT_TRUE(holds(ask("start", 0.05)->reason, {"as a cap of 90 would"}));
    scene_.gravity = {0, 0, 10};                                          // hanging
    EXPECT_EQ(changes(ask("start", 0.05)), "no advice");
    scene_.gravity = {};
    scene_.walls[0].evenTheta = false;
    EXPECT_EQ(changes(ask("start", 0.05)), "no advice");
}

TEST_F(RuleTest, ErrorOfNineRunsInTen)
{
    EXPECT_FALSE(scene_.likelyError());                                   // too few stored runs to tell
    const StoredStudies many = inPairs(15, 3);
    scene_.studies = &many;
    fill(1024);
    const double typical = 0.01*std::pow((1 + std::pow(3, 1.5))/2, 1/1.5);          // of a pair, 1 and 3 %
    EXPECT_NEAR(scene_.error()->value, typical, 1e-9);
    EXPECT_NEAR(*scene_.likelyError(), 3*typical, 1e-9);
    fill(1000);
    EXPECT_FALSE(scene_.likelyError());                                   // beyond the runs
}

// sqrt(d/g) is 1e-2 s.
TEST_F(RuleTest, StepsOfAFrontAreOfWeight)
{
    scene_.gravity = {0, 0, -1};
    scene_.subStep = 1e-3;
    EXPECT_NEAR(scene_.relativeStep(2000, 0.7), 0.7, close);
    scene_.models["surfaceTension"] = "none";
    EXPECT_NEAR(scene_.relativeStep(2000, 0.7), 0.1, close);
    EXPECT_NEAR(scene_.relativeStep(16*2000, 0.7), 0.1*std::cbrt(4), close);      // of the spacing's root
    EXPECT_NEAR(scene_.error()->value, mean(runs_, "damBreak", 0, 2000, 0.1), close);
    scene_.subStep = 3e-3;
    EXPECT_FALSE(scene_.error());                                         // a longer one than was run
    EXPECT_EQ(changes(ask("spacing", 0.5)), "");
    // With tension, which is not felt in a vessel from Bo = rho g D^2/sigma = 1/tolerance on.
    const double bond = 1000*std::pow(diameter(), 2)/0.07;
    scene_.models["surfaceTension"] = "laplacePressure";
    scene_.tolerance = (1 + close)/bond;
    EXPECT_NE(scene_.answer().scene, "damBreak");
    scene_.walls.push_back({"tank", "box", {}, {}, {}, {}});
    EXPECT_EQ(scene_.answer().scene, "damBreak");
    scene_.tolerance = (1 - close)/bond;
    EXPECT_NE(scene_.answer().scene, "damBreak");
}

TEST_F(RuleTest, LaterRulesSeeWhatEarlierOnesChanged)
{
    // Coarse first; then the step has nothing left of the tolerance.
    std::string text;
    scene_.tolerance = typical(60, 2000, 0.7);          // 10 %
    for (const Advice& advice : adviseOn(scene_))
    {
        if (!advice.changes.empty()) text += advice.rule + " ";
    }
    EXPECT_EQ(text, "viscosity iterations ");
    scene_.tolerance = typical(60, 1000, 0.7)*(1 + close);
    scene_.maxIterations = 8;
    text = "";
    for (const Advice& advice : adviseOn(scene_)) text += advice.changes.empty() ? "" : advice.rule + " ";
    EXPECT_EQ(text, "spacing iterations ");
    EXPECT_NEAR(scene_.particles(scene_.bodies[0]), 1000, 30);             // the spacing's three digits
}

}

}
