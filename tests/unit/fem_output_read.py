# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads a .vtu file with VTK's own reader and prints what is in it, a line an array: name (of nodes, where elements have one of
that name too: node:NAME), tuples, components,
sum, first and last value; then a line `about:NAME` with unit and names of components. Exit status 1 when VTK reports an error."""
import sys

from vtkmodules.vtkCommonCore import vtkDataArray, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

messages = vtkStringOutputWindow()
vtkOutputWindow.SetInstance(messages)
reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
grid = reader.GetOutput()
print("grid", grid.GetNumberOfPoints(), grid.GetNumberOfCells(), grid.GetCellType(0), *grid.GetBounds()[:4])
print("corner", *[grid.GetCell(0).GetPointId(i) for i in range(grid.GetCell(0).GetNumberOfPoints())])
cells = grid.GetCellData()
for data in (grid.GetPointData(), cells):
    for i in range(data.GetNumberOfArrays()):
        array = data.GetArray(i)
        values = [v for t in range(array.GetNumberOfTuples()) for v in array.GetTuple(t)]
        name = array.GetName()
        if data is not cells and cells.HasArray(name):
            name = "node:" + name
        print(name, array.GetNumberOfTuples(), array.GetNumberOfComponents(), repr(sum(values)),
              repr(values[0]), repr(values[-1]))
        information = array.GetInformation()
        unit = information.Get(vtkDataArray.UNITS_LABEL()) if information.Has(vtkDataArray.UNITS_LABEL()) else "-"
        print("about:" + name, unit,
              *[array.GetComponentName(k) or "-" for k in range(array.GetNumberOfComponents())])
sys.exit(1 if messages.GetOutput() else 0)
