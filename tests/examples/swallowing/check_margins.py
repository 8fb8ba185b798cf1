# SPDX-License-Identifier: MIT
"""Runs examples/swallowing/margins for a few steps of each change, and checks the table and what was changed.

Usage: check_margins.py MARGINS PROGRAM
"""
import json
import pathlib
import subprocess
import sys
import tempfile


def expect(condition, what):
    if not condition:
        sys.exit(f"margins: {what}")


def table_of(name):
    lines = [line for line in (out / "tracks" / name).read_text().splitlines() if not line.startswith("#")]
    header = lines[0].split(",")
    return [dict(zip(header, map(float, line.split(",")), strict=True)) for line in lines[1:]]


with tempfile.TemporaryDirectory() as folder:
    out = pathlib.Path(folder)
    command = [sys.argv[1], "--program", sys.argv[2], "--cases", "Y1", "--until", "1e-4", "--out", str(out)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    rows = (out / "margins.md").read_text().splitlines()[2:]
    names = [row.split("|")[1].strip() for row in rows]
    expect(len(rows) == 15 and names[0] == "as it is", f"the table has {len(rows)} rows")
    settings = {}
    for name in names:
        summary = json.loads((out / name / "Y1/summary.json").read_text())
        expect(summary["failure"] is None, f"{name} failed: {summary['failure']}")
        settings[name] = json.dumps([summary["settings"], summary["penalty"]])
    expect(len(set(settings.values())) == len(names), "two changes make the same run")

    furthest = max(row["turn"] for row in table_of("F_more/epiglottis.csv"))
    expect(abs(furthest - 66) < 1e-9, f"F turns by {furthest} degrees instead of 66")
    onsets = [{row["z"]: row["start"] for row in table_of(f"H_{word}/constrictors.csv")} for word in ("earlier", "later")]
    expect(all(abs(onsets[1][z] - onsets[0][z] - 0.02) < 1e-9 for z in onsets[0]), "H does not set in 20 ms later")

    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)  # goes on where there is nothing left to do
    expect((out / "margins.md").read_text().splitlines()[2:] == rows, "the same command again gives another table")

    subprocess.run([*command, "--map", "0.1"], check=True, stdout=subprocess.DEVNULL)
    slopes = (out / "map.md").read_text().splitlines()[2:]
    expect(len(slopes) == 5 and all(row.count("|") == 3 for row in slopes), f"the map has {len(slopes)} rows")
    angles = [[row["angle"] for row in table_of(f"H{degrees:+}/constrictors.csv")] for degrees in (-8, 0, 8)]
    expect(angles == [[0, 0, 24, 24], [0, 0, 32, 32], [0, 0, 40, 40]], f"the plates of H turn by {angles} degrees")
print(f"{len(rows)} rows")
