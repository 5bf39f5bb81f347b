#include "functionObjects/FunctionObjects.H"

#include "support/ScratchFolder.H"

using namespace shizuku;
using namespace shizuku::test;

TEST(@class@, WritesHowFarTheCentroidMoved)
{
    const ScratchFolder folder;
    folder.write("0/liquid/positions", "");
    folder.write("system/controlDict",
                 "endTime 1; deltaT 0.25; writeInterval 1; functions { drift { type @word@; } }");
    Time time(folder.path());
    FunctionObjects functions(time, true);
    for (const auto& centroid : {std::array{1.0, 0.0, 0.0}, std::array{1.0, 3.0, 4.0}})
    {
        time.advance();
        LiquidState state;
        state.centroid = centroid;
        functions.execute(state);
    }
    functions.write();
    EXPECT_EQ(folder.read("postProcessing/drift/0/@word@.csv"), "time [s],distance [m]\n0.25,0\n0.5,5\n");
}
