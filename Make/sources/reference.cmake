# SPDX-License-Identifier: GPL-3.0-or-later
# Paths below src/.
set(SHIZUKU_REFERENCE_SOURCES
    maths/LinearSolve.C
    reference/BashforthAdams.C
    reference/CapOnWall.C
    reference/CapillaryRise.C
    reference/CapillaryWave.C
    reference/DropImpact.C
    reference/DropOscillation.C
    reference/FlowNumbers.C
    reference/MovingContactLine.C
    reference/Spreading.C
    reference/TubeMeniscus.C
    reference/ViscousDrop.C
    reference/PlateFlow.C
    reference/LiquidBridge.C
    reference/SphereInBath.C
)
