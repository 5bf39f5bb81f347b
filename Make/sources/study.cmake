# SPDX-License-Identifier: GPL-3.0-or-later
# Paths below src/.
set(SHIZUKU_CASE_RUNS_SOURCES
    caseRuns/CaseRecord.C
    caseRuns/CaseRuns.C
    caseRuns/MultiProcessService.C
    caseRuns/Places.C
    caseRuns/RunningCase.C
)

set(SHIZUKU_STUDY_SOURCES
    study/ComparisonRows.C
    study/ErrorMeasure.C
    study/Gnuplot.C
    study/ParetoFront.C
    study/RunCost.C
    study/RunOrigin.C
    study/RunReason.C
    study/SolverLog.C
    study/Stability.C
    study/Study.C
    study/StudyCase.C
    study/StudyEngine.C
    study/StudyOptions.C
)
