# SPDX-License-Identifier: MIT
"""Reads the frames that frames.test.cpp wrote with the real VTK and compares every value.

Usage: read_frames.py FOLDER, the folder with frames.pvd. Ends with 1 at the first difference.
"""
import pathlib
import sys
import xml.etree.ElementTree

import vtk

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "reference"))
from vtk_files import read, same, values  # noqa: E402

POSITIONS = [[0, 0.25, -1], [1, 2, 3], [-4, 5.5, 6]]

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
