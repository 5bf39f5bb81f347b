# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables: CSV with a line of names, each with its unit in brackets."""

import csv
import re
from pathlib import Path

import numpy as np


class Table:
    """table["angle"]: a column, of numbers where all are, else of words. table.units["angle"]: its unit, "" where it has none."""

    def __init__(self, names, units, columns):
        self.names = names
        self.units = dict(zip(names, units))
        self._columns = dict(zip(names, columns))

    def __getitem__(self, name):
        if name not in self._columns:
            raise KeyError(f"there is no column '{name}'; valid: {', '.join(self.names)}")
        return self._columns[name]

    def __len__(self):
        return len(self._columns[self.names[0]])

    def where(self, **values):
        """The rows in which each of these columns has this value: table.where(drop=1)."""
        chosen = np.ones(len(self), bool)
        for name, value in values.items():
            chosen &= self[name] == value
        return Table(self.names, [self.units[name] for name in self.names], [self[name][chosen] for name in self.names])


def _column(words):
    try:
        return np.array([float(word) for word in words])
    except ValueError:
        return np.array(words)


def read_table(path):
    """The Table of a CSV file. ValueError where a row has more or fewer values than there are names."""
    path = Path(path)
    with path.open(newline="") as file:
        rows = [row for row in csv.reader(file) if row]
    if not rows:
        raise ValueError(f"{path}: empty; expected: a line of names")
    heads = [re.fullmatch(r"\s*(.*?)\s*(?:\[(.*)\])?\s*", name) for name in rows[0]]
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(heads):
            raise ValueError(f"{path}, row {number}: {len(row)} values; expected: {len(heads)}")
    columns = [_column([row[k] for row in rows[1:]]) for k in range(len(heads))]
    return Table([head.group(1) for head in heads], [head.group(2) or "" for head in heads], columns)
