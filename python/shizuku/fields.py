# SPDX-License-Identifier: GPL-3.0-or-later
"""Particle fields: OpenFOAM's syntax, text or binary."""

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

_CLASSES = {"scalarField": 1, "vectorField": 3, "labelField": 1}
_COMMENT = re.compile(rb"/\*.*?\*/|//[^\n]*", re.S)


@dataclass
class Field:
    """values: (n,) of scalars and labels, (n, 3) of vectors. uniform: one value stands for all particles."""

    values: np.ndarray
    dimensions: tuple = (0, 0, 0, 0, 0, 0, 0)
    uniform: bool = False
    meta: dict = field(default_factory=dict)


def _fail(path, found, expected):
    raise ValueError(f"{path}: {found}; expected: {expected}")


def _header(path, data):
    """The entries of FoamFile, and where it ends."""
    match = re.match(rb"\s*FoamFile\s*\{", _COMMENT.sub(lambda comment: b" " * len(comment.group()), data[:4096]))
    if not match:
        _fail(path, "no header", "FoamFile { ... }")
    depth, end = 1, match.end()
    while depth and end < len(data):
        depth += {b"{": 1, b"}": -1}.get(data[end : end + 1], 0)
        end += 1
    if depth:
        _fail(path, "the header does not end", "a closing }")
    text = _COMMENT.sub(b" ", data[match.end() : end - 1]).decode()
    meta = re.search(r"\bmeta\s*\{([^}]*)\}", text)
    plain = re.findall(r'(\w+)\s+("[^"]*"|[^";{}]*);', re.sub(r"\bmeta\s*\{[^}]*\}", "", text))
    entries = {key: value.strip().strip('"') for key, value in plain}
    entries["meta"] = dict(re.findall(r"(\w+)\s+([^;]*);", meta.group(1))) if meta else {}
    return entries, end


def _dtype(path, entries, label):
    arch = entries.get("arch", "LSB;label=32;scalar=32")
    order = ">" if arch.startswith("MSB") else "<"
    bits = re.search(r"label=(\d+)" if label else r"scalar=(\d+)", arch)
    if not bits or bits.group(1) not in ("32", "64"):
        _fail(path, f'arch "{arch}"', "LSB;label=32;scalar=32, or 64")
    return np.dtype(f"{order}{'i' if label else 'f'}{int(bits.group(1)) // 8}")


def read_field(path):
    """The Field of a file. ValueError where it is none: with what was found and what was expected."""
    path = Path(path)
    data = path.read_bytes()
    entries, at = _header(path, data)
    kind = entries.get("class", "")
    if kind not in _CLASSES:
        _fail(path, f"class '{kind}'", ", ".join(_CLASSES))
    components, label = _CLASSES[kind], kind == "labelField"

    head = re.compile(rb"\s*(?:dimensions\s*\[([^\]]*)\]\s*;)?\s*internalField\s+(uniform|nonuniform)\s*", re.S)
    blanked = data[:at] + _COMMENT.sub(lambda comment: b" " * len(comment.group()), data[at : at + 1024]) + data[at + 1024 :]
    match = head.match(blanked, at)
    if not match:
        _fail(path, "no internalField behind the header", "dimensions [...]; internalField uniform | nonuniform")
    dimensions = tuple(float(number) for number in (match.group(1) or b"0 0 0 0 0 0 0").split())
    number = int if label else float

    if match.group(2) == b"uniform":
        text = data[match.end() : data.find(b";", match.end())]
        values = np.array([number(word) for word in text.replace(b"(", b" ").replace(b")", b" ").split()])
        if values.size != components:
            _fail(path, f"{values.size} numbers", f"{components} of a {kind}")
        return Field(values.reshape(1, 3) if components == 3 else values, dimensions, True, entries["meta"])

    size = re.compile(rb"(?:List<\w+>)?\s*(\d+)\s*\(").match(blanked, match.end())
    if not size:
        _fail(path, "no list", "List<...> N ( ... )")
    count = int(size.group(1)) * components
    if entries.get("format") == "binary":
        dtype = _dtype(path, entries, label)
        end = size.end() + count * dtype.itemsize
        if data[end : end + 1] != b")":
            _fail(path, "the list has another length", f"{count} numbers of {dtype.itemsize} bytes, and )")
        values = np.frombuffer(data, dtype, count, size.end()).astype(dtype.newbyteorder("="))
    else:
        body = _COMMENT.sub(b" ", data[size.end() :]).rstrip().removesuffix(b";").rstrip().removesuffix(b")")
        words = body.replace(b"(", b" ").replace(b")", b" ").split()
        if len(words) != count:
            _fail(path, f"{len(words)} numbers", f"{count}")
        values = np.array([number(word) for word in words], dtype=np.int32 if label else float)
    return Field(values.reshape(-1, 3) if components == 3 else values, dimensions, False, entries["meta"])


def write_field(path, values, dimensions, meta=None):
    """Writes a field as text, with as many digits as keep every bit."""
    path, values = Path(path), np.asarray(values)
    label, vector = values.dtype.kind in "iu", values.ndim == 2
    if vector and values.shape[1] != 3:
        _fail(path, f"values of shape {values.shape}", "(n,) or (n, 3)")
    if not np.isfinite(values).all():
        _fail(path, f"the value of element {int(np.argwhere(~np.isfinite(values))[0][0])} is no finite number", "finite numbers")
    kind = "label" if label else "vector" if vector else "scalar"
    rows = (f"({' '.join(map(repr, map(float, row)))})" for row in values) if vector else (
        str(int(value)) if label else repr(float(value)) for value in values
    )
    extra = "".join(f"{key} {value};" for key, value in (meta or {}).items())
    text = (
        "FoamFile\n{\n    version     2.0;\n    format      ascii;\n"
        f"    class       {kind}Field;\n    location    \"{path.parent.parent.name}/{path.parent.name}\";\n    object      {path.name};\n"
        + (f"    meta        {{ {extra} }}\n" if extra else "")
        + f"}}\n\ndimensions      [{' '.join(f'{power:g}' for power in dimensions)}];\n"
        f"internalField   nonuniform List<{kind}> {len(values)}\n(\n" + "".join(row + "\n" for row in rows) + ");\n"
    )
    whole = path.with_name(path.name + ".part")
    whole.write_text(text)
    whole.replace(path)
