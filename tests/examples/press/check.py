# SPDX-License-Identifier: MIT
"""Runs examples/press with few particles and reads back what it wrote.

Usage: check.py PROGRAM. Ends with 1 and a message at the first thing that is wrong.
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

LINE = re.compile(r"The plate is down by +(\S+) mm and feels +(\S+) N\.")


def check(condition, message):
    if not condition:
        sys.exit(message)


def read(path, vtk):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def check_surface(folder, frames, plate, vtk):
    """The highest point of the pressed surface lies at the plate, and its lowest one, which is held, where it was."""
    first, last = (read(folder / frames[k], vtk) for k in (0, -1))
    check(first.GetNumberOfPoints() == last.GetNumberOfPoints() > 1000, "the frames of the surface have other points")
    low, high = (first.GetBounds()[k] for k in (4, 5))
    spacing = 0.006  # about 400 particles in 80 mL
    height = high - plate
    check(abs(last.GetBounds()[5] - height) < spacing / 2, f"the surface ends at {last.GetBounds()[5]}, the plate at {height}")
    check(abs(last.GetBounds()[4] - low) < spacing / 2, f"the base has moved from {low} to {last.GetBounds()[4]}")
    check(last.GetPointData().GetArray("von Mises stress").GetRange()[1] > 1000, "the surface bears no stress")


def check_arguments(program):
    """What is no positive number ends the program before it writes anything."""
    for arguments, word in (["abc"], "PARTICLES"), (["-5"], "PARTICLES"), (["400", "organ.stl", "0x1"], "SCALE"):
        with tempfile.TemporaryDirectory() as name:
            found = subprocess.run([program, *arguments], cwd=name, capture_output=True, text=True)
            check(found.returncode == 1 and f"press: {word} is '{arguments[-1]}'" in found.stderr, found.stderr)
            check(not list(pathlib.Path(name).iterdir()), "a program that was refused has written something")
    found = subprocess.run([program, "400", "organ.stl", "1e-3", "more"], capture_output=True, text=True)
    check(found.returncode == 1 and "press: 'more' is one argument too many" in found.stderr, found.stderr)


def main(program):
    check_arguments(program)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name) / "press"
        found = subprocess.run([program, "400"], cwd=name, capture_output=True, text=True)
        check(found.returncode == 0, found.stderr)
        rows = [(float(depth), float(force)) for depth, force in LINE.findall(found.stdout)]
        check(len(rows) > 3 and rows[0] == (0, 0), "the program did not begin without a load:\n" + found.stdout)
        check(all(a[1] < b[1] for a, b in zip(rows, rows[1:])), "the force does not grow:\n" + found.stdout)
        png = (folder / "press.png").read_bytes()
        check(png.startswith(b"\x89PNG") and len(png) > 10000, "press.png is no picture")
        for series in ("press", "surface"):
            frames = xml.etree.ElementTree.parse(folder / (series + ".pvd")).getroot().findall("Collection/DataSet")
            frames = [frame.get("file") for frame in frames]
            check(len(frames) == len(rows), f"{series}.pvd lists {len(frames)} frames, expected {len(rows)}")
            check(all((folder / frame).is_file() for frame in frames), f"a frame of {series}.pvd is missing")
        try:
            import vtk
        except ImportError:
            print("python3-vtk9 is not here: the frames are not read")
        else:
            check_surface(folder, frames, 1e-3 * rows[-1][0], vtk)
        missing = subprocess.run([program, "400", "no/such.stl"], cwd=name, capture_output=True, text=True)
        check(missing.returncode == 1 and "no/such.stl" in missing.stderr, "a missing file is not named")


main(sys.argv[1])
