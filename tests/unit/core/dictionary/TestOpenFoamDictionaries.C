// SPDX-License-Identifier: GPL-3.0-or-later
// The constructs of OpenFOAM's tutorials, each dictionary in the manner of its kind.

#include "core/dictionary/Dictionary.H"

#include <gtest/gtest.h>

using namespace shizuku;
using Vector = std::array<double, 3>;

TEST(OpenFoam, FvSolution)
{
    const Dictionary dict = Dictionary::parse(R"dict(
solvers
{
    "alpha.liquid.*"
    {
        nAlphaCorr  1;
        MULESCorr   yes;
        tolerance   1e-8;
    }
    p_rgh
    {
        solver          GAMG;
        preconditioner { type DIC; sweeps 2; }
        relTol          0.05;
    }
    p_rghFinal
    {
        $p_rgh;
        relTol      0;
    }
    "(U|k|omega)Final" { $p_rghFinal; tolerance 1e-6; }
}
relaxationFactors { equations { ".*" 1; } }
)dict");
    EXPECT_TRUE(dict.subDict("solvers").subDict("alpha.liquid").lookup<bool>("MULESCorr"));
    const Dictionary final = dict.subDict("solvers").subDict("kFinal");
    EXPECT_EQ(final.lookup<double>("relTol"), 0);
    EXPECT_EQ(final.subDict("preconditioner").lookup<int>("sweeps"), 2);
    EXPECT_EQ(dict.subDict("relaxationFactors").subDict("equations").lookup<double>("U"), 1);
}

TEST(OpenFoam, FvSchemes)
{
    const Dictionary dict = Dictionary::parse(R"dict(
gradSchemes { default cellLimited Gauss linear 1; }
divSchemes
{
    div(rhoPhi,U)   Gauss linearUpwind grad(U);
    div(phirb,alpha) Gauss linear;
    "div\(phi,(k|epsilon)\)" bounded Gauss upwind;
    div(((rho*nuEff)*dev2(T(grad(U))))) Gauss linear;
}
)dict");
    EXPECT_EQ(dict.subDict("divSchemes").keys().size(), 4u);
    EXPECT_TRUE(dict.subDict("divSchemes").found("div(phi,k)"));
    EXPECT_FALSE(dict.subDict("divSchemes").found("div(phi,U)"));
}

TEST(OpenFoam, ValuesThatEndWithADictionary)
{
    const std::string text = "div(phi,Y) Gauss multi\n{\n    CO limited 1;\n    h upwind;\n};\ndiv(U) Gauss linear;\n";
    const Dictionary schemes = Dictionary::parse(text);
    EXPECT_EQ(schemes.keys(), (std::vector<std::string>{"div(phi,Y)", "div(U)"}));
}

TEST(OpenFoam, BlockMeshDict)
{
    const Dictionary dict = Dictionary::parse(R"dict(
scale 0.146;
n 8; l 1; ml -1; // sizes
geometry { ball { type sphere; origin (0 0 0); radius 1; } }
vertices
(
    ($ml $ml 0) ($l $ml 0) (#calc "2*$l" #eval{ sqrt($l) } 0.5)     // three of them
    project (-1 0 1) (ball)
    name top (0 1 1)
);
blocks
(
    hex (0 1 2 3 4 5 6 7) ($n $n 1) simpleGrading (1 ((0.5 0.5 2) (0.5 0.5 0.5)) 1)
    name side hex (v0 v1 v2 v3 v4 v5 v6 v7) solid (8 8 8) edgeGrading (1 1 1 1 1 1 1 1 1 1 1 1)
);
edges ( arc 0 1 (0 $ml 0.3) spline 1 2 ((0 0 0) (1 1 1)) );
boundary
(
    leftWall
    {
        type wall;
        faces ((0 12 16 4)(4 16 20 8));
    }
    none { type patch; faces (); }
);
mergePatchPairs ();
)dict");
    EXPECT_EQ(dict.keys().size(), 10u);
    EXPECT_EQ(dict.lookup<double>("scale"), 0.146);
}

TEST(OpenFoam, SnappyHexMeshDict)
{
    const Dictionary dict = Dictionary::parse(R"dict(
castellatedMesh true;
geometry
{
    motor.stl { type triSurfaceMesh; name motor; regions { secondSolid { name mySecondPatch; } } }
    box { type searchableBox; min (-1.0 -0.7 0.0); max ( 8.0  0.7 2.5); }
};
castellatedMeshControls
{
    features ( { file "motor.eMesh"; level 0; } /* { file "other"; } */ );
    refinementSurfaces { motor { level (5 6); } "iglo.*" { level (1 1); } }
    refinementRegions { box { mode inside; levels ((1E15 4)); } }
    locationInMesh (3.0001 3.0001 0.43);
}
addLayersControls { layers { "(lower|upper)Wall|motor.*" { nSurfaceLayers 1; } } }
)dict");
    EXPECT_TRUE(dict.lookup<bool>("castellatedMesh"));
    const Dictionary controls = dict.subDict("castellatedMeshControls");
    const Dictionary motor = controls.subDict("refinementSurfaces").subDict("motor");
    EXPECT_EQ(motor.lookup<std::vector<int>>("level"), (std::vector<int>{5, 6}));
    EXPECT_EQ(controls.lookup<Vector>("locationInMesh"), (Vector{3.0001, 3.0001, 0.43}));
    const Dictionary layers = dict.subDict("addLayersControls").subDict("layers");
    EXPECT_TRUE(layers.isDict("upperWall") && layers.isDict("motor_1") && !layers.isDict("inlet"));
}

TEST(OpenFoam, Fields)
{
    const Dictionary dict = Dictionary::parse(R"dict(
FoamFile { version 2.0; format ascii; arch "LSB;label=32;scalar=64";
    class volVectorField; location "0/liquid"; object U; }
dimensions      [ 0 1 -1 0 0 0 0 ];
Uinlet          ( 0.1 0 0 );
internalField   uniform $Uinlet;
boundaryField
{
    inlet { type fixedValue; value $internalField; }
    outlet { type inletOutlet; inletValue uniform (0 0 0); value $inletValue; }
    "side.*" { type codedFixedValue; code #{ operator==(vector(0, 0, 1)); #}; }
    sets { value nonuniform List<scalar> 2(0.5 0.25); }
    ramp { type uniformFixedValue; uniformValue table ((0 (0 0 0)) (1 (1 0 0))); }
}
)dict");
    EXPECT_EQ(dict.lookupDimensions("dimensions"), dimensions::velocity);
    const Dictionary boundary = dict.subDict("boundaryField");
    EXPECT_EQ(boundary.subDict("sets").lookup<std::vector<double>>("value"), (std::vector<double>{0.5, 0.25}));
    EXPECT_EQ(boundary.subDict("side1").lookup<std::string>("code"), " operator==(vector(0, 0, 1)); ");
}

TEST(OpenFoam, PropertiesAndSets)
{
    const Dictionary dict = Dictionary::parse(R"dict(
phases (water air);
water { transportModel Newtonian; nu [0 2 -1 0 0 0 0] 1e-06; rho rho [1 -3 0 0 0 0 0] 1000; }
sigma           sigma [1 0 -2 0 0 0 0] 0.07;
defaultFieldValues ( volScalarFieldValue alpha.water 0 );
regions
(
    boxToCell
    {
        box (0 0 -1) (0.1461 0.292 1);
        fieldValues ( volScalarFieldValue alpha.water 1 );
    }
);
libs            ("libA.so" "libB.so");
functions { probes1 { type probes; libs (sampling); probeLocations ((0 0 0) (1e-3 0 0)); fields (p U alpha.water); } }
)dict");
    EXPECT_EQ(dict.lookup<std::vector<std::string>>("phases"), (std::vector<std::string>{"water", "air"}));
    EXPECT_EQ(dict.subDict("water").lookupDimensioned("nu", dimensions::kinematicViscosity), 1e-6);
    EXPECT_EQ(dict.subDict("water").lookupDimensioned("rho", dimensions::density), 1000);
    EXPECT_EQ(dict.lookupDimensioned("sigma", dimensions::surfaceTension), 0.07);
    EXPECT_EQ(dict.lookup<std::vector<std::string>>("libs"), (std::vector<std::string>{"libA.so", "libB.so"}));
    EXPECT_EQ(dict.subDict("functions").subDict("probes1").lookup<std::vector<Vector>>("probeLocations")[1][0], 1e-3);
}
