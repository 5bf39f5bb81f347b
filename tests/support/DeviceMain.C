// SPDX-License-Identifier: GPL-3.0-or-later
// The main of tests that run on a device. Without a GPU the CUDA tests are skipped, never passed: the exit status says
// so to CTest. Where the driver lists a GPU that does not open, they fail.

#include "core/messages/Error.H"
#include "device/Device.H"

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv)
{
    constexpr int skipped = 77;     // SKIP_RETURN_CODE of Make/modules/Backend.cmake
    testing::InitGoogleTest(&argc, argv);
    try
    {
        const auto device = shizuku::openDevice();
        std::cout << "Device : " << device.backend << ", " << device.name << std::endl;
    }
    catch (const shizuku::FatalError& error)
    {
        std::cerr << error.what() << std::endl;
        const bool listed = std::system("nvidia-smi -L 2>/dev/null | grep -q '^GPU'") == 0;
        return listed ? EXIT_FAILURE : skipped;
    }
    return RUN_ALL_TESTS();
}
