#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Refuses includes that run upwards: between the folders of the program, and between those of dem."""
import pathlib
import re
import sys

# From below to above. Folders of one line do not include each other.
LAYERS = {
    "": [["common"], ["grains_io"], ["fem", "dem"], ["element", "band"], ["coupler"], ["app"]],
    "dem/": [["engine"], ["contact"], ["lanes"], ["box"], ["laws"], ["discs"], ["sphere_loop"], ["cell"], ["pack", "specimen", "standalone"]],
}


def upward_includes(root):
    """Lines 'file:number: message' of the includes below `root` that run upwards."""
    for parent, layers in LAYERS.items():
        level = {folder: k for k, layer in enumerate(layers) for folder in layer}
        pattern = re.compile(rf'#include "{parent}(\w+)/')
        for folder in level:
            for file in sorted((root / parent / folder).rglob("*.[ch]pp")):
                for number, line in enumerate(file.read_text().splitlines(), 1):
                    found = pattern.match(line)
                    other = found and found.group(1)
                    if other in level and other != folder and level[other] >= level[folder]:
                        yield f"{file.relative_to(root)}:{number}: {parent}{folder} lies below {parent}{other} or beside it"


faults = list(upward_includes(pathlib.Path(__file__).resolve().parent.parent))
for fault in faults:
    print(fault)
sys.exit(1 if faults else 0)
