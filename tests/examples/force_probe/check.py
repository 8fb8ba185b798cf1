# SPDX-License-Identifier: MIT
"""Checks examples/force_probe against the paper's equations, written here a second time, pair by pair.

Usage: check.py PROGRAM. Ends with 1 and a message at the first difference.
"""
import csv
import math
import os
import pathlib
import random
import shlex
import subprocess
import sys
import tempfile

SPACING, YOUNG, D1, DENSITY, VISCOSITY, FRICTION, STEP = 1.2e-3, 20e3, 1e6, 1000.0, 2e-3, 0.3, 1e-5
YOUNG_HAT, PENALTY_RATIO, RADIUS = 12e3, 0.3, 1.75 * 1.2e-3
AXES = range(3)


# Small linear algebra.
def add(a, b):
    return [p + q for p, q in zip(a, b)]


def sub(a, b):
    return [p - q for p, q in zip(a, b)]


def scale(s, a):
    return [s * p for p in a]


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def norm(a):
    return math.sqrt(dot(a, a))


def outer(a, b):
    return [[p * q for q in b] for p in a]


def madd(A, B):
    return [add(a, b) for a, b in zip(A, B)]


def mscale(s, A):
    return [scale(s, a) for a in A]


def transpose(A):
    return [list(column) for column in zip(*A)]


def matmul(A, B):
    return [[dot(a, b) for b in transpose(B)] for a in A]


def apply(A, a):
    return [dot(row, a) for row in A]


def det(A):
    (a, b, c), (d, e, f), (g, h, i) = A
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def inverse(A):
    (a, b, c), (d, e, f), (g, h, i) = A
    cofactor = [[e * i - f * h, c * h - b * i, b * f - c * e], [f * g - d * i, a * i - c * g, c * d - a * f],
                [d * h - e * g, b * g - a * h, a * e - b * d]]
    return mscale(1 / det(A), cofactor)


IDENTITY = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]


# The paper.
def weight(r):  # eq. 8
    return RADIUS / r - 1 if 0 < r <= RADIUS * (1 + 1e-12) else 0.0


def second_piola_kirchhoff(F):  # eqs 14 to 18, C1 = C2
    C = matmul(transpose(F), F)
    J = det(F)
    c = YOUNG / 12
    trace = C[0][0] + C[1][1] + C[2][2]
    square = matmul(C, C)
    I1, I2 = trace, 0.5 * (trace**2 - square[0][0] - square[1][1] - square[2][2])
    inverse_c = inverse(C)
    S = [[0.0] * 3 for _ in AXES]
    for a in AXES:
        for b in AXES:
            d_i1 = J**(-2 / 3) * (IDENTITY[a][b] - I1 / 3 * inverse_c[a][b])
            d_i2 = J**(-4 / 3) * (I1 * IDENTITY[a][b] - C[a][b] - 2 * I2 / 3 * inverse_c[a][b])
            d_volume = 2 * D1 * (J - 1) * J / 2 * inverse_c[a][b]
            S[a][b] = 2 * (c * d_i1 + c * d_i2 + d_volume)
    return S


def internal_forces(X, x, v, body):
    n = len(X)
    bonds = [[(j, sub(X[j], X[i]), weight(norm(sub(X[j], X[i])))) for j in range(n)
              if j != i and body[j] == body[i] and weight(norm(sub(X[j], X[i]))) > 0] for i in range(n)]
    F, A_inverse, P, art = [], [], [], []
    for i in range(n):
        A = [[0.0] * 3 for _ in AXES]
        B = [[0.0] * 3 for _ in AXES]
        moment = 0.0
        for j, r0, w in bonds[i]:
            A = madd(A, mscale(w, outer(r0, r0)))  # eq. 12
            B = madd(B, mscale(w, outer(sub(x[j], x[i]), r0)))
            moment += dot(r0, r0) * w
        A_inverse.append(inverse(A))
        F.append(matmul(B, A_inverse[i]))  # eq. 11
        P.append(matmul(F[i], second_piola_kirchhoff(F[i])))  # eq. 7
        art.append(YOUNG_HAT * 3 / moment)  # eq. 20
    lattice = [(a, b, c) for a in (-1, 0, 1) for b in (-1, 0, 1) for c in (-1, 0, 1) if (a, b, c) != (0, 0, 0)]
    lambda_n0 = sum(dot(o, o) * (1.75 / norm(o) - 1) for o in lattice) * SPACING**2
    elastic, artificial, viscous = [], [], []
    for i in range(n):
        f_elastic, f_artificial, f_viscous = [0.0] * 3, [0.0] * 3, [0.0] * 3
        for j, r0, w in bonds[i]:
            r = sub(x[j], x[i])
            pull = add(apply(matmul(P[i], A_inverse[i]), r0), apply(matmul(P[j], A_inverse[j]), r0))
            f_elastic = add(f_elastic, scale(w, pull))  # eq. 13
            error = add(scale(art[i], sub(r, apply(F[i], r0))), scale(art[j], sub(r, apply(F[j], r0))))
            f_artificial = add(f_artificial, scale(w, error))  # eq. 19
            f_viscous = add(f_viscous, scale(w * DENSITY * VISCOSITY * 6 / lambda_n0, sub(v[j], v[i])))  # eq. 21
        elastic.append(f_elastic)
        artificial.append(f_artificial)
        viscous.append(f_viscous)
    return F, elastic, artificial, viscous


def normal_density(y):  # eq. 27 over spacings, averaged along the wall: a layer at h gives pi (R^2 - h^2)^2 / 2 R^2
    return sum(math.pi * max(0.0, 1.75**2 - (y + k)**2)**2 / (2 * 1.75**2) for k in range(6) if abs(y + k) < 1.75)


def distance_of(density):  # eq. 29 by bisection
    low, high = -0.5, 1.75
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if normal_density(middle) > density else (low, middle)
    return 0.5 * (low + high) * SPACING


def contact_forces(x, v, F, body, friction):  # eqs 22 to 43 with the cap of eq. 40 as printed
    n = len(x)
    k = PENALTY_RATIO * DENSITY / STEP**2
    inverses = [inverse(f) for f in F]
    force = [[0.0] * 3 for _ in range(n)]
    touching = 0
    for i in range(n):
        for wall in set(body) - {body[i]}:
            balls = []
            for j in range(n):
                if body[j] == wall:
                    y = apply(inverses[j], sub(x[j], x[i]))
                    if norm(y) < RADIUS:
                        balls.append((j, 1 - dot(y, y) / RADIUS**2, apply(transpose(inverses[j]), y)))
            C = sum(c for _, c, _ in balls)  # eq. 28
            if not C > 0:
                continue
            gradient = [sum(2 / RADIUS**2 * g[a] for _, _, g in balls) for a in AXES]
            normal = scale(-1 / norm(gradient), gradient)  # eq. 30
            mean = [[0.0] * 3 for _ in AXES]
            slip = [0.0] * 3
            for j, c, _ in balls:
                mean = madd(mean, mscale(c / C, inverses[j]))  # eq. 33
                slip = add(slip, scale(c / C, sub(v[j], v[i])))  # eq. 31
            strain = 1 / norm(apply(mean, normal))  # eq. 32
            r_im = strain * distance_of(C) - strain * SPACING / 2  # eqs 34 to 36
            # eqs 37, 38: the farthest point of the ellipsoid F_i s, |s| = l0 / 2, along -n, by search.
            reach = apply(transpose(F[i]), normal)
            r_i = max(-dot(normal, apply(F[i], scale(-SPACING / 2 / norm(reach), reach))), 0.0)
            p = r_i - r_im
            if not p > 0:
                continue
            touching += 1
            f = scale(k * p, normal)  # eq. 39
            tangential = sub(slip, scale(dot(slip, normal), normal))  # eq. 24
            speed = norm(tangential)
            if speed > 0:
                f = add(f, scale(min(DENSITY * speed / STEP, friction * k * p) / speed, tangential))  # eq. 40
            force[i] = add(force[i], f)
            for j, c, _ in balls:
                force[j] = sub(force[j], scale(c / C, f))  # eqs 41, 42
    return force, touching


# The comparison.
def scene():
    """Two jittered blocks, one pressed into the other, and a third that hangs by a corner."""
    generator = random.Random(20170)
    jitter = lambda size: [generator.uniform(-size, size) for _ in AXES]
    X, x, v, body = [], [], [], []
    for number, (shape, origin, shift) in enumerate([((5, 4, 3), (0, 0, 0), (0, 0, 0)),
                                                     ((4, 4, 3), (0.3, 0.2, 3.0), (0, 0, -0.25)),
                                                     ((3, 3, 3), (4.9, 0.4, 2.6), (0, 0, -0.2))]):
        for a in range(shape[0]):
            for b in range(shape[1]):
                for c in range(shape[2]):
                    reference = scale(SPACING, add(origin, (a, b, c)))
                    X.append(reference)
                    x.append(add(add(reference, scale(SPACING, shift)), jitter(0.03 * SPACING)))
                    v.append(jitter(0.05))
                    body.append([7, -2, 3][number])
    return X, x, v, body


def run(program, folder, state, law, friction=FRICTION, scalar="double"):
    with open(folder / "state.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow("X,Y,Z,x,y,z,vx,vy,vz,body".split(","))
        writer.writerows([*X, *x, *v, body] for X, x, v, body in zip(*state))
    settings = {"--spacing": SPACING, "--young": YOUNG, "--young-hat": YOUNG_HAT, "--d1": D1, "--density": DENSITY,
                "--viscosity": VISCOSITY, "--friction": friction, "--time-step": STEP, "--friction-law": law, "--scalar": scalar,
                "--in": folder / "state.csv", "--out": folder / "forces.csv"}
    subprocess.run([program, *(str(part) for option in settings.items() for part in option)], check=True)
    with open(folder / "forces.csv", newline="") as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    vectors = {name: [[row[f"{name}_{axis}"] for axis in "xyz"] for row in rows]
               for name in ("elastic", "artificial", "viscous", "contact")}
    return vectors, [row["J"] for row in rows]


def compare(what, found, expected, tolerance):
    size = max(norm(f) for f in expected)
    worst = max(range(len(found)), key=lambda i: norm(sub(found[i], expected[i])))
    error = norm(sub(found[worst], expected[worst])) / size
    print(f"{what}: largest {size:.3g} N/m3, largest relative difference {error:.1e}")
    if not (size > 0 and error < tolerance):
        sys.exit(f"{what} of particle {worst} is {found[worst]}, expected {expected[worst]}")


def refused(program, folder, text, part, *options):
    (folder / "bad.csv").write_text(text)
    command = [program, "--in", folder / "bad.csv", *options]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode != 2 or part not in result.stderr:
        sys.exit(f"bad input '{part}' ended with {result.returncode}: {result.stderr}")


def main(program):
    state = scene()
    X, x, v, body = state
    F, elastic, artificial, viscous = internal_forces(X, x, v, body)
    contact, touching = contact_forces(x, v, F, body, FRICTION)
    if touching < 20:
        sys.exit(f"only {touching} slaves touch: the scene tests nothing")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        # The inverse of Z is a table that is good for 1e-6 of a spacing; the penetrations are tenths of one. In
        # float, F is good for about 2e-7, which 2 D1 multiplies; strains are hundredths.
        for scalar, rounding, table in (("double", 1e-10, 2e-5), ("float", 1e-4, 1e-4)):
            found, J = run(program, folder, state, "paper", scalar=scalar)
            for what, expected in (("elastic", elastic), ("artificial", artificial), ("viscous", viscous)):
                compare(f"{scalar} {what}", found[what], expected, rounding)
            compare(f"{scalar} contact", found["contact"], contact, table)
            error = max(abs(j - det(f)) for j, f in zip(J, F))
            if not error < (1e-12 if scalar == "double" else 2e-6):
                sys.exit(f"J differs by {error}")
        corrected, _ = run(program, folder, state, "corrected")
        total = [sum(f[a] for f in corrected["contact"]) for a in AXES]
        largest = max(norm(f) for f in corrected["contact"])
        if not norm(total) < 1e-11 * largest * len(X):
            sys.exit(f"contact forces sum to {total}")
        smooth, _ = run(program, folder, state, "corrected", friction=0.0)
        compare("without friction", smooth["contact"], contact_forces(x, v, F, body, 0.0)[0], 2e-5)

        header = "X,Y,Z,x,y,z,vx,vy,vz,body\n"
        refused(program, folder, "", "empty")
        refused(program, folder, "X,Y,Z\n0,0,0\n", "no column 'x'")
        refused(program, folder, header, "no particles")
        refused(program, folder, header + "0,0,0,0,0,0,0,0,nan,1\n", "line 2")
        refused(program, folder, header + "0,0,0,0,0,0,0,0,0,1.5\n", "whole number")
        refused(program, folder, header + "0,0,0,0,0,0,0,0,0,1\n", "particle 0")
        refused(program, folder, header + "0,0,0,0,0,0,0,0,0,1\n" * 2, "particle")
        places = [f"{SPACING * i},{SPACING * j},{SPACING * k}" for i in range(4) for j in range(4) for k in range(4)]
        cube = "".join(f"{place},{place},0,0,0,1\n" for place in places)
        refused(program, folder, header + cube, "nearest neighbours", "--spacing", "1.2")  # millimetres
        for option in ("--spacing", "--young", "--young-hat", "--d1", "--density", "--viscosity", "--friction",
                       "--penalty-ratio", "--time-step"):
            refused(program, folder, header + cube, option, option, "0x1")  # one, to CLI11
        refused(program, folder, header + cube, "would replace", "--out", folder / "bad.csv")
        # Forces that overflow: two layers with different velocities, and a cube in tension.
        moved = "".join(f"{place},{place},{n % 4},0,0,1\n" for n, place in enumerate(places))
        spacing = ("--spacing", str(SPACING))
        refused(program, folder, header + moved, "the viscous force on particle 0 is (", *spacing, "--viscosity", "1e300")
        stretched = "".join(f"{place},{1.01 * float(place.split(',')[0])},{place.split(',', 1)[1]},0,0,0,1\n"
                            for place in places)
        refused(program, folder, header + stretched, "the elastic force on particle 0 is (", *spacing,
                "--young", "1e36", "--d1", "1e38", "--scalar", "float")
        # What is no file is not replaced by one.
        os.mkfifo(folder / "pipe")
        refused(program, folder, header + cube, "not a regular file", *spacing, "--out", folder / "pipe")
        if not (folder / "pipe").is_fifo():
            sys.exit("a pipe was replaced by a file")
        # Forces that did not arrive, because the disk is full or the stream closed, are an error.
        command = f"{shlex.quote(program)} --spacing {SPACING} --in {shlex.quote(str(folder / 'bad.csv'))}"
        for stream in (">/dev/full", ">&-"):
            result = subprocess.run(f"{command} {stream}", shell=True, capture_output=True, text=True, check=False)
            if result.returncode == 0 or "standard output" not in result.stderr:
                sys.exit(f"{stream} ended with {result.returncode}: {result.stderr}")


if __name__ == "__main__":
    main(sys.argv[1])
