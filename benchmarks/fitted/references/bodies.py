#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The finite-element answers with which benchmarks/fitted compares bodies of particles.

    python3 bodies.py half_cylinder 1 2 3 4      prints the answer for each refinement

For each refinement it writes a mesh of quadratic bricks (C3D20R) and its loads, NAME_N.inp, to the current folder, runs
`ccx NAME_N` (CalculiX, which must be on the path) and reads NAME_N.dat. Otherwise it needs only Python 3.

Small strains; E = 100 kPa, bulk modulus 2 MPa. The answer is the A of the displacement A p(X) that fits u best, which
is integral(u . p) / integral(p . p) over the volume of the body, under a load that is proportional to p. Loads on free
bodies are in balance, and these bodies are held only against rigid motions. For a strip whose ends are turned, the
answer is the torque.
"""

import math
import subprocess
import sys

YOUNG, BULK = 100e3, 2e6
POISSON = 0.5 - YOUNG / (6 * BULK)
WALL = 4.8e-3  # m

# The nodes of C3D20, in its order, from -1 to 1.
NODES = [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1),
         (0, -1, -1), (1, 0, -1), (0, 1, -1), (-1, 0, -1), (0, -1, 1), (1, 0, 1), (0, 1, 1), (-1, 0, 1),
         (-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]


def shape(node, at):
    """The shape function of a node."""
    product = 1.0
    for p, x in zip(node, at):
        product *= (1 - x * x) if p == 0 else (1 + p * x) / 2
    if 0 in node:
        return product
    return product * (sum(p * x for p, x in zip(node, at)) - 2)


def gauss_points():
    """(weight, values, slopes) of the shape functions at 3 x 3 x 3 points."""
    far, change = math.sqrt(0.6), 1e-5
    line = [(-far, 5 / 9), (0.0, 8 / 9), (far, 5 / 9)]
    points = []
    for x, a in line:
        for y, b in line:
            for z, c in line:
                slopes = []
                for axis in range(3):
                    up, down = [x, y, z], [x, y, z]
                    up[axis] += change
                    down[axis] -= change
                    slopes.append([(shape(n, up) - shape(n, down)) / (2 * change) for n in NODES])
                points.append((a * b * c, [shape(n, (x, y, z)) for n in NODES], slopes))
    return points


def even(s):
    return s


def to_first(s):
    """Makes bricks smaller towards 0, where a stress is unbounded."""
    return s * s


def to_last(s):
    return 1 - to_first(1 - s)


def to_both(s):
    return (1 - math.cos(math.pi * s)) / 2


def box(low, high):
    """Maps numbers from 0 to 1 to a place in the box with these corners."""
    return lambda *shares: tuple(a + s * (b - a) for a, b, s in zip(low, high, shares))


class Mesh:
    """Blocks of bricks that share their common nodes."""

    def __init__(self):
        self.places, self.elements, self.numbers = [], [], {}

    def node(self, place):
        key = tuple(round(1e8 * c) for c in place)
        if key not in self.numbers:
            self.numbers[key] = len(self.places)
            self.places.append(place)
        return self.numbers[key]

    def block(self, counts, place, grades=None):
        """counts[0] x counts[1] x counts[2] bricks. `place` maps three numbers from 0 to 1, right-handed, to x, y, z;
        before that, `grades` move the corners of bricks closer together."""
        lines = []
        for n, grade in zip(counts, grades or (even, even, even)):
            corners = [grade(k / n) for k in range(n + 1)]
            lines.append([{-1: low, 0: (low + high) / 2, 1: high} for low, high in zip(corners, corners[1:])])
        for a in lines[0]:
            for b in lines[1]:
                for c in lines[2]:
                    self.elements.append([self.node(place(a[p], b[q], c[r])) for p, q, r in NODES])

    def loads(self, pattern):
        """The forces at the nodes of the load `pattern`(x) per volume, and the integral of its square."""
        forces, squares = [[0.0] * 3 for _ in self.places], 0.0
        for element in self.elements:
            places = [self.places[k] for k in element]
            for weight, values, slopes in POINTS:
                j = [[sum(s * x[c] for s, x in zip(row, places)) for c in range(3)] for row in slopes]
                volume = weight * (j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) -
                                   j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
                                   j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]))
                if not volume > 0:
                    sys.exit("a brick is inside out")
                load = pattern([sum(v * x[c] for v, x in zip(values, places)) for c in range(3)])
                squares += volume * sum(p * p for p in load)
                for k, v in zip(element, values):
                    for c in range(3):
                        forces[k][c] += volume * v * load[c]
        return forces, squares


POINTS = gauss_points()


def is_at(value, level):
    return abs(value - level) < 1e-8


class Body:
    """A mesh, the load (N/m3), its pattern, and held(place), which returns the prescribed (axis, displacement in m)."""

    def __init__(self, mesh, held, pattern=lambda x: (0.0, 0.0, 0.0), load=0.0):
        self.mesh, self.held, self.pattern, self.load = mesh, held, pattern, load


def half_cylinder(n):
    """A quarter: an open half cylinder about y, 48 mm across the middle of the wall and 36 mm long, pinched at the
    middle of its length."""
    radius, length = 24e-3, 36e-3
    mesh = Mesh()

    def place(u, v, w):
        r, angle = radius + (u - 0.5) * WALL, w * math.pi / 2
        return (r * math.cos(angle), v * length / 2, r * math.sin(angle))

    mesh.block((n, 3 * n, 6 * n), place)

    def held(x):
        set_here = []
        if is_at(x[0], 0):
            set_here.append((0, 0.0))
        if is_at(x[1], 0):
            set_here.append((1, 0.0))
        if is_at(x[0], 0) and is_at(x[1], 0) and is_at(x[2], radius - WALL / 2):
            set_here.append((2, 0.0))
        return set_here

    def pattern(x):
        return (-x[0] / radius * math.cos(math.pi * x[1] / length) ** 2, 0.0, 0.0)

    return Body(mesh, held, pattern, 1000)


def half_ball(n):
    """A quarter: half a hollow ball, 48 mm across the middle of the wall, clamped at its rim, z = 0, under a radial
    load."""
    radius = 24e-3
    mesh = Mesh()
    corner, edge = 1 / math.sqrt(3), 1 / math.sqrt(2)
    x, y, z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
    xy, xz, yz, xyz = (edge, edge, 0), (edge, 0, edge), (0, edge, edge), (corner, corner, corner)

    def patch(corners):
        def place(u, v, w):
            a, b, c, d = corners
            line = [(1 - u) * (1 - v) * a[k] + u * (1 - v) * b[k] + u * v * c[k] + (1 - u) * v * d[k] for k in range(3)]
            size = math.sqrt(sum(s * s for s in line))
            return tuple((radius + (w - 0.5) * WALL) * s / size for s in line)
        return place

    for corners, grades in (((x, xy, xyz, xz), (even, to_first)), ((y, yz, xyz, xy), (to_first, even)),
                            ((z, xz, xyz, yz), (even, even))):
        mesh.block((3 * n, 3 * n, n), patch(corners), (*grades, to_both))

    def held(at):
        if is_at(at[2], 0):
            return [(0, 0.0), (1, 0.0), (2, 0.0)]
        return [(c, 0.0) for c in (0, 1) if is_at(at[c], 0)]

    def pattern(at):
        size = math.sqrt(sum(s * s for s in at))
        return tuple(s / size for s in at)

    return Body(mesh, held, pattern, 10000)


def strip(n, length=72e-3, width=18e-3, bricks=(12, 3)):
    """A strip of 72 x 18 mm along x and y whose ends are clamped; one is turned by 0.02 about x."""
    angle = 0.02
    mesh = Mesh()
    mesh.block((bricks[0] * n, bricks[1] * n, n), box((-length / 2, -width / 2, -WALL / 2), (length / 2, width / 2, WALL / 2)),
               [to_both] * 3)

    def held(x):
        if is_at(x[0], -length / 2):
            return [(0, 0.0), (1, 0.0), (2, 0.0)]
        if is_at(x[0], length / 2):
            return [(0, 0.0), (1, -angle * x[2]), (2, angle * x[1])]
        return []

    return Body(mesh, held)


def wide_strip(n):
    """The same with 144 x 54 mm."""
    return strip(n, 144e-3, 54e-3, (12, 5))


def wedge(n):
    """Half: a wedge 36 mm long along x and 24 mm wide along y, from 4.8 mm to 1.2 mm thick, clamped at its thick end
    and loaded across within 12 mm of its thin one."""
    length, width, thin, loaded = 36e-3, 24e-3, 1.2e-3, 12e-3
    mesh = Mesh()

    def place(u, v, w):
        return (u * length, v * width / 2, (w - 0.5) * (WALL + u * (thin - WALL)))

    mesh.block((9 * n, 2 * n, n), place, (to_first, to_last, to_both))

    def held(x):
        if is_at(x[0], 0):
            return [(0, 0.0), (1, 0.0), (2, 0.0)]
        return [(1, 0.0)] if is_at(x[1], 0) else []

    return Body(mesh, held, lambda x: (0.0, 0.0, -max(0.0, 1 - (length - x[0]) / loaded)), 1000)


def junction(n):
    """Half: a plate of 43.2 x 24 mm along x and y on a web that is clamped 24 mm below the middle of the plate. The
    load presses down one arm of the plate."""
    arm, height, width = 21.6e-3, 24e-3, 24e-3
    mesh = Mesh()
    half, wide = WALL / 2, to_last
    for low, high, along, grade in ((-arm, -half, 3 * n, to_last), (-half, 0.0, n, to_first), (0.0, half, n, to_last),
                                    (half, arm, 3 * n, to_first)):
        mesh.block((along, 2 * n, 2 * n), box((low, 0.0, -half), (high, width / 2, half)), (grade, wide, to_both))
    for low, high, grade in ((-half, 0.0, to_first), (0.0, half, to_last)):
        mesh.block((n, 2 * n, 5 * n), box((low, 0.0, -height), (high, width / 2, -half)), (grade, wide, to_both))

    def held(x):
        if is_at(x[2], -height):
            return [(0, 0.0), (1, 0.0), (2, 0.0)]
        return [(1, 0.0)] if is_at(x[1], 0) else []

    return Body(mesh, held, lambda x: (0.0, 0.0, -max(0.0, x[0]) / arm), 600)


class Leaf:
    """The epiglottis of examples/swallowing/scene/anatomy.hpp, whose numbers it repeats, in mm and radians."""

    LENGTH, RADIUS = 36, 36 / math.radians(14)  # of the midline, which is part of a circle

    @staticmethod
    def angle(arc):
        return math.radians(76 - 14 * arc / Leaf.LENGTH)

    @staticmethod
    def midline(arc):
        x, z, steps = -10.3, 12.6, 72
        for k in range(steps):
            at = Leaf.angle((k + 0.5) / steps * arc)
            x, z = x + arc / steps * math.cos(at), z + arc / steps * math.sin(at)
        return x, z

    @staticmethod
    def half_width(arc):
        s = arc / (0.6 * Leaf.LENGTH)
        if s < 1:
            return 6 + 6 * s * s * (3 - 2 * s)
        return 12 * math.sqrt(1 - ((arc / Leaf.LENGTH - 0.6) / 0.42) ** 6)

    @staticmethod
    def arc(x, z):
        """From the direction to the centre of the circle."""
        start, (x0, z0) = Leaf.angle(0), Leaf.midline(0)
        x, z = x - x0 - Leaf.RADIUS * math.sin(start), z - z0 + Leaf.RADIUS * math.cos(start)
        return Leaf.RADIUS * (start - math.atan2(-x, z))


def leaf(n):
    """Half: the epiglottis of the example of the swallow, clamped 5 mm from its base and loaded along the normal of its
    tip within 9 mm of that."""
    clamp, loaded, tip = 5.0, 9.0, Leaf.angle(Leaf.LENGTH)
    mesh = Mesh()

    def place(u, v, w):
        arc = clamp + u * (Leaf.LENGTH - clamp)
        (x, z), y, angle = Leaf.midline(arc), v * Leaf.half_width(arc), Leaf.angle(arc)
        back = 0.012 * y * y + 1e3 * WALL * (0.5 - w)
        return (1e-3 * (x + back * math.sin(angle)), 1e-3 * y, 1e-3 * (z - back * math.cos(angle)))

    mesh.block((9 * n, 3 * n, n), place, (to_both, to_last, to_both))
    (x0, z0), along = Leaf.midline(clamp), (math.cos(Leaf.angle(clamp)), math.sin(Leaf.angle(clamp)))

    def held(x):
        if is_at((x[0] - 1e-3 * x0) * along[0] + (x[2] - 1e-3 * z0) * along[1], 0):
            return [(0, 0.0), (1, 0.0), (2, 0.0)]
        return [(1, 0.0)] if is_at(x[1], 0) else []

    def pattern(x):
        share = max(0.0, 1 - (Leaf.LENGTH - Leaf.arc(1e3 * x[0], 1e3 * x[2])) / loaded)
        return (share * math.sin(tip), 0.0, -share * math.cos(tip))

    return Body(mesh, held, pattern, 1000)


def write(name, body, forces):
    mesh = body.mesh
    lines = ["*NODE, NSET=ALL"]
    lines += [f"{k + 1}, {x[0]:.12g}, {x[1]:.12g}, {x[2]:.12g}" for k, x in enumerate(mesh.places)]
    lines.append("*ELEMENT, TYPE=C3D20R, ELSET=BODY")
    for k, element in enumerate(mesh.elements):
        numbers = [str(k + 1)] + [str(i + 1) for i in element]
        lines += [", ".join(numbers[:16]) + ",", ", ".join(numbers[16:])]
    lines += ["*MATERIAL, NAME=M", "*ELASTIC", f"{YOUNG}, {POISSON:.15g}", "*SOLID SECTION, ELSET=BODY, MATERIAL=M"]
    lines += ["*STEP", "*STATIC", "*BOUNDARY"]
    for k, x in enumerate(mesh.places):
        lines += [f"{k + 1}, {axis + 1}, {axis + 1}, {by:.12g}" for axis, by in body.held(x)]
    if body.load:
        lines.append("*CLOAD")
        lines += [f"{k + 1}, {c + 1}, {body.load * f:.12g}" for k, force in enumerate(forces)
                  for c, f in enumerate(force) if f != 0]
    lines += ["*NODE PRINT, NSET=ALL", "U, RF", "*END STEP"]
    with open(name + ".inp", "w") as file:
        file.write("\n".join(lines) + "\n")


def read(name, count):
    """The displacements and the reactions of all nodes."""
    tables = {"displacements": [[0.0] * 3 for _ in range(count)], "forces": [[0.0] * 3 for _ in range(count)]}
    table = None
    with open(name + ".dat") as file:
        for line in file:
            cells = line.split()
            if cells and cells[0] in tables:
                table = tables[cells[0]]
            elif len(cells) == 4 and table is not None:
                table[int(cells[0]) - 1] = [float(c) for c in cells[1:]]
    return tables["displacements"], tables["forces"]


def answer(body, forces, squares, displacements, reactions):
    if not body.load:
        places = body.mesh.places
        end = max(x[0] for x in places)
        torque = sum(x[1] * r[2] - x[2] * r[1] for x, r in zip(places, reactions) if is_at(x[0], end))
        return f"torque {1e6 * torque:.5g} uN m"
    work = sum(f * u for force, moved in zip(forces, displacements) for f, u in zip(force, moved))
    return f"gives way by {1e3 * work / squares:.5g} mm"


def main():
    bodies = {"half_cylinder": half_cylinder, "half_ball": half_ball, "strip": strip, "wide_strip": wide_strip,
              "wedge": wedge, "junction": junction, "leaf": leaf}
    if len(sys.argv) < 3 or sys.argv[1] not in bodies:
        sys.exit(f"usage: bodies.py {'|'.join(bodies)} REFINEMENT...")
    for n in map(int, sys.argv[2:]):
        name, body = f"{sys.argv[1]}_{n}", bodies[sys.argv[1]](n)
        forces, squares = body.mesh.loads(body.pattern)
        write(name, body, forces)
        subprocess.run(["ccx", name], check=True, stdout=subprocess.DEVNULL)
        found = answer(body, forces, squares, *read(name, len(body.mesh.places)))
        print(f"{sys.argv[1]}, refinement {n}, {len(body.mesh.elements)} bricks: {found}", flush=True)


if __name__ == "__main__":
    main()
