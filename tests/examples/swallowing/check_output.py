# SPDX-License-Identifier: MIT
"""Checks what a run of the swallow left behind, the frames with the real VTK where it is installed.

Usage: check_output.py FOLDER CASE [--no-surfaces], the last for a run with that option
"""
import json
import math
import pathlib
import sys
import xml.etree.ElementTree

out, case, with_surfaces = pathlib.Path(sys.argv[1]), sys.argv[2], "--no-surfaces" not in sys.argv
folder = out / case
PNG = b"\x89PNG\r\n\x1a\n"


def expect(condition, what):
    if not condition:
        sys.exit(f"{folder}: {what}")


pictures = [folder / "sheet.png", folder / "rear.png", folder / "sections.png", out / "fold.png", out / "model.png"]
for picture in pictures + [folder / "surfaces.png"] * with_surfaces:
    expect(picture.read_bytes().startswith(PNG), f"{picture.name} is no PNG")
expect(f"{case}" in (out / "table2.md").read_text(), "table2.md does not name the case")

summary = json.loads((folder / "summary.json").read_text())
for key in ("case spacing time_step steps particles_free particles_control fold_time fold_time_base tip_angle_min det_f "
            "max_penetration wall_seconds particle_steps_per_second contact_share failure").split():
    expect(key in summary, f"summary.json has no {key}")
expect(summary["case"] == case, "summary.json is of another case")
expect(summary["failure"] is None, f"the run failed: {summary['failure']}")
expect(summary["particles_free"] > 1000 and summary["particles_control"] > 1000, "there are hardly any particles")
expect(abs(summary["steps"] * summary["time_step"] - summary["time"]) < 1e-9, "steps and time do not agree")

lines = (folder / "series.csv").read_text().splitlines()
header = lines[0].split(",")
rows = [dict(zip(header, map(float, line.split(",")), strict=True)) for line in lines[1:]]
expect(rows and header[0] == "time", "series.csv is empty")
expect(all(math.isfinite(value) for row in rows for value in row.values()), "series.csv holds what is no number")
expect(all(a["time"] < b["time"] for a, b in zip(rows, rows[1:])), "the times of series.csv do not grow")
expect(rows[-1]["time"] <= summary["time"] + 1e-9, "series.csv runs beyond the end")

# The same moments; what touches as often as the series says; no force without a touch, and friction within its limit.
lines = (folder / "contacts.csv").read_text().splitlines()
header = lines[0].split(",")
contacts = [dict(zip(header, map(float, line.split(",")), strict=True)) for line in lines[1:]]
expect([row["time"] for row in contacts] == [row["time"] for row in rows], "contacts.csv has other times")
expect(len(header) > 30 and "epiglottis-pharynx_area" in header, "contacts.csv lacks columns")
for row, sample in zip(contacts, rows):
    area = sum(value for name, value in row.items() if name.endswith("_area"))
    expect(abs(area - sample["contacts"] / 2 * (1e3 * summary["spacing"]) ** 2) < 1e-6 * (1 + area),
           f"areas do not fit the contacts at {row['time']} s")
    for name in header:
        if name.endswith("_area"):
            normal, tangential = row[name[:-4] + "normal"], row[name[:-4] + "tangential"]
            expect((normal > 0) == (row[name] > 0), f"{name}: a force without a touch at {row['time']} s")
            expect(0 <= tangential <= summary["friction"] * normal * 1.0001, f"{name}: friction beyond its limit")
expect(f"{case}" in (out / "mechanisms.md").read_text(), "mechanisms.md does not name the case")



def frames_in(name):
    frames = xml.etree.ElementTree.parse(folder / name).getroot().findall("Collection/DataSet")
    expect(frames, f"{name} names no frame")
    return frames


frames = frames_in("frames.pvd")
surfaces = frames_in("surfaces.pvd") if with_surfaces else []
try:
    import vtk
except ImportError:
    print("VTK is not here: the frames were not read")
    sys.exit(0)


def grid_of(frame):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder / frame.get("file")))
    reader.Update()
    return reader.GetOutput()


for frame in frames:
    grid = grid_of(frame)
    expect(grid.GetNumberOfPoints() == summary["particles_free"] + summary["particles_control"],
           f"{frame.get('file')} has {grid.GetNumberOfPoints()} particles")
    expect(all(map(math.isfinite, grid.GetBounds())), f"{frame.get('file')} has no finite bounds")
    expect(grid.GetPointData().GetNumberOfArrays() > 0, f"{frame.get('file')} holds no data")
for frame in surfaces:
    grid = grid_of(frame)
    organs = grid.GetPointData().GetArray("organ")
    expect({grid.GetCellType(cell) for cell in range(0, grid.GetNumberOfCells(), 1000)} == {vtk.VTK_TRIANGLE},
           f"{frame.get('file')} holds what is no triangle")
    expect({organs.GetValue(point) for point in range(grid.GetNumberOfPoints())} == set(range(9)),
           f"{frame.get('file')} lacks an organ")
    # The surfaces lie where the particles are, and on the right.
    lower_x, upper_x, lower_y, upper_y, lower_z, upper_z = grid.GetBounds()
    expect(-85e-3 < lower_x < -70e-3 and 15e-3 < upper_x < 30e-3 and -35e-3 < lower_z < -15e-3 and
           95e-3 < upper_z < 105e-3 and -3e-3 < lower_y < 1e-3 and 20e-3 < upper_y < 35e-3,
           f"{frame.get('file')} has the bounds {grid.GetBounds()}")
print(f"{case}: {len(rows)} samples, {len(frames)} frames, {len(surfaces)} of surfaces")
