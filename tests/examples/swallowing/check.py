# SPDX-License-Identifier: MIT
"""Checks that the swallow refuses what it cannot do: at once, with exit code 2 and a message that names it.

Usage: check.py PROGRAM
"""
import pathlib
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


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    file = folder / "file"
    file.write_text("in the way")
    refused(["--speed", "11"], "--speed")
    refused(["--spacing", "2.4", "--out", folder / "a"], "--spacing", "2.4e-3")
    refused(["--case", "Z1", "--out", folder / "a"], "--case", "Z1")
    refused(["--data", folder / "none", "--out", folder / "a"], "--data", folder / "none")
    if (folder / "a").exists():
        sys.exit("a refused run made its output folder")
    refused(["--out", file], file, "--out")
    refused(["--out", file / "below"], file / "below", "--out")

    run = ["--case", "X1", "--until", "0.002", "--no-frames", "--out", folder / "run"]
    subprocess.run([program, *map(str, run)], check=True, capture_output=True, timeout=300)
    refused([*run, "--resume", "--friction", "0.25"], "checkpoint.bin", "friction", "--resume")
    refused([*run, "--resume", "--scalar", "double"], "scalar", "float", "double")
    fast = ["--case", "X1", "--until", "0.0005", "--no-frames", "--out", folder / "fast", "--time-step", "4.5e-5"]
    warned = subprocess.run([program, *map(str, fast)], check=True, capture_output=True, text=True, timeout=300)
    if "beyond the limit" not in warned.stderr or "esophagus" not in warned.stderr:
        sys.exit(f"a step beyond the limit went without a warning: {warned.stderr}")
    checkpoint = folder / "run/X1/checkpoint.bin"
    data = bytearray(checkpoint.read_bytes())
    data[len(data) // 2] ^= 1
    checkpoint.write_bytes(data)
    refused([*run, "--resume"], "checkpoint.bin", "damaged", "--resume")
print("all refused")
