# SPDX-License-Identifier: MIT
"""Reads the frames that frames.test.cpp wrote with the real VTK and compares every value.

Usage: read_frames.py FOLDER, the folder with frames.pvd. Ends with 1 at the first difference.
"""
import pathlib
import sys
import xml.etree.ElementTree

import vtk

POSITIONS = [[0, 0.25, -1], [1, 2, 3], [-4, 5.5, 6]]


def read(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    errors = []
    reader.AddObserver("ErrorEvent", lambda *_: errors.append("VTK could not read " + str(path)))
    reader.SetFileName(str(path))
    reader.Update()
    if errors:
        sys.exit(errors[0])
    return reader.GetOutput()


def values(array):
    rows = [list(array.GetTuple(i)) for i in range(array.GetNumberOfTuples())]
    return [row[0] for row in rows] if array.GetNumberOfComponents() == 1 else rows


def same(what, found, expected):
    if found != expected:
        sys.exit(f"{what} is {found}, expected {expected}")


folder = pathlib.Path(sys.argv[1])
frames = xml.etree.ElementTree.parse(folder / "frames.pvd").getroot().findall("Collection/DataSet")
same("the times", [float(frame.get("timestep")) for frame in frames], [0, 0.125])
for frame in frames:
    grid = read(folder / frame.get("file"))
    data = grid.GetPointData()
    same("the number of cells", grid.GetNumberOfCells(), 3)
    same("the type of a cell", grid.GetCellType(2), vtk.VTK_VERTEX)
    same("the positions", values(grid.GetPoints().GetData()), POSITIONS)
    same("the velocities", values(data.GetArray("velocity")), POSITIONS)
    same("J", values(data.GetArray("J")), [1, 0.5, 1.25])
    same("the organs", values(data.GetArray("organ")), [0, 7, 3])
    same("the time", grid.GetFieldData().GetArray("TimeValue").GetValue(0), float(frame.get("timestep")))
print("VTK", vtk.vtkVersion().GetVTKVersion(), "read", len(frames), "frames")
