# SPDX-License-Identifier: MIT
"""Kills a run of the swallow behind its first checkpoint, resumes it with another number of threads, and
compares every result, bit by bit, with that of a run that was left alone.

Usage: kill_and_resume.py PROGRAM FOLDER
"""
import json
import pathlib
import shutil
import signal
import subprocess
import sys
import time

program, out = sys.argv[1], pathlib.Path(sys.argv[2])
shutil.rmtree(out, ignore_errors=True)


def command(name, *more):
    return [program, "--case", "X1", "--until", "0.05", "--out", str(out / name), *more]


def results(name):
    folder = out / name / "X1"
    found = {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.suffix in
             (".csv", ".vtu", ".pvd", ".png")}
    summary = json.loads((folder / "summary.json").read_text())
    for measured in ("wall_seconds", "particle_steps_per_second", "contact_share", "threads"):
        summary.pop(measured)
    return found | {"summary.json": summary}


subprocess.run(command("alone", "--threads", "2"), check=True)

run = subprocess.Popen(command("killed", "--threads", "1"))
while run.poll() is None and not (out / "killed" / "X1" / "checkpoint.bin").exists():
    time.sleep(0.001)
run.send_signal(signal.SIGKILL)
if run.wait() != -signal.SIGKILL:
    sys.exit("the run ended before it was killed: nothing was tested")
subprocess.run(command("killed", "--threads", "2", "--resume"), check=True)

alone, killed = results("alone"), results("killed")
different = [name for name in sorted(alone.keys() | killed.keys()) if alone.get(name) != killed.get(name)]
if different:
    sys.exit(f"a resumed run differs in {different}")
print(f"{len(alone)} files are the same")
