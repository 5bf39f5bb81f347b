# SPDX-License-Identifier: GPL-3.0-or-later
# Paths below src/.
set(SHIZUKU_ADVICE_SOURCES
    advice/CaseEdits.C
    advice/Numbers.C
    advice/ReadScene.C
    advice/Rule.C
    advice/Scene.C
    advice/StoredStudies.C
    advice/TimedCall.C
    advice/TrialCase.C
    advice/rules/AnalyticWall.C
    advice/rules/DeepLiquid.C
    advice/rules/Formulation.C
    advice/rules/Gravity.C
    advice/rules/Iterations.C
    advice/rules/Spacing.C
    advice/rules/Start.C
    advice/rules/Tension.C
    advice/rules/TimeStep.C
    advice/rules/Viscosity.C
    advice/rules/KnownFaults.C
)
