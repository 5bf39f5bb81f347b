// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel/Launcher.H"

#include <charconv>
#include <cstdlib>
#include <cstring>

namespace shizuku
{

namespace
{

struct Variable
{
    const char* name;
    bool isNumber;          // of this process, from 0 on; else how many there are
};

constexpr const char* mpirun = "OMPI_COMM_WORLD_SIZE";

// PMI: MPICH, Intel MPI, Cray. SLURM_STEP_: srun; SLURM_NTASKS: the job, which its script sees too. PALS, ALPS: Cray. JSM: jsrun.
constexpr Variable variables[] =
{
    {"PMI_SIZE", false}, {"MV2_COMM_WORLD_SIZE", false}, {"MPI_LOCALNRANKS", false}, {"SLURM_STEP_NUM_TASKS", false}, {"SLURM_NTASKS", false},
    {"SLURM_NPROCS", false}, {"FLUX_JOB_SIZE", false}, {"PALS_LOCAL_SIZE", false}, {"JSM_NAMESPACE_SIZE", false},
    {"PMI_RANK", true}, {"PMIX_RANK", true}, {"SLURM_PROCID", true}, {"FLUX_TASK_RANK", true}, {"PALS_RANKID", true}, {"ALPS_APP_PE", true},
    {"JSM_NAMESPACE_RANK", true}
};

std::optional<int> valueOf(const char* name)
{
    const char* const text = std::getenv(name);
    if (!text) return std::nullopt;
    int value = 0;
    const char* const end = text + std::strlen(text);
    const auto [last, error] = std::from_chars(text, end, value);
    if (error != std::errc() || last != end || value < 0) return std::nullopt;
    return value;
}

}

std::optional<Launch> launchOf()
{
    if (const auto size = valueOf(mpirun)) return Launch{mpirun, *size, true};
    std::optional<Launch> launch;
    for (const Variable& variable : variables)
    {
        const auto value = valueOf(variable.name);
        if (!value) continue;
        const int processes = *value + (variable.isNumber ? 1 : 0);
        if (!launch || processes > launch->processes) launch = {variable.name, processes, false};
    }
    return launch;
}

}
