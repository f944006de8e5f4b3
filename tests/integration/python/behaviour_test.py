# SPDX-License-Identifier: GPL-2.0-or-later
"""The cell as a generic behaviour, driven by a host that loads it as MGIS does: symbols by their names, plain arrays."""
import concurrent.futures
import ctypes
import os
import pathlib
import shutil
import unittest

import numpy as np

import polargrain
from support import PACKING, InFolder

LIBRARY = pathlib.Path(os.environ["POLARGRAIN_BEHAVIOUR"])
Numbers = ctypes.POINTER(ctypes.c_double)
TENSOR = {2: [(0, 0), (1, 1), (2, 2), (0, 1), (1, 0)],
          3: [(0, 0), (1, 1), (2, 2), (0, 1), (1, 0), (0, 2), (2, 0), (1, 2), (2, 1)]}


class State(ctypes.Structure):
    _fields_ = [(name, Numbers) for name in ("gradients", "forces", "mass_density", "material_properties", "internal_variables",
                                             "stored_energy", "dissipated_energy", "external_variables")]


class Data(ctypes.Structure):
    _fields_ = [("error_message", ctypes.c_char_p), ("dt", ctypes.c_double), ("K", Numbers), ("rdt", Numbers),
                ("speed_of_sound", Numbers), ("s0", State), ("s1", State)]


class Host:
    """One integration point of a finite element code."""

    def __init__(self, library, hypothesis):
        self.library = ctypes.CDLL(str(library))
        self.dimension = {"PlaneStrain": 2, "Tridimensional": 3}[hypothesis]
        self.hypothesis = hypothesis
        assert self.number("mfront_mkt") == 1 and self.number("api_version") == 1
        gradients, forces = self.sizes("Gradients"), self.sizes("ThermodynamicForces")
        self.names = {kind: self.texts(kind) for kind in ("Gradients", "ThermodynamicForces", "InternalStateVariables")}
        blocks = self.texts("TangentOperatorBlocks")
        self.blocks = list(zip(blocks[::2], blocks[1::2]))
        size_of = {**dict(zip(self.names["Gradients"], gradients)), **dict(zip(self.names["ThermodynamicForces"], forces))}
        self.block_shapes = [(size_of[force], size_of[gradient]) for force, gradient in self.blocks]
        self.gradients = [np.zeros(sum(gradients)) for _ in range(2)]
        self.forces = [np.zeros(sum(forces)) for _ in range(2)]
        self.variables = [np.zeros(sum(self.sizes("InternalStateVariables"))) for _ in range(2)]
        self.K = np.zeros(sum(rows * columns for rows, columns in self.block_shapes))
        self.message = ctypes.create_string_buffer(512)
        self.rdt = np.ones(1)

    def symbol(self, kind, name):
        for prefix in (f"PolargrainCell_{self.hypothesis}_", "PolargrainCell_"):
            try:
                return kind.in_dll(self.library, prefix + name)
            except ValueError:
                continue
        raise AssertionError(f"there is no symbol {name}")

    def number(self, name):
        return self.symbol(ctypes.c_ushort, name).value

    def texts(self, name):
        count = self.symbol(ctypes.c_ushort, "n" + name).value
        return [text.decode() for text in self.symbol(ctypes.c_char_p * count, name)]

    def sizes(self, name):
        return [self.size(kind) for kind in self.symbol(ctypes.c_int * self.number("n" + name), name + "Types")]

    def size(self, kind):
        if kind & 7 == 5:  # an array: number of extents, extents, scalars
            count = kind >> 3 & 7
            extents = [kind >> 6 + 7 * k & 127 for k in range(count)]
            assert kind >> 6 + 7 * count == 0
            return int(np.prod(extents))
        return {0: 1, 2: self.dimension, 3: len(TENSOR[self.dimension])}[kind]

    def data(self, wish):
        self.K[0] = wish
        data = Data(error_message=ctypes.cast(self.message, ctypes.c_char_p), dt=1.0, K=self.pointer(self.K),
                    rdt=self.pointer(self.rdt))
        for state, k in ((data.s0, 0), (data.s1, 1)):
            state.gradients = self.pointer(self.gradients[k])
            state.forces = self.pointer(self.forces[k])
            state.internal_variables = self.pointer(self.variables[k])
        return data

    @staticmethod
    def pointer(array):
        return array.ctypes.data_as(Numbers)

    def initialize(self, name):
        function = getattr(self.library, f"PolargrainCell_{self.hypothesis}_InitializeFunction_{name}")
        return function(ctypes.byref(self.data(0.0)), None)

    def integrate(self, gradients, wish=4.0):
        """To these gradients at the end of the step. @returns what the behaviour does"""
        self.gradients[1][:] = gradients
        self.message.value = b""
        self.rdt[0] = 1.0
        return getattr(self.library, f"PolargrainCell_{self.hypothesis}")(ctypes.byref(self.data(wish)))

    def update(self):
        for pair in (self.gradients, self.forces, self.variables):
            pair[0][:] = pair[1]

    def tangent(self):
        """By the names of force and gradient."""
        ends = np.cumsum([rows * columns for rows, columns in self.block_shapes])
        return {names: part.reshape(shape) for names, shape, part in
                zip(self.blocks, self.block_shapes, np.split(self.K, ends[:-1]))}


class Behaviour(InFolder):
    def library(self, words):
        """A copy of the library with the file of its cell beside it: a behaviour of its own."""
        copy = self.folder / f"lib{len(os.listdir(self.folder))}" / LIBRARY.name
        copy.parent.mkdir()
        shutil.copy(LIBRARY, copy)
        copy.with_suffix(".yaml").write_text(words)
        os.environ["POLARGRAIN_PROGRAM"] = polargrain.program.program()
        self.addCleanup(os.environ.pop, "POLARGRAIN_PROGRAM", None)
        return copy

    def test_of_discs_answers_as_the_cell_does(self):
        # Strain and curvature as MFront has them: e_ij = u_i,j + e_ijk w_k; here h_12 = 1e-3, h_21 = -2e-4, w = 3e-4, ...
        steps = [dict(h=[[5e-4, 0], [0, -1e-3]], w=0.0, k=[0, 0]), dict(h=[[0, 1e-3], [-2e-4, 0]], w=3e-4, k=[0, 0]),
                 dict(h=[[0, 0], [0, -1e-3]], w=0.0, k=[0.05, -0.02])]
        host = Host(self.library(f"script: cells/hooke_li_chu.in\npacking: {PACKING}\nrotations: controlled\n"), "PlaneStrain")
        self.assertEqual(host.names["Gradients"], ["TotalStrain", "WrynessTensor"])
        self.assertEqual(host.blocks, [(force, gradient) for force in ("Stress", "CoupleStressTensor")
                                       for gradient in ("TotalStrain", "WrynessTensor")])
        cell = polargrain.Cell(PACKING, "cells/hooke_li_chu.in", rotations="controlled")
        self.assertEqual(host.initialize("AtRest"), 0)
        np.testing.assert_array_equal(host.forces[1][[0, 1]], np.diag(cell.at_rest.stress))
        host.update()
        gradients = np.zeros(7)
        for step in steps:
            h, w = np.array(step["h"]), step["w"]
            gradients += [h[0, 0], h[1, 1], 0, h[0, 1] + w, h[1, 0] - w, *step["k"]]
            self.assertEqual(host.integrate(gradients), 1, host.message.value)
            # What the cell is led along is the difference of what adds up: in the last bits other than the steps themselves.
            e = host.gradients[1] - host.gradients[0]
            answer = cell.step(displacement_gradient=[[e[0], 0.5 * (e[3] + e[4])], [0.5 * (e[3] + e[4]), e[1]]],
                               rotation=0.5 * (e[3] - e[4]), curvature=e[5:])
            s = answer.stress  # first index the normal; hosts have the direction first
            np.testing.assert_array_equal(host.forces[1], [s[0, 0], s[1, 1], 0, s[1, 0], s[0, 1], *answer.couple_stress])
            host.update()
        tangent = host.tangent()
        places = [cell.components.index(name) for name in ("s11", "s22", "s21", "s12", "m13", "m23")]
        expected = answer.tangent[np.ix_(places, places)]
        inner = [0, 1, 3, 4]  # without 33, of which discs know nothing
        for force, rows, all_rows in (("Stress", slice(0, 4), inner), ("CoupleStressTensor", slice(4, 6), [0, 1])):
            for gradient, columns, all_columns in (("TotalStrain", slice(0, 4), inner), ("WrynessTensor", slice(4, 6), [0, 1])):
                np.testing.assert_array_equal(tangent[force, gradient][np.ix_(all_rows, all_columns)], expected[rows, columns])

    def test_keeps_its_states_with_the_host(self):
        host = Host(self.library(f"script: cells/hooke_radii.in\npacking: {PACKING}\nworkers: 2\n"), "PlaneStrain")
        first, second = np.array([0, -1e-3, 0, 0, 0, 0, 0]), np.array([0, -1e-3, 0, 1e-3, 0, 0, 0])
        self.assertEqual(host.integrate(first), 1)
        host.update()
        self.assertEqual(host.integrate(second), 1)
        kept = host.forces[1].copy()
        host.integrate(2 * second)                          # another try of the same step
        self.assertEqual(host.integrate(second, wish=0.0), 1)  # and back, without a tangent
        np.testing.assert_array_equal(host.forces[1], kept)
        # Variables that went through a file of text are the same ones; changed ones are found.
        host.variables[0][:] = [float(repr(value)) for value in host.variables[0]]
        self.assertEqual(host.integrate(second), 1)
        np.testing.assert_array_equal(host.forces[1], kept)
        host.variables[0][5] += 1
        self.assertEqual(host.integrate(second), -1)
        self.assertIn(b"neither interpolated nor averaged", host.message.value)

    def test_serves_threads_of_the_host(self):
        library = self.library(f"script: cells/hooke_radii.in\npacking: {PACKING}\nworkers: 2\n")
        hosts = [Host(library, "PlaneStrain") for _ in range(4)]
        strains = [[0, -1e-4 * (k + 1), 0, 0, 0, 0, 0] for k in range(4)]
        with concurrent.futures.ThreadPoolExecutor(4) as threads:  # more than workers
            self.assertEqual(list(threads.map(Host.integrate, hosts, strains)), [1] * 4)
        for host, strain in zip(hosts, strains):
            answer = polargrain.Cell(PACKING, "cells/hooke_radii.in").step(displacement_gradient=np.diag([0, strain[1]]))
            self.assertEqual(host.forces[1][1], answer.stress[1, 1])

    def test_predicts_without_a_step(self):
        host = Host(self.library(f"script: cells/hooke_radii.in\npacking: {PACKING}\n"), "PlaneStrain")
        self.assertEqual(host.integrate(np.full(7, 1e-3), wish=-3.0), 1)
        self.assertTrue(np.all(host.forces[1] == 0) and np.all(host.variables[1] == 0))
        at_rest = polargrain.Cell(PACKING, "cells/hooke_radii.in").at_rest
        self.assertEqual(host.tangent()["Stress", "TotalStrain"][1, 1], at_rest.tangent[3, 3])

    def test_of_spheres_turns_and_bends_them(self):
        packing, script = "cases/spheres/packing1000.csv", "cells/spheres_hooke_radii.in"
        host = Host(self.library(f"script: {script}\npacking: {packing}\nrotations: controlled\n"), "Tridimensional")
        cell = polargrain.Cell(packing, script, rotations="controlled")
        h, w, k = np.zeros((3, 3)), np.array([2e-5, -1e-5, 3e-5]), np.array([[0.01, 0, 0.02], [0, -0.01, 0], [0.03, 0, 0]])
        h[2, 2] = -1e-4
        turn = np.array([[0, w[2], -w[1]], [-w[2], 0, w[0]], [w[1], -w[0], 0]])  # e_ijk w_k
        e = [(h + turn)[i, j] for i, j in TENSOR[3]] + [k[i, j] for i, j in TENSOR[3]]
        self.assertEqual(host.integrate(e), 1, host.message.value)
        answer = cell.step(displacement_gradient=h, rotation=w, curvature=k)
        np.testing.assert_array_equal(host.forces[1], [answer.stress[j, i] for i, j in TENSOR[3]] +
                                      [answer.couple_stress[j, i] for i, j in TENSOR[3]])
        places = [3 * j + i for i, j in TENSOR[3]]
        for force, rows in (("Stress", 0), ("CoupleStressTensor", 9)):
            for gradient, columns in (("TotalStrain", 0), ("WrynessTensor", 9)):
                np.testing.assert_array_equal(host.tangent()[force, gradient], answer.tangent[
                    np.ix_([rows + place for place in places], [columns + place for place in places])])

    def test_says_what_is_wrong(self):
        for words, hypothesis, expected in (
                (f"script: cells/hooke_radii.in\npacking: {PACKING}\ndampin: 0.1\n", "PlaneStrain", b"did you mean 'damping'?"),
                (f"script: cells/hooke_radii.in\npacking: {PACKING}\n", "Tridimensional", b"knows its plane alone"),
                (f"script: cells/hooke_radii.in\npacking: {PACKING}\nstate_bytes: 600\n", "PlaneStrain", b"set state_bytes")):
            with self.subTest(expected):
                host = Host(self.library(words), hypothesis)
                self.assertEqual(host.integrate([0, 1e-4, *np.zeros(len(host.gradients[1]) - 2)]), -1)
                self.assertIn(expected, host.message.value)
                self.assertTrue(np.all(host.forces[1] == 0))
        host = Host(self.library(f"script: cells/hooke_radii.in\npacking: {PACKING}\n"), "PlaneStrain")
        self.assertEqual(host.integrate([0, 0, 0, 2.0, 0, 0, 0]), -1)
        self.assertIn(b"at most 0.25 is taken", host.message.value)
        self.assertEqual(host.rdt[0], 0.5)


if __name__ == "__main__":
    unittest.main()
