# Tests that run on a device, once per backend. Paths below tests/unit/.
set(SHIZUKU_DEVICE_TESTS
    device/TestAlgorithms.C
    device/TestBuffer.C
    device/TestForEach.C
    device/TestReduce.C
    maths/TestKernel.C
    neighbours/TestNeighbourList.C
    particles/TestFieldRegistry.C
    particles/TestParticleFiles.C
    particles/TestUnits.C
    surface/TestLiquidSurface.C
    surface/TestMarchingCubesTable.C
    walls/TestHalfSpace.C
    walls/TestWallSurface.C
    walls/TestWallView.C
    walls/TestWalls.C
)
# What they share, with their main. Paths below tests/.
set(SHIZUKU_DEVICE_TEST_SUPPORT
    support/DeviceMain.C
    support/LiquidCase.C
)
