# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads a .vtu file with VTK's own reader and prints what is in it, a line an array: name, tuples, components,
sum, first and last value. Exit status 1 when VTK reports an error."""
import sys

from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

messages = vtkStringOutputWindow()
vtkOutputWindow.SetInstance(messages)
reader = vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
grid = reader.GetOutput()
print("grid", grid.GetNumberOfPoints(), grid.GetNumberOfCells(), grid.GetCellType(0), *grid.GetBounds()[:4])
print("corner", *[grid.GetCell(0).GetPointId(i) for i in range(grid.GetCell(0).GetNumberOfPoints())])
for data in (grid.GetPointData(), grid.GetCellData()):
    for i in range(data.GetNumberOfArrays()):
        array = data.GetArray(i)
        values = [v for t in range(array.GetNumberOfTuples()) for v in array.GetTuple(t)]
        print(array.GetName(), array.GetNumberOfTuples(), array.GetNumberOfComponents(), repr(sum(values)),
              repr(values[0]), repr(values[-1]))
sys.exit(1 if messages.GetOutput() else 0)
