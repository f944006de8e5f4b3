# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads grains with VTK as ParaView does, and says what they add up to.

    grains_read.py GRAINS.pvd STEP_INDEX [POINTS.vtu NUMBER]

A line a value, `name numbers`: stress from branches and forces (11 12 13 21 22 23 31 32 33), void_ratio (in the plane, or
in space), coordination_number, sliding_fraction, rolling_fraction, rattlers, mean_rotation (about e_3), time, moved (the
largest |rotation|), speed, overlap (the largest sum of radii less branch over the sum), glyph_error (how far the width
of a sphere glyph scaled by `diameter` is from twice the radius, over it), other_glyphs (what shows and is no grain); of a point: point:NAME of the fields of
the same names. Exit status 1 when VTK reports an error."""
import os
import sys
import xml.etree.ElementTree

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkFiltersCore import vtkGlyph3D
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

messages = vtkStringOutputWindow()
vtkOutputWindow.SetInstance(messages)


def grid_of(file):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(file)
    reader.Update()
    return reader.GetOutput()


def arrays_of(data):
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}


def tell(name, values):
    print(name, *[repr(float(v)) for v in numpy.ravel(values)])


collection = sys.argv[1]
entry = xml.etree.ElementTree.parse(collection).findall(".//DataSet")[int(sys.argv[2])]
tell("time", float(entry.get("timestep")))
grid = grid_of(os.path.join(os.path.dirname(collection), entry.get("file")))
places = vtk_to_numpy(grid.GetPoints().GetData())
nodes = arrays_of(grid.GetPointData())
cells = arrays_of(grid.GetCellData())
whole = arrays_of(grid.GetFieldData())
box = whole["box"].reshape(3, 3)
volume = numpy.linalg.det(box)
tell("volume_error", volume / whole["volume"][0] - 1)

kind = cells["kind"]
grains = numpy.flatnonzero(kind == 0)  # a vertex each, first
assert (grains == numpy.arange(len(grains))).all()
assert (numpy.sort(nodes["id"][grains]) == numpy.arange(len(grains))).all()
inside = numpy.linalg.solve(box, places[grains].T)
assert inside.min() >= -1e-12 and inside.max() <= 1 + 1e-12, "grains lie in the box"
lines = numpy.flatnonzero(kind == 1)
ends = numpy.array([[grid.GetCell(int(c)).GetPointId(i) for i in (0, 1)] for c in lines])
branches = places[ends[:, 1]] - places[ends[:, 0]]
of_id = numpy.empty(len(grains), int)
of_id[nodes["id"][grains].astype(int)] = grains
first, second = (of_id[cells[name][lines].astype(int)] for name in ("first", "second"))
images = numpy.linalg.solve(box, (places[ends[:, 1]] - places[second]).T)
assert abs(images - images.round()).max() < 1e-9, "lines end at images of the second grain"
assert abs(places[ends[:, 0]] - places[first]).max() == 0.0
forces = cells["force"][lines]
tell("stress", numpy.einsum("ci,cj->ij", branches, forces) / volume)
lengths = numpy.linalg.norm(branches, axis=1)
normal = -numpy.einsum("ci,ci->c", forces, branches) / lengths
tell("normal_force_error", abs(normal - cells["normal_force"][lines]).max() / abs(normal).max())
tangential = numpy.linalg.norm(numpy.cross(forces, branches), axis=1) / lengths
tell("tangential_force_error", abs(tangential - cells["tangential_force"][lines]).max() / abs(normal).max())
assert (nodes["normal_force"][ends[:, 0]] == cells["normal_force"][lines]).all()
tell("overlap", (1 - lengths / (nodes["radius"][first] + nodes["radius"][second])).max())
plane = numpy.ptp(places[:, 2]) == 0.0
radii = nodes["radius"][grains]
solid = numpy.pi * (radii**2).sum() if plane else 4 / 3 * numpy.pi * (radii**3).sum()
tell("void_ratio", (numpy.linalg.det(box[:2, :2]) if plane else volume) / solid - 1)
counted = numpy.bincount(numpy.concatenate([first, second]), minlength=len(grains))
assert (counted == nodes["coordination_number"][grains]).all()
tell("coordination_number", counted.mean())
tell("rattlers", (counted == 0).mean())
tell("sliding_fraction", cells["sliding"][lines].mean())
tell("rolling_fraction", cells["rolling_at_limit"][lines].mean())
tell("rolling_moment", numpy.linalg.norm(cells["rolling_moment"][lines], axis=1).max())
tell("mean_rotation", nodes["rotation"][grains, 2].mean())
tell("rotation_spread", nodes["rotation"][grains, 2].std())
tell("moved", numpy.linalg.norm(nodes["rotation"][grains], axis=1).max())
tell("speed", numpy.linalg.norm(nodes["velocity"][grains], axis=1).max())
edges = kind == 2
tell("edges", edges.sum())

# One glyph filter: spheres scaled by `diameter` are the grains, and what is no grain does not show.
grid.GetPointData().SetActiveScalars("diameter")
sphere = vtkSphereSource()
sphere.SetThetaResolution(8)
sphere.SetPhiResolution(9)
glyph = vtkGlyph3D()
glyph.SetInputData(grid)
glyph.SetSourceConnection(sphere.GetOutputPort())
glyph.SetScaleModeToScaleByScalar()
glyph.Update()
shape = vtk_to_numpy(glyph.GetOutput().GetPoints().GetData()).reshape(len(places), -1, 3)
widths = numpy.ptp(shape, axis=1).max(axis=1)
tell("glyph_error", abs(widths[grains] / (2 * radii) - 1).max())
tell("other_glyphs", (widths[len(grains):] > 1e-3 * radii.min()).sum())

if len(sys.argv) > 3:
    points = arrays_of(grid_of(sys.argv[3]).GetPointData())
    for name, values in points.items():
        tell("point:" + name, values[int(sys.argv[4])])
sys.exit(1 if messages.GetOutput() else 0)
