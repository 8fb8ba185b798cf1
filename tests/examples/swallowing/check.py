# SPDX-License-Identifier: MIT
"""Checks that the swallow refuses what it cannot do: at once, with exit code 2 and a message that names it.

Usage: check.py PROGRAM
"""
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

program = sys.argv[1]


def refused(options, *parts):
    result = subprocess.run([program, *map(str, options)], capture_output=True, text=True, timeout=60, check=False)
    if result.returncode != 2:
        sys.exit(f"{options} ended with {result.returncode}: {result.stderr}")
    for part in parts:
        if str(part) not in result.stderr:
            sys.exit(f"the message for {options} does not name {part}: {result.stderr}")


def lost(options, stream):
    """Output that does not arrive is an error, and goes nowhere else."""
    line = " ".join(shlex.quote(str(part)) for part in (program, *options))
    result = subprocess.run(f"{line} {stream}", shell=True, capture_output=True, text=True, timeout=300, check=False)
    if result.returncode != 3 or (not stream.startswith("2") and "standard output" not in result.stderr):
        sys.exit(f"{line} {stream} ended with {result.returncode}: {result.stderr}")


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    file = folder / "file"
    file.write_text("in the way")
    refused(["--speed", "11"], "--speed")
    refused(["--spacing", "2.4", "--out", folder / "a"], "--spacing", "2.4e-3")
    refused(["--until", "0x1", "--out", folder / "a"], "--until", "decimal")
    refused(["--threads", "1000", "--out", folder / "a"], "--threads", "processor")
    refused(["--case", "Z1", "--out", folder / "a"], "--case", "Z1")
    refused(["--data", folder / "none", "--out", folder / "a"], "--data", folder / "none")
    if (folder / "a").exists():
        sys.exit("a refused run made its output folder")
    refused(["--out", file], file, "--out")
    refused(["--out", file / "below"], file / "below", "--out")

    run = ["--case", "X1", "--until", "0.002", "--no-frames", "--out", folder / "run"]
    subprocess.run([program, *map(str, run)], check=True, capture_output=True, timeout=300)
    if not (folder / "run/X1/surfaces.png").exists() or (folder / "run/X1/surfaces.pvd").exists():
        sys.exit("without frames, the surfaces should be drawn but not written for ParaView")
    short = ["--case", "X1", "--until", "0.0005", "--no-frames", "--no-surfaces"]
    for number, stream in enumerate((">/dev/full", ">&-", "2>&-")):
        lost([*short, "--out", folder / f"lost{number}"], stream)
    if (folder / "lost0/X1/surfaces.png").exists():
        sys.exit("surfaces were drawn in spite of --no-surfaces")
    series = [(folder / f"lost{number}/X1/series.csv").read_bytes() for number in range(3)]
    if len(set(series)) > 1 or not series[0].startswith(b"time,"):
        sys.exit("what was to go to a closed stream went into series.csv")
    lost(["--help"], ">/dev/full")

    # The table holds no case of other settings.
    table = folder / "run/table2.md"
    other = ["--case", "Y3", "--until", "0.0005", "--no-frames", "--no-surfaces", "--out", folder / "run",
             "--friction", "0.2"]
    subprocess.run([program, *map(str, other)], check=True, capture_output=True, timeout=300)
    if "Case X1 was run with other settings: friction of the case in place of 0.2" not in table.read_text():
        sys.exit(f"table2.md mixes runs of different settings: {table.read_text()}")

    refused([*run, "--resume", "--friction", "0.25"], "checkpoint.bin", "friction", "--resume")
    refused([*run, "--resume", "--scalar", "double"], "scalar", "float", "double")
    fast = ["--case", "X1", "--until", "0.0005", "--no-frames", "--no-surfaces", "--out", folder / "fast",
            "--time-step", "4.5e-5"]
    warned = subprocess.run([program, *map(str, fast)], check=True, capture_output=True, text=True, timeout=300)
    if "beyond the limit" not in warned.stderr or "esophagus" not in warned.stderr:
        sys.exit(f"a step beyond the limit went without a warning: {warned.stderr}")
    # Every control region tells its particles.
    if not re.search(r"control regions: fixed [1-9]\d*, B0 [1-9]\d*, .*, A [1-9]\d*, .*H [1-9]\d*\n", warned.stderr):
        sys.exit(f"the particles of the control regions are not told: {warned.stderr}")
    checkpoint = folder / "run/X1/checkpoint.bin"
    data = bytearray(checkpoint.read_bytes())
    data[len(data) // 2] ^= 1
    checkpoint.write_bytes(data)
    refused([*run, "--resume"], "checkpoint.bin", "damaged", "--resume")
print("all refused")
