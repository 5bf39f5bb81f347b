# SPDX-License-Identifier: GPL-3.0-or-later
"""What pip calls to make a wheel of the package (PEP 517). It needs nothing but Python, so pip asks no server for build tools."""

import base64
import hashlib
import re
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent


def _entry(key):
    return re.search(rf'^{key} = "(.*)"', (HERE / "pyproject.toml").read_text(), re.MULTILINE).group(1)


def _metadata():
    lines = ["Metadata-Version: 2.1", f"Name: {_entry('name')}", f"Version: {_entry('version')}", f"Summary: {_entry('description')}",
             f"Requires-Python: {_entry('requires-python')}", "License: GPL-3.0-or-later", "Requires-Dist: numpy"]
    return "\n".join(lines) + "\n"


def get_requires_for_build_wheel(config_settings=None):
    return []


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name, version = _entry("name"), _entry("version")
    info = f"{name}-{version}.dist-info"
    files = {f"{name}/{path.name}": path.read_bytes() for path in sorted((HERE / name).glob("*.py"))}
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = b"Wheel-Version: 1.0\nGenerator: shizuku\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
    record = ""
    for path, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{path},sha256={digest},{len(data)}\n"
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    wheel = f"{name}-{version}-py3-none-any.whl"
    with zipfile.ZipFile(Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, data in files.items():
            archive.writestr(path, data)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    raise NotImplementedError("Install from the folder: pip install ./python")
