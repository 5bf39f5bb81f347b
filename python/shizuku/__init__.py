# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads, edits and runs cases of Shizuku.

    case = shizuku.Case("run/sessileDrop")
    case.set("constant/wettability", "floor.theta", 90)
    case.run()
    angle = case.table("probeAngle", "angle.csv")["angle"][-1]
    positions = case.field("liquid/positions")

Values are SI, as in the files (doc/guide/output.md).
"""

from .case import Case, CaseError, sweep
from .fields import Field, read_field, write_field
from .meshes import Mesh, read_ply
from .tables import Table, read_table

__all__ = ["Case", "CaseError", "Field", "Mesh", "Table", "read_field", "read_ply", "read_table", "sweep", "write_field"]
