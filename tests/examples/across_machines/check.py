#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks examples/across_machines: the same bits on any number of ranks, also resumed on another number; clear errors.

Usage: check.py PROGRAM
"""

import os
import pathlib
import re
import signal
import struct
import subprocess
import sys
import tempfile
import time

program = sys.argv[1]
temporary = tempfile.TemporaryDirectory()  # removed at the end of the program
folder = pathlib.Path(temporary.name)
PARTICLES, STEPS = 2500, 250


def command(ranks, out, *more):
    options = {"--particles": PARTICLES, "--steps": STEPS, "--every": 50, "--out": folder / out}
    more = list(more)
    while len(more) > 1 and not str(more[1]).startswith("--"):  # in place of those above
        option = more.pop(0)
        options[option] = more.pop(0)
    settings = [str(word) for option in options.items() for word in option]
    return ["mpirun", "--oversubscribe", "--allow-run-as-root", "-n", str(ranks), program, *settings, *more]


def run(ranks, out, *more):
    return subprocess.run(command(ranks, out, *more), capture_output=True, text=True, timeout=600)


def state_of(ranks, out, *more):
    done = run(ranks, out, *more)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "late" not in done.stdout, done.stdout
    return (folder / out).read_bytes(), done.stdout


def last_number(pattern, text):
    return int(re.findall(pattern, text)[-1])


def touching(text):
    return last_number(r"(\d+) particles feel contact", text)


def same_bits():
    """Contact acts, has been surveyed anew on the way, and nothing depends on the number of ranks."""
    plain, _ = state_of(1, "plain", "--plain")
    for ranks in (1, 2, 3, 4, 7):
        state, text = state_of(ranks, f"ranks{ranks}")
        assert state == plain, f"{ranks} ranks give other bits than a plain run"
        assert touching(text) > 20, text
        assert last_number(r"after (\d+) surveys", text) >= 2, text
    # A rank without contact goes on.
    state, text = state_of(16, "ranks16", "--steps", "50")
    assert last_number(r"(\d+) ranks have none", text) > 0, text
    assert state == state_of(1, "fifty", "--steps", "50", "--plain")[0]
    other, _ = state_of(2, "other", "--time-step", "1.9e-5")
    assert other != plain, "the comparison cannot fail"
    return plain


def step_of(state):
    """The step in the header of a checkpoint, behind its name, the order of bytes, and two settings."""
    return struct.unpack_from("=Q", state, 48)[0]


def killed_and_resumed():
    """A rank dies: the run ends with an error, and what was written lets another number of ranks go on."""
    out = folder / "killed"
    run_of_three = subprocess.Popen(command(3, "killed", "--steps", "1000000"), stdout=subprocess.PIPE,
                                    stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 300
    while not out.exists():
        assert run_of_three.poll() is None and time.monotonic() < deadline, run_of_three.communicate()
        time.sleep(0.05)
    children = pathlib.Path(f"/proc/{run_of_three.pid}/task/{run_of_three.pid}/children").read_text().split()
    ranks = [int(c) for c in children if pathlib.Path(f"/proc/{c}/comm").read_text().startswith("across_machines"[:15])]
    assert len(ranks) == 3, children
    os.kill(ranks[1], signal.SIGKILL)
    _, errors = run_of_three.communicate(timeout=60)
    assert run_of_three.returncode != 0
    assert "signal 9 (Killed)" in errors, errors
    step = step_of(out.read_bytes())
    assert step > 0 and step % 50 == 0, step
    on_two, _ = state_of(2, "killed", "--steps", step + 10, "--resume")
    assert step_of(on_two) == step + 10
    plain, _ = state_of(1, "not_killed", "--steps", step + 10, "--plain")
    assert on_two == plain, f"a run that was killed after step {step} and resumed has other bits"


def resumed(whole):
    state_of(4, "resumed", "--steps", "90")
    on_two, _ = state_of(2, "resumed", "--steps", "170", "--resume")
    assert on_two != whole
    on_seven, _ = state_of(7, "resumed", "--resume")
    assert on_seven == whole, "a run resumed on another number of ranks has other bits"


def refused():
    def says(done, *words):
        assert done.returncode != 0
        for word in words:
            assert word in done.stderr, (word, done.stderr)

    before = (folder / "resumed").read_bytes()
    says(run(3, "resumed", "--time-step", "1e-5", "--resume"), "rank 0", "resume with the same settings")
    says(run(2, "nothing", "--resume"), "rank 0", "cannot read")
    for ranks, plain in ((2, []), (1, ["--plain"])):
        says(run(ranks, "resumed", "--steps", "100", "--resume", *plain), "is of step 250, which is beyond --steps 100")
    assert (folder / "resumed").read_bytes() == before
    damaged = bytearray(before)
    damaged[1000] ^= 1
    (folder / "damaged").write_bytes(damaged)
    says(run(2, "damaged", "--resume"), "damaged: its checksum")
    says(run(3, "resumed", "--resume", "--plain"), "--plain is for one rank")
    assert (folder / "resumed").read_bytes() == before
    # A run that becomes unstable after it has resumed; what was written stays.
    short, _ = state_of(3, "unstable", "--time-step", "1e-4", "--steps", "2")
    says(run(2, "unstable", "--time-step", "1e-4", "--resume"), "rank", "try a smaller time step")
    assert (folder / "unstable").read_bytes() == short
    says(run(2, "fast", "--time-step", "1e-3"), "surface particle", "in a step, but contact", "try a smaller time step")


whole = same_bits()
resumed(whole)
killed_and_resumed()
refused()
print("the same bits on 1, 2, 3, 4 and 7 ranks, resumed on other numbers, and clear errors")
