#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes whose volume turns back: what `model: adaptive` says of its error there, and what its error is.

    python3 unloading_family.py RESULTS --program build/release/app/polargrain              all of it
    python3 unloading_family.py RESULTS --program ... --half even                           while something is changed
    python3 unloading_family.py RESULTS --report                                            the table of what there is

12 scenes of six kinds: oedometers (K0) that are unloaded and loaded beyond, the same under a part of the surface alone,
isotropic cycles, cycles of pressure under a shear that is kept, a wall that gives way and comes back, cycles of weight. Packings and
loads are drawn with fixed seeds. Columns as in adaptive_family.py, which runs and compares them. Scene 00 is the oedometer from 100 to
35 to 180 kPa.
"""
import random

import adaptive_family as family

KINDS = ["k0", "part", "isotropic", "sheared", "wall", "weight"]


class Scene(family.Scene):
    def __init__(self, number):
        super().__init__(number)
        self.draw = random.Random(3000 + number)
        self.kind = KINDS[number // 2]
        self.name = f"{number:02d}-{self.kind}"
        self.spheres = self.triangles = False
        self.controlled = self.draw.random() < 0.25
        self.rolling = not self.controlled and self.draw.random() < 0.5
        self.packing_seed = self.draw.randrange(1, 7)
        self.loose = self.draw.random() < 0.3
        self.columns = self.rows = 4
        self.low = self.draw.uniform(0.15, 0.6)  # pressures, shares of the confining one
        self.high = self.draw.uniform(1.3, 2.5)
        if number == 0:
            self.low, self.high, self.loose, self.controlled = 0.35, 1.8, False, False
        self.steps = self.draw.randrange(6, 13)  # a stage
        self.size = 0.5
        self.shear = self.draw.uniform(0.002, 0.006)  # of the height
        self.way = self.draw.uniform(0.0005, 0.002)

    def side_of(self, i, j):
        if j == 2 * self.rows and self.kind == "part" and i < 4:
            return "footing"
        return super().side_of(i, j)

    def case(self, model):
        height = self.rows * self.size
        w = ", w" if self.controlled else ""
        low, high = 100 * self.low, 100 * self.high
        cycle = f"[[0, 100 kPa], [1, {low:.4g} kPa], [2, {high:.4g} kPa]]"
        below = f"{{on: bottom, fix: [u1, u2{w}]}}"
        sides = "{on: [left, right], fix: [u1]}"
        body, watched = "", ("top", "displacement: u2")
        if self.kind == "k0":
            boundary = [below, sides, f"{{on: top, pressure: {cycle}}}"]
        elif self.kind == "part":
            boundary = [below, sides, "{on: top, pressure: 100 kPa}", f"{{on: footing, pressure: {cycle}}}"]
            watched = ("footing", "displacement: u2")
        elif self.kind == "isotropic":
            boundary = ["{on: bottom, fix: [u2]}", "{on: left, fix: [u1]}", f"{{on: [top, right], pressure: {cycle}}}"]
        elif self.kind == "sheared":
            shear = self.shear * height
            boundary = [below, f"{{on: top, pressure: {cycle}, fix: [w], move: {{u1: [[0, 0], [1, {shear:.4g}], [2, {shear:.4g}]]}}}}",
                        f"{{on: [left, right], pressure: {cycle}}}"]
        elif self.kind == "wall":
            way = self.way * height
            boundary = ["{on: bottom, fix: [u2]}", "{on: right, fix: [u1]}", "{on: top, pressure: 100 kPa}",
                        f"{{on: left, move: {{u1: [[0, 0], [1, {-way:.4g}], [2, {2 * way:.4g}]]}}}}"]
            watched = ("left", "reaction: u1")
        else:
            weight = 100 * (1.0 - self.low) / height
            boundary = [below, sides, "{on: top, pressure: 100 kPa}"]
            body = (f"body:\n  - {{unit_weight: {weight:.4g} kN/m3, "
                    f"factor: [[0, 0], [1, -1], [2, {(self.high - 1) / (1 - self.low):.4g}]]}}\n")
        steps = f"stages: [{{until: 1, count: {self.steps}}}, {{until: 2, count: {self.steps}}}]"
        rotations = "rotations: controlled" if self.controlled else "lc: 10 mm"
        return (f"title: {self.name}\nmesh: {{file: {self.name}.msh}}\n"
                f"materials:\n  sand: {{{model}, script: {family.ROOT}/liggghts_inputs/cells/{self.script}, "
                f"packing: packings/{self.packing}.h5, {rotations}}}\n"
                "regions: {ground: sand}\nboundary:\n" + "".join(f"  - {item}\n" for item in boundary) + body +
                f"steps: {{{steps}, cut: 6, iterations: 30, tolerance: 2e-3, noise: 2}}\n"
                f"monitors: {{load: {{on: {watched[0]}, {watched[1]}}}}}\n")


if __name__ == "__main__":
    family.Scene, family.COUNT, family.GROUPS = Scene, 2 * len(KINDS), {"unloading": range(2 * len(KINDS))}
    family.main()
