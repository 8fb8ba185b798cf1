# SPDX-License-Identifier: MIT
"""What the checks of VTU files share: VTK itself reads them."""
import sys

import vtk


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
        sys.exit(f"{what}: {found}, expected {expected}")
