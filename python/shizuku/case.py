# SPDX-License-Identifier: GPL-3.0-or-later
"""A case: its dictionaries, by caseDictionary; its runs; what they left. The programs have to be on the PATH (source etc/bashrc)."""

import json
import shutil
import subprocess
from pathlib import Path

from .fields import read_field
from .meshes import read_ply
from .tables import read_table


class CaseError(RuntimeError):
    """A program failed. Its message ends with what the program said."""


def _call(command, folder):
    try:
        return subprocess.run(command, cwd=folder, check=True, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE).stdout
    except FileNotFoundError:
        raise CaseError(f"{command[0]} is not there; source etc/bashrc of Shizuku before Python starts") from None
    except subprocess.CalledProcessError as error:
        raise CaseError(f"{' '.join(map(str, command))} failed:\n{error.stdout[-2000:]}{error.stderr[-2000:]}") from None


def _number(name):
    try:
        return float(name)
    except ValueError:
        return None


class Case:
    def __init__(self, path):
        self.path = Path(path).resolve()
        if not (self.path / "system" / "controlDict").is_file():
            raise CaseError(f"{self.path} is no case: system/controlDict is not there")

    def clone(self, path):
        """A copy of what defines the case, in a folder that is not there yet."""
        path = Path(path)
        path.mkdir(parents=True)
        for name in ("system", "constant"):
            shutil.copytree(self.path / name, path / name, ignore=shutil.ignore_patterns("solid"))
        for script in self.path.glob("All*"):
            shutil.copy2(script, path)
        return Case(path)

    def get(self, dictionary, entry):
        """An entry's value, with macros expanded: a dict of a dictionary, else a number or text."""
        return json.loads(_call(["caseDictionary", dictionary, "-entry", entry, "-json"], self.path))

    def set(self, dictionary, entry, value):
        """Gives an entry, which is there, a new value: case.set("constant/wettability", "floor.theta", 90)."""
        _call(["caseDictionary", dictionary, "-entry", entry, "-set", str(value)], self.path)

    def add(self, dictionary, entry, value):
        _call(["caseDictionary", dictionary, "-entry", entry, "-add", str(value)], self.path)

    def run(self, *options):
        """./Allrun with these options. Its output."""
        return _call(["./Allrun", *map(str, options)], self.path)

    def clean(self):
        _call(["./Allclean"], self.path)

    def times(self):
        """The names of time folders, in the order of time."""
        names = [folder.name for folder in self.path.iterdir() if folder.is_dir() and _number(folder.name) is not None]
        return sorted(names, key=float)

    def _time(self, time):
        times = self.times()
        if not times:
            raise CaseError(f"{self.path} has no times: it has not been run")
        if time is None:
            return times[-1]
        if str(time) in times:
            return str(time)
        nearest = min(times, key=lambda name: abs(float(name) - float(time)))
        if abs(float(nearest) - float(time)) > 1e-9 * max(1e-3, abs(float(time))):
            raise CaseError(f"{self.path} has no time {time}; the nearest is {nearest}")
        return nearest

    def field(self, name, time=None):
        """Values of "liquid/positions", "liquid/U", ..., of the latest time where none is given."""
        return read_field(self.path / self._time(time) / name).values

    def mesh(self, time=None):
        return read_ply(self.path / self._time(time) / "surface" / "liquid.ply")

    def table(self, name, file):
        """The latest of postProcessing/<name>/<start time>/<file>."""
        folder = self.path / "postProcessing" / name
        starts = [start for start in folder.glob("*") if _number(start.name) is not None and (start / file).is_file()]
        if not starts:
            raise CaseError(f"{folder} has no {file}")
        return read_table(max(starts, key=lambda start: float(start.name)) / file)


def sweep(base, folder, dictionary, entry, values, *options):
    """Runs clones of a case, folder/<value>, each with another value of an entry. A list of (value, Case); clones that are there are not run again."""
    runs = []
    for value in values:
        path = Path(folder) / str(value)
        if path.is_dir():
            runs.append((value, Case(path)))
            continue
        case = Case(base).clone(path.with_name(path.name + ".part"))
        case.set(dictionary, entry, value)
        case.run(*options)
        case.path.rename(path)
        runs.append((value, Case(path)))
    return runs
