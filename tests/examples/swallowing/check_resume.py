# SPDX-License-Identifier: MIT
"""Kills the swallow twice, resumes it, and compares it to the bit with a run that nobody disturbed.

Usage: check_resume.py PROGRAM. Ends with 1 and a message at the first difference.
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import time

program = sys.argv[1]
SETTINGS = ["--case", "X1", "--until", "0.045", "--frame-interval", "0.015"]  # a checkpoint comes every 0.02 s
MEASURED = ("wall_seconds", "particle_steps_per_second", "contact_share", "contact_share_per_tenth", "threads")


def command(out, *options):
    return [program, *SETTINGS, "--out", str(out), *options]


def run(out, *options):
    subprocess.run(command(out, *options), check=True, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)


def kill_behind_checkpoint(out, age, *options):
    """Starts the program and kills it `age` seconds after it wrote its next checkpoint."""
    checkpoint = out / "X1/checkpoint.bin"
    before = checkpoint.stat().st_mtime_ns if checkpoint.exists() else None
    with subprocess.Popen(command(out, *options), stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL) as process:
        while process.poll() is None and (not checkpoint.exists() or checkpoint.stat().st_mtime_ns == before):
            time.sleep(0.001)
        time.sleep(age)
        if process.poll() is not None:
            sys.exit("the run ended before it was killed: nothing was tested")
        process.kill()


def results(out):
    """All that a run leaves, without what it measured of the machine."""
    folder = out / "X1"
    found = {str(f.relative_to(folder)): f.read_bytes() for f in folder.rglob("*")
             if f.suffix in (".csv", ".pvd", ".vtu", ".png") or f.parent.name == "snapshots"}
    state = (folder / "checkpoint.bin").read_bytes()
    found["checkpoint.bin"] = state[:state.rindex(b"seconds")]
    summary = json.loads((folder / "summary.json").read_text())
    return found | {key: value for key, value in summary.items() if key not in MEASURED}


def compare(what, whole, other):
    a, b = results(whole), results(other)
    different = sorted(name for name in a.keys() | b.keys() if a.get(name) != b.get(name))
    if different:
        sys.exit(f"{what}: {different} differ")
    print(f"{what}: {len(a)} results are the same to the bit", flush=True)


with tempfile.TemporaryDirectory() as name:
    alone, killed = pathlib.Path(name) / "alone", pathlib.Path(name) / "killed"
    run(alone, "--threads", "1")
    kill_behind_checkpoint(killed, 0.0, "--threads", "2")
    kill_behind_checkpoint(killed, 0.02, "--threads", "1", "--resume")
    # What a kill may leave: half a line of the series, half a file beside a whole one.
    with open(killed / "X1/series.csv", "ab") as series:
        series.write(b"0.0412,63.")
    (killed / "X1/checkpoint.bin.part").write_bytes(b"half")
    run(killed, "--threads", "2", "--resume")
    (killed / "X1/checkpoint.bin.part").unlink(missing_ok=True)
    compare("killed twice, resumed with another number of threads", alone, killed)
    run(killed, "--resume")
    compare("resumed at its end", alone, killed)
