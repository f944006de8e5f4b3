#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Packs what `cmake --install` puts into place as a wheel for the Python that the build was made for.

    cmake/make_wheel.py BUILD FOLDER

Writes FOLDER/polargrain-VERSION-TAGS.whl and prints its path. The Python package lies at the root of the wheel. All other
files are its data: pip puts them below the prefix of the environment, as PREFIX/bin/polargrain and PREFIX/share/polargrain,
where programs and package find each other. The same build gives the same bytes, with dates of $SOURCE_DATE_EPOCH.
"""
import base64
import csv
import hashlib
import io
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import time
import zipfile

EARLIEST = 315532800  # 1980, where the dates of zip files begin


def cached(build, name):
    """The value of a variable in the cache of the build."""
    return re.search(rf"^{name}:\w+=(.*)$", (build / "CMakeCache.txt").read_text(), re.M)[1]


def tags():
    """Interpreter, binary interface and platform of this Python, as wheels name them."""
    python = "cp{}{}".format(*sys.version_info)
    return python, python, re.sub(r"[-.]", "_", sysconfig.get_platform())


def metadata(version, summary, readme):
    return f"""Metadata-Version: 2.1
Name: polargrain
Version: {version}
Summary: {summary}
Author: The polargrain authors
License: GPL-2.0-or-later
Classifier: License :: OSI Approved :: GNU General Public License v2 or later (GPLv2+)
Classifier: Operating System :: POSIX :: Linux
Classifier: Topic :: Scientific/Engineering :: Physics
Requires-Python: =={sys.version_info[0]}.{sys.version_info[1]}.*
Requires-Dist: numpy
Description-Content-Type: text/markdown

{readme}"""


def wheel_file():
    return f"Wheel-Version: 1.0\nGenerator: polargrain make_wheel.py\nRoot-Is-Purelib: false\nTag: {'-'.join(tags())}\n"


class Wheel:
    """A wheel that is being written, with its record of what it holds."""

    def __init__(self, path, information):
        self.file = zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED)
        self.date = time.gmtime(max(EARLIEST, int(os.environ.get("SOURCE_DATE_EPOCH", EARLIEST))))[:6]
        self.information = information
        self.record = io.StringIO()
        self.rows = csv.writer(self.record, lineterminator="\n")

    def add(self, name, content, executable=False):
        entry = zipfile.ZipInfo(name, self.date)
        entry.external_attr = (0o100755 if executable else 0o100644) << 16
        entry.compress_type = zipfile.ZIP_DEFLATED
        self.file.writestr(entry, content)
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        self.rows.writerow([name, f"sha256={digest}", len(content)])

    def close(self):
        name = f"{self.information}/RECORD"
        self.rows.writerow([name, "", ""])  # no digest of itself
        self.add(name, self.record.getvalue().encode())
        self.file.close()


def main(build, folder):
    version = cached(build, "CMAKE_PROJECT_VERSION")
    with tempfile.TemporaryDirectory() as made:
        prefix = pathlib.Path(made)
        subprocess.run(["cmake", "--install", build, "--prefix", prefix, "--strip"], check=True, stdout=subprocess.DEVNULL)
        module = next(prefix.glob("**/polargrain/_cells*.so"), None)
        if module is None:
            sys.exit(f"make_wheel: {build} has no Python package")
        if module.name != "_cells" + sysconfig.get_config_var("EXT_SUFFIX"):
            sys.exit(f"make_wheel: {module.name} is for another Python: start this with {cached(build, 'Python_EXECUTABLE')}")
        said = subprocess.run([prefix / "bin/polargrain", "--version"], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
        if said != f"polargrain {version}":
            sys.exit(f"make_wheel: {build} is not finished: its program is {said}, its package of version {version}")
        documents = prefix / "share/doc/polargrain"
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / f"polargrain-{version}-{'-'.join(tags())}.whl"
        wheel = Wheel(path, f"polargrain-{version}.dist-info")
        for file in sorted(file for file in prefix.rglob("*") if file.is_file()):
            if module.parent in file.parents:
                name = file.relative_to(module.parent.parent)
            else:
                name = f"polargrain-{version}.data/data" / file.relative_to(prefix)
            wheel.add(str(name), file.read_bytes(), bool(file.stat().st_mode & 0o100))
        wheel.add(f"{wheel.information}/LICENSE", (documents / "LICENSE").read_bytes())
        summary = cached(build, "CMAKE_PROJECT_DESCRIPTION")
        wheel.add(f"{wheel.information}/METADATA", metadata(version, summary, (documents / "README.md").read_text(encoding="utf-8")).encode())
        wheel.add(f"{wheel.information}/WHEEL", wheel_file().encode())
        wheel.close()
    print(path)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]))
