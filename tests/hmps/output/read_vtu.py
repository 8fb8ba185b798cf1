# SPDX-License-Identifier: MIT
"""Reads the files that vtu_file.test.cpp wrote with the real VTK and compares every value.

Usage: read_vtu.py FOLDER. Ends with 1 at the first difference.
"""
import pathlib
import sys

import vtk

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "reference"))
from vtk_files import read, same, values  # noqa: E402

POSITIONS = [[0, 0.25, -1], [1, 2, 3], [-4, 5.5, 6]]
IDENTITY = [1, 0, 0, 0, 1, 0, 0, 0, 1]

folder = pathlib.Path(sys.argv[1])
for name, cells, kind in (("cloud", 3, vtk.VTK_VERTEX), ("surface", 2, vtk.VTK_TRIANGLE)):
    grid = read(folder / (name + ".vtu"))
    data = grid.GetPointData()
    same("the number of cells", grid.GetNumberOfCells(), cells)
    same("the type of a cell", grid.GetCellType(1), kind)
    same("the positions", values(grid.GetPoints().GetData()), POSITIONS)
    same("the velocities", values(data.GetArray("velocity")), POSITIONS)
    same("J", values(data.GetArray("J")), [1, 0.5, 1.25])
    same("the type of J", data.GetArray("J").GetDataType(), vtk.VTK_DOUBLE)
    same("the organs", values(data.GetArray("organ")), [0, 1, 0])
    same("the stresses", values(data.GetArray("stress <&>")), [IDENTITY, [1, 2, 3, 4, 5, 6, 7, 8, 9], IDENTITY])
    same("the time", grid.GetFieldData().GetArray("TimeValue").GetValue(0), 0.125)
    names = grid.GetFieldData().GetAbstractArray("organ names")
    same("the names", [names.GetValue(i) for i in range(names.GetNumberOfValues())], ["tongue", "palate & uvula"])
points = [read(folder / "surface.vtu").GetCell(1).GetPointId(c) for c in range(3)]
same("the corners of a triangle", points, [0, 2, 1])
same("the points of an empty file", read(folder / "empty.vtu").GetNumberOfPoints(), 0)
print("VTK", vtk.vtkVersion().GetVTKVersion(), "read 3 files")
