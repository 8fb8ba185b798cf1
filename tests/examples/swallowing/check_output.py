# SPDX-License-Identifier: MIT
"""Checks what a run of the swallow left behind, the frames with the real VTK where it is installed.

Usage: check_output.py FOLDER CASE
"""
import json
import math
import pathlib
import sys
import xml.etree.ElementTree

out, case = pathlib.Path(sys.argv[1]), sys.argv[2]
folder = out / case
PNG = b"\x89PNG\r\n\x1a\n"


def expect(condition, what):
    if not condition:
        sys.exit(f"{folder}: {what}")


for picture in (folder / "sheet.png", folder / "rear.png", folder / "sections.png", out / "fold.png",
                out / "model.png"):
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

frames = xml.etree.ElementTree.parse(folder / "frames.pvd").getroot().findall("Collection/DataSet")
expect(frames, "frames.pvd names no frame")
try:
    import vtk
except ImportError:
    print("VTK is not here: the frames were not read")
    sys.exit(0)
for frame in frames:
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder / frame.get("file")))
    reader.Update()
    grid = reader.GetOutput()
    expect(grid.GetNumberOfPoints() == summary["particles_free"] + summary["particles_control"],
           f"{frame.get('file')} has {grid.GetNumberOfPoints()} particles")
    expect(all(map(math.isfinite, grid.GetBounds())), f"{frame.get('file')} has no finite bounds")
    expect(grid.GetPointData().GetNumberOfArrays() > 0, f"{frame.get('file')} holds no data")
print(f"{case}: {len(rows)} samples, {len(frames)} frames")
