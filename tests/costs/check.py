#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks, by counts, that what a scene leaves out costs nothing, and that what it does not leave out does not grow.

Usage: check.py FOLDER_OF_THE_PROGRAMS [DOCUMENT COMPILER INCLUDES...]

Runs the scenes of scene.cpp and alone.cpp under callgrind, for four and for twelve steps: the difference is what a step
executes. With DOCUMENT that page is written, with the compile times of both programs. Exit code 77: not here.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "benchmarks" / "report"))
from pages import bullets, table, words, write  # noqa: E402

SKIPPED = 77
STEPS = (4, 12)
SCENES = {
    "alone": "elastic force, in a program that uses nothing else",
    "elastic": "elastic force",
    "elastic_artificial": "elastic force and stabiliser",
    "all_terms": "all three forces: elastic, stabiliser, viscous",
    "recorded": "all three, deformation gradients recorded",
    "viscous_alone": "viscous force alone",
    "all_terms_float": "all three, sweeps in float",
    "all_terms_2d": "all three, in two dimensions",
    "halves": "two bodies, all three, deformation gradients recorded, no contact",
    "halves_far": "the same, contact declared but out of reach",
    "halves_touching": "the same, the bodies meeting at 1 m/s",
    "region_unrestricted": "all three, half of the body in a control region",
    "region": "the same, force restricted to the other half",
    "search_tree": "all neighbours of all particles by the k-d tree, instead of a step",
    "search_grid": "the same by the grid",
}

# Flags that users compile with, of which the page tells what they give.
FLAGS = ("-O2", "-O3", "-O2 -mavx2 -mfma", "-O3 -mavx2 -mfma")

# What a step (of contact: its part) or a search of the scenes executes per particle, as this script found it when the
# kernel was last changed on purpose, compiled by HELD_COMPILER. Another compiler makes other code, so that nothing is
# held then. A kernel may become cheaper at any time, dearer only on purpose, with a new number here.
HELD_COMPILER = "g++ 12"
HELD = {"all_terms": 1616, "all_terms_float": 893, "contact": 709, "search_tree": 6497, "search_grid": 2033}
# The counts are exact, but a patch release of the compiler or another C library moves them a little.
MARGIN = 0.03


def run(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} failed:\n{done.stderr}")
    return done


def measure(folder, scene):
    """Instructions of a step and bytes of the components, each per particle."""
    program = ["costs.alone"] if scene == "alone" else ["costs.scene", scene]
    program[0] = str(folder / program[0])
    counts = []
    for steps in STEPS:
        done = run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *program, str(steps)])
        counts.append(int(re.search(r"Collected : (\d+)", done.stderr).group(1)))
    particles, size = (int(word) for word in done.stdout.split())
    contacts = re.search(r"(\d+) contacts", done.stderr)
    return {
        "instructions": (counts[1] - counts[0]) / (STEPS[1] - STEPS[0]) / particles,
        "bytes": size / particles,
        "contacts": int(contacts.group(1)) if contacts else 0,
    }


def bounds(m):
    """Pairs of what must hold, and whether it does."""
    def count(scene):
        return m[scene]["instructions"]

    def size(scene):
        return m[scene]["bytes"]

    yield "a program with one force alone executes as much as that force in a program with all, within 0.5 %", (
        abs(count("alone") / count("elastic") - 1) < 0.005)
    yield "a program with one force alone takes the same memory", abs(size("alone") - size("elastic")) < 1
    yield "without the stabiliser, fewer instructions are executed", count("elastic") < count("elastic_artificial")
    yield "without viscosity, fewer instructions are executed", count("elastic_artificial") < count("all_terms")
    yield "without viscosity, no velocities are kept: 3 numbers less per particle", (
        size("all_terms") - size("elastic_artificial") >= 3 * 8)
    yield "the stabiliser takes no memory", abs(size("elastic_artificial") - size("elastic")) < 1
    yield "without recording, fewer instructions are executed", count("all_terms") < count("recorded")
    yield "viscosity alone skips the first sweep: less than a third of the instructions", (
        count("viscous_alone") < count("all_terms") / 3)
    yield "in two dimensions, a particle takes less than a third of the instructions", (
        count("all_terms_2d") < count("all_terms") / 3)
    yield "in two dimensions, a particle takes less than two thirds of the memory", (
        size("all_terms_2d") < size("all_terms") * 2 / 3)
    yield "sweeps in float take less than two thirds of the instructions", (
        count("all_terms_float") < count("all_terms") * 2 / 3)
    yield "sweeps in float take less than two thirds of the memory", (
        size("all_terms_float") < size("all_terms") * 2 / 3)
    yield "contact out of reach takes less than 60 instructions per particle", (
        count("halves_far") < count("halves") + 60)
    yield "contact out of reach takes less than 10 bytes per particle", size("halves_far") < size("halves") + 10
    yield "bodies that meet are in contact", m["halves_touching"]["contacts"] > 0
    yield "contact between bodies that meet costs more than contact out of reach", (
        count("halves_far") < count("halves_touching"))
    yield "particles deep in a control region cost nothing: less than two thirds with half of them in it", (
        count("region") < count("region_unrestricted") * 2 / 3)


def growth(m, compiler):
    """The same for the hot kernels, by the numbers above."""
    found = {scene: m[scene]["instructions"] for scene in m}
    found["contact"] = found["halves_touching"] - found["halves"]
    if not compiler.startswith(HELD_COMPILER):
        print(f"growth is not checked: this is {compiler}, the counts are of {HELD_COMPILER}")
        return
    for scene, held in HELD.items():
        print(f"{scene:20} {found[scene]:8.1f} instructions, held at {held}")
        text = SCENES.get(scene, "contact of the bodies that meet")
        yield f"no growth ({HELD_COMPILER}): {text}: at most {100 * MARGIN:.0f} % more than {held:,} instructions", (
            found[scene] <= held * (1 + MARGIN))


def compile_source(compiler, includes, flags, source, program):
    """Compiles `source` of this folder to `program`; returns the seconds that it took."""
    here = pathlib.Path(__file__).resolve().parent
    start = time.monotonic()
    run([compiler, "-std=c++20", *flags.split(), *[f"-I{path}" for path in includes], str(here / source), "-o", program])
    return time.monotonic() - start


def page(m, held, compiler, includes):
    yield from ["# What you do not use costs nothing", ""]
    yield from words("This page is written by `benchmarks/stability/run`; nothing in it is typed by hand. The test `costs` "
                     "checks the bounds below, by counts and not by times.")
    yield from words("The cost of a step of about 1,000 particles (10 x 10 x 10, in two dimensions 32 x 32), in double "
                     "unless stated otherwise, on one core. Instructions are counted by callgrind, for code compiled with "
                     "`-O2 -ftree-vectorize -mavx2 -mfma`, and include kick and drift; bytes are what the "
                     "components keep on the heap, without the user's own state.")
    yield from table(["Scene", "Instructions per particle and step", "Bytes per particle"],
                     [[text, f"{m[scene]['instructions']:,.0f}", f"{m[scene]['bytes']:.0f}"]
                      for scene, text in SCENES.items()])
    yield from ["What the test checks:", ""]
    yield from bullets(held)
    yield from words("The effect of compiler flags: instructions of all three forces per particle and step, counted in the "
                     "same way. The kernels work on 64 bytes of particles at a time, in as many registers as that takes; "
                     "`-march=native` uses the widest registers of the machine.")
    rows, seconds = [], {}
    with tempfile.TemporaryDirectory() as folder:
        seconds["alone"] = compile_source(compiler, includes, FLAGS[0], "alone.cpp", f"{folder}/costs.alone")
        for flags in FLAGS:
            took = compile_source(compiler, includes, f"{flags} -DNDEBUG", "scene.cpp", f"{folder}/costs.scene")
            seconds.setdefault("scene", took)
            double, single = (measure(pathlib.Path(folder), name) for name in ("all_terms", "all_terms_float"))
            rows.append([f"`{flags}`", f"{double['instructions']:,.0f}", f"{single['instructions']:,.0f}"])
    yield from table(["Compiled with", "double", "float"], rows)
    first = run([compiler, "--version"]).stdout.splitlines()[0]
    yield from words(f"Compiling with `{FLAGS[0]}` took {seconds['alone']:.1f} s for the program with one force and "
                     f"{seconds['scene']:.1f} s for that with all scenes, which includes the whole library (wall-clock "
                     f"time, {first}; the test does not check this).")


def main():
    if shutil.which("valgrind") is None:
        print("costs are not checked: valgrind is missing")
        sys.exit(SKIPPED)
    processor = pathlib.Path("/proc/cpuinfo")
    if not processor.exists() or not re.search(r"avx2.*fma|fma.*avx2", processor.read_text()):
        print("costs are not checked: this machine has no AVX2 and FMA, or does not tell")
        sys.exit(SKIPPED)
    folder = pathlib.Path(sys.argv[1])
    m = {scene: measure(folder, scene) for scene in SCENES}
    for scene, found in m.items():
        print(f"{scene:20} {found['instructions']:8.1f} instructions {found['bytes']:6.1f} bytes")
    compiler = run([str(folder / "costs.scene"), "compiler", "0"]).stdout.strip()
    checked = list(bounds(m)) + list(growth(m, compiler))
    broken = [text for text, holds in checked if not holds]
    if len(sys.argv) > 3:
        write(pathlib.Path(sys.argv[2]), page(m, [text for text, _ in checked], sys.argv[3], sys.argv[4:]))
    for text in broken:
        print(f"does not hold: {text}")
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
