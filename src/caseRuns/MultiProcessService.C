// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseRuns/MultiProcessService.H"

#include "core/messages/Error.H"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

namespace shizuku
{

namespace
{

constexpr const char* pipes = "CUDA_MPS_PIPE_DIRECTORY";
constexpr const char* logs = "CUDA_MPS_LOG_DIRECTORY";

}

MultiProcessService::MultiProcessService()
{
    std::string name = (std::filesystem::temp_directory_path()/"shizukuMps-XXXXXX").string();
    if (!mkdtemp(name.data())) throw FatalError("Cannot make the folder " + name + ": " + std::strerror(errno));
    folder_ = name;
    setenv(pipes, name.c_str(), 1);
    setenv(logs, name.c_str(), 1);
    // It serves all GPUs: which one a case gets, the case's own CUDA_VISIBLE_DEVICES says.
    if (std::system("env -u CUDA_VISIBLE_DEVICES nvidia-cuda-mps-control -d >/dev/null 2>&1") == 0) return;
    leave();
    throw FatalInputError
    (
        {}, "Option -mps is given, but NVIDIA's multi-process service does not start",
        "nvidia-cuda-mps-control of the driver, which starts as a daemon; or no -mps"
    );
}

MultiProcessService::~MultiProcessService()
{
    [[maybe_unused]] const int status = std::system("echo quit | nvidia-cuda-mps-control >/dev/null 2>&1");
    leave();
}

void MultiProcessService::leave()
{
    unsetenv(pipes);
    unsetenv(logs);
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

}
