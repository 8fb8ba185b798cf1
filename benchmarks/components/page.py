#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes a page of the documentation from the figures of hmps_bench.

Usage: page.py BENCHMARKS_JSON PAGE
"""

import json
import pathlib
import statistics
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "report"))
from pages import table, words, write  # noqa: E402

PAPER = "75200"
KINDS = ("float", "mixed", "double")


def read(path):
    """The medians (or single runs) by name, the description of the machine, and the scatter of the repetitions."""
    found = json.loads(pathlib.Path(path).read_text())
    runs, scatter = {}, []
    for run in found["benchmarks"]:
        if run["run_type"] == "iteration" or run.get("aggregate_name") == "median":
            runs[run["run_name"].removesuffix("/real_time").removesuffix("/repeats:1")] = run
        elif run.get("aggregate_name") == "cv":
            scatter.append(run["cpu_time"])
    return runs, found["context"], scatter


def processor():
    """The name of the processor, and that of its widest registers or None."""
    entries = (line.split(":", 1) for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines() if ":" in line)
    about = {key.strip(): value.strip() for key, value in entries}
    flags = about.get("flags", "").split()
    widest = next((name for name in ("AVX512F", "AVX2", "AVX", "SSE2") if name.lower() in flags), None)
    return about.get("model name", "an unnamed processor"), widest and widest.removesuffix("F").replace("AVX512", "AVX-512")


def machine():
    """The processor and its widest registers."""
    name, widest = processor()
    return name + (f" with {widest}" if widest else "")


def digits(value, count=3):
    """A number with `count` digits, without an exponent."""
    text = f"{float(f'{value:.{count}g}'):.10f}".rstrip("0").rstrip(".")
    return text if text else "0"


def size(particles):
    return f"{int(particles):,}"


class Page:
    def __init__(self, runs, context, scatter):
        self.runs, self.context, self.scatter = runs, context, scatter

    def rate(self, name):
        """Items per second in millions, or None if the benchmark was not run."""
        return self.runs[name]["items_per_second"] * 1e-6 if name in self.runs else None

    def nanoseconds(self, name):
        return 1e3 / self.rate(name)

    def peak(self, kind):
        return max(run["FLOP"] for name, run in self.runs.items() if name.startswith(f"roofline/fma/{kind}/"))

    def sizes(self, prefix):
        return sorted({int(name[len(prefix):].split("/")[0]) for name in self.runs if name.startswith(prefix)})

    def threads(self):
        return sorted({int(n.split("/")[-1]) for n in self.runs if n.startswith(f"step/box/float/{PAPER}/")})

    def preface(self):
        caches = "".join(f", L{c['level']} {c['size'] // 1024} KiB" for c in self.context["caches"]
                         if c["type"] != "Instruction")
        yield from [f"# What a step costs with {processor()[1]}", ""]
        yield from words("This page is written by `benchmarks/run`; nothing in it is typed by hand. Every component of "
                         "the library has benchmarks, which use Google Benchmark, in `benchmarks/hmps/<topic>/<header>"
                         ".bench.cpp`. They form one program, `hmps_bench`, which takes the arguments of Google "
                         "Benchmark (`benchmarks/run --benchmark_filter=step/box`). All figures of a run are in "
                         "`results/benchmarks/benchmarks.json`.")
        others = int(self.context.get("others_running", 0))
        yield from words(f"Compiled by {self.context.get('compiler', 'an unnamed compiler')} for this machine and run "
                         f"on {machine()}, {self.context['num_cpus']} cores{caches}. The figures are medians of "
                         f"processor times for one thread and of wall-clock times for several; searches and "
                         f"bonds of a million particles are measured once. When the run began, "
                         f"{others or 'no'} other process{'' if others == 1 else 'es'} kept the machine busy" +
                         (", so figures for several threads mean little." if others else ".") +
                         (f" The repetitions of a benchmark scatter by {100 * statistics.median(self.scatter):.0f} % "
                          "(standard deviation, median over all benchmarks)." if self.scatter else ""))

    def step(self):
        yield from ["## The whole step", ""]
        yield from words("A step of a box with elastic, artificial and viscous force, kick and drift, in million "
                         "particle-steps per second. Mixed means a state in double with kernels in float. Roofline is "
                         "the rate on one thread as a share of what multiply-adds and memory allow (see below). Bytes "
                         "are those that bonds and force keep, without the user's own state.")
        threads = self.threads()
        rows = []
        for kind in KINDS:
            for n in self.sizes(f"step/box/{kind}/"):
                run = self.runs[f"step/box/{kind}/{n}/1"]
                rates = [self.rate(f"step/box/{kind}/{n}/{t}") for t in threads]
                rows.append([kind, size(n), *[digits(r) for r in rates],
                             *[digits(r / rates[0], 2) for r in rates[1:]],
                             digits(rates[0] / self.rate(f"step/box/{kind}/{PAPER}/1"), 2),
                             f"{100 * run['roofline']:.0f} %", f"{run['memory']:.0f}"])
        yield from table(["Kind", "Particles", *[f"{t} thread{'s' if t > 1 else ''}" for t in threads],
                          *[f"{t} threads over 1" for t in threads[1:]], f"over that of {size(PAPER)} particles",
                          "Roofline", "Bytes per particle"], rows)

    def ratios(self):
        yield from ["## Compared with other code", ""]
        yield from words(f"The same step of {size(PAPER)} particles on one thread. The reference "
                         "(`benchmarks/hmps/force/reference.hpp`) uses bonds in compressed rows, small Eigen vectors "
                         "and two loops, with the same algebra and the same law; a test checks that it computes the "
                         "equations.")
        rows = []
        for label, name in (("lattice", "box"), ("list of bonds", "list"), ("reference", "reference")):
            row = [label]
            for kind in ("float", "double"):
                suffix = "" if name == "reference" else "/1"
                rate = self.rate(f"step/{name}/{kind}/{PAPER}{suffix}")
                row += [digits(rate), digits(rate / self.rate(f"step/reference/{kind}/{PAPER}"), 2)]
            rows.append(row)
        yield from table(["Bonds", "float, M/s", "over the reference", "double, M/s", "over the reference"], rows)
        one = {kind: self.rate(f"step/box/{kind}/{PAPER}/1") for kind in KINDS}
        yield from words(f"In the same time, float does {digits(one['float'] / one['double'], 2)} times and mixed "
                         f"{digits(one['mixed'] / one['double'], 2)} times the particle-steps of double.")
        thin = [(kind, *[f"step/thin/{kind}/{n}/1" for n in self.sizes(f"step/thin/{kind}/")]) for kind in KINDS]
        rows = [[kind, digits(self.rate(name)), digits(self.rate(name) / one[kind], 2),
                 f"{100 * self.runs[name]['lanes']:.0f} %", f"{100 * self.runs[f'step/box/{kind}/{PAPER}/1']['lanes']:.0f} %"]
                for kind, name in thin]
        particles = thin[0][1].split("/")[3]
        yield from words(f"In thin walls, few neighbours are consecutive: an offset takes several runs, and usually one window "
                         f"where the target picks lanes from two registers (AVX-512). At the faces, particles lack "
                         f"bonds, so that some lanes remain empty. The table is for half a hollow ball of "
                         f"{size(particles)} particles with a wall of three particles, on one thread.")
        yield from table(["Kind", "M/s", "over the box", "lanes that hold a bond", "such lanes in the box"], rows)

    def roofline(self):
        yield from ["## Limits of the machine", ""]
        yield from words("Three limits are measured on one core: multiply-adds in registers; memory, by a = b + s c "
                         "over working sets of three arrays; and neighbours, by reading 64 bytes from unaligned "
                         "addresses in the first-level cache, as bonds read the values of consecutive neighbours "
                         "(`benchmarks/components/roofline.hpp`).")
        rows = [[f"multiply-adds, {kind}", f"{self.peak(kind) * 1e-9:.0f} GFLOP/s"]
                for kind in ("float", "double")]
        rows += [[f"neighbours, {kind}", f"{self.runs[f'roofline/gather/{kind}']['bytes_per_second'] * 1e-9:.0f} GB/s"]
                 for kind in ("float", "double")]
        for n in self.sizes("roofline/triad/"):
            rows.append([f"memory, {size(n)} KiB",
                         f"{self.runs[f'roofline/triad/{n}']['bytes_per_second'] * 1e-9:.0f} GB/s"])
        yield from table(["Limit", "Rate"], rows)
        yield from words("The cost of a particle-step is counted from the equations and the arrays "
                         "(`benchmarks/components/cost.hpp`): the operations are those of the sums as they stand in "
                         "theory.md, whatever a kernel saves or wastes, and the bytes of each array count once per "
                         "pass. Roofline is the rate of particle-steps over the lower of the rates that multiply-adds "
                         "and memory (at the working set of the box) allow; neighbours is the share of the third "
                         "limit.")
        rows = []
        for kind in KINDS:
            for n in self.sizes(f"step/box/{kind}/"):
                run = self.runs[f"step/box/{kind}/{n}/1"]
                rate = run["items_per_second"]
                rows.append([kind, size(n), f"{run['FLOP'] / rate:.0f}", f"{run['bytes_per_second'] / rate:.0f}",
                             f"{run['FLOP'] * 1e-9:.0f} GFLOP/s", f"{run['bytes_per_second'] * 1e-9:.1f} GB/s",
                             f"{100 * run['roofline']:.0f} %", f"{100 * run['neighbours']:.0f} %"])
        yield from table(["Kind", "Particles", "FLOP", "Bytes", "Operations", "Traffic", "Roofline", "Neighbours"], rows)

    def parts(self):
        yield from ["## Where the time goes", ""]
        yield from words(f"Each part of the step run alone, with its own passes over the particles, for {size(PAPER)} "
                         "particles on one thread: nanoseconds per particle, and the share of the peak of "
                         "multiply-adds that the part reaches.")
        names = {"deformation gradient": "gradient/{}/" + PAPER + "/1", "stress of the law": "law/mooney_rivlin/{}",
                 "elastic force, with both": "elastic/{}/" + PAPER + "/1",
                 "artificial force, with the gradient": "artificial/{}/" + PAPER + "/1",
                 "viscous force": "viscous/{}/" + PAPER + "/1", "kick and drift": "euler/{}/" + PAPER + "/1",
                 "the whole step": "step/box/{}/" + PAPER + "/1"}
        rows = []
        for label, name in names.items():
            row = [label]
            for kind in ("float", "double"):
                run = self.runs[name.format(kind)]
                row += [digits(self.nanoseconds(name.format(kind))),
                        f"{100 * run['FLOP'] / self.peak(kind):.0f} %"]
            rows.append(row)
        yield from table(["Part", "float, ns", "of the peak", "double, ns", "of the peak"], rows)
        for kind in ("float", "double"):
            time = {label: self.nanoseconds(name.format(kind)) for label, name in names.items()}
            whole = time["the whole step"]
            second = time["elastic force, with both"] - time["deformation gradient"] - time["stress of the law"]
            apart = sum(time[k] for k in list(names)[2:6])
            run, box = self.runs[f"step/box/{kind}/{PAPER}/1"], self.sizes(f"step/box/{kind}/")[0]
            cached = self.nanoseconds(f"step/box/{kind}/{box}/1")
            yield from words(
                f"In {kind}, the three forces, kick and drift would take {digits(apart / whole, 2)} times as long one "
                f"after the other as they take together. Of the time of the step, the first sweep (bonds to F) takes "
                f"about {100 * time['deformation gradient'] / whole:.0f} %, the law "
                f"{100 * time['stress of the law'] / whole:.0f} %, the second sweep of the elastic force "
                f"{100 * second / whole:.0f} %, and kick and drift {100 * time['kick and drift'] / whole:.0f} %. "
                f"{100 * (1 - run['lanes']):.1f} % of the lanes of its rows hold no bond. Data that do not fit "
                f"into the nearest caches cost {100 * (1 - cached / whole):.0f} %: a box of {size(box)} "
                f"particles takes that much less time per particle. The bonds read their neighbours at "
                f"{100 * run['neighbours']:.0f} % of the rate that the core allows for reading alone.")

    def setup(self):
        yield from ["## Set-up", ""]
        yield from words("Time to fill the lattice, find the bonds and invert A, on one thread, with kernels in "
                         "double.")
        sizes = self.sizes("setup/")
        rows = [[size(n), digits(n / self.rate(f"setup/{n}") * 1e-6), digits(1 / self.rate(f"setup/{n}"), 3)]
                for n in sizes]
        yield from table(["Particles", "Seconds", "Microseconds per particle"], rows)

    def components(self):
        yield from ["## All components", ""]
        yield from words("Million items per second. The items are particles; in `contact` they are slaves, in "
                         "`metaball` pairs, and in `fill` sites of the lattice. The comments at the top of the files "
                         "in `benchmarks/hmps` say what each benchmark does. GFLOP/s and GB/s are given where "
                         "operations and bytes are counted.")
        rows = []
        for name in sorted(self.runs, key=lambda n: [(0, int(p), "") if p.isdigit() else (1, 0, p) for p in n.split("/")]):
            run = self.runs[name]
            if name.startswith(("roofline/", "step/", "setup/")):
                continue
            flop, moved = run.get("FLOP"), run.get("bytes_per_second")
            rows.append([f"`{name}`", digits(self.rate(name)), digits(flop * 1e-9) if flop else "",
                         digits(moved * 1e-9) if moved else ""])
        yield from table(["Benchmark", "M items/s", "GFLOP/s", "GB/s"], rows)

    def lines(self):
        for part in (self.preface, self.step, self.ratios, self.roofline, self.parts, self.setup, self.components):
            yield from part()


def main():
    write(pathlib.Path(sys.argv[2]), Page(*read(sys.argv[1])).lines())


if __name__ == "__main__":
    main()
