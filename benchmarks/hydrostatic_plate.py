#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the plate of prm/hydrostatic_plate.prm rests, without a fluid: statics of the plate alone under its weight
and a follower pressure rho g times the depth of its bent upper side, on finer and finer meshes.

usage: benchmarks/hydrostatic_plate.py [PROGRAM]

The depth depends on the deflection: the load is found by repetition, as an even polynomial through points of
the upper side. Prints the deflection of the middle [m] and the force of the clamps [N].
"""
import os
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "checks"))
import scene_tools  # noqa: E402

MESHES = ("24, 1", "48, 2", "96, 4", "192, 8")
PLACES = [k / 20 for k in range(1, 11)]
POWERS = range(6)  # the deflection is (1 - s^2) times a polynomial in s^2 of this many terms, s = 2x - 1
SCENE = """
set Dimension = 2
subsection Time
  set End  = 1
  set Step = 1
end
subsection Bodies
  subsection plate
    set Lower corner    = 0, -0.54
    set Upper corner    = 1, -0.5
    set Cells           = {mesh}
    set Density         = 1100
    set Young's modulus = 1e8
    set Poisson's ratio = 0.3
    subsection Boundaries
      subsection ends
        set Sides = left, right
        set Kind  = clamp
      end
      subsection water
        set Sides    = top
        set Kind     = pressure
        set Pressure = 1000*9.81*(0.5 - ({deflection}))
      end
    end
  end
end
subsection Time
  set Integrator = static
end
subsection Effects
  subsection gravity
    set Acceleration = 0, -9.81
  end
end
subsection Probes
{probes}end
"""


def probe(name, x, y):
    return f"  subsection {name}\n    set Kind = body point\n    set Body = plate\n    set Point = {x}, {y}\n  end\n"


PROBES = (probe("middle", 0.5, -0.52) +
          "".join(probe(f"place{k}", x, -0.5) for k, x in enumerate(PLACES)))


def statics(program, mesh, deflection):
    """The last row of `statistics` by name."""
    with tempfile.TemporaryDirectory() as folder:
        scene = os.path.join(folder, "plate.prm")
        with open(scene, "w") as file:
            file.write(SCENE.format(mesh=mesh, deflection=deflection, probes=PROBES))
        scene_tools.run(program, [scene, "--output", folder, "--set", "Output/Parts=statistics"])
        names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    return dict(zip(names, rows[-1]))


def solution(matrix, right_side):
    """Of a small linear system, by elimination with pivots."""
    rows = [row + [value] for row, value in zip(matrix, right_side)]
    for k in range(len(rows)):
        best = max(range(k, len(rows)), key=lambda i: abs(rows[i][k]))
        rows[k], rows[best] = rows[best], rows[k]
        for i in range(len(rows)):
            if i != k:
                factor = rows[i][k] / rows[k][k]
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    return [row[-1] / row[k] for k, row in enumerate(rows)]


def polynomial(deflections):
    """Least squares through the places, as an expression in x."""
    terms = [[(1 - s * s) * s**(2 * p) for p in POWERS] for s in (2 * x - 1 for x in PLACES)]
    factors = solution([[sum(row[p] * row[q] for row in terms) for q in POWERS] for p in POWERS],
                       [sum(row[p] * d for row, d in zip(terms, deflections)) for p in POWERS])
    inside = " + ".join(f"({factor:.12g})*(2*x-1)^{2 * p}" for p, factor in zip(POWERS, factors))
    return f"(1-(2*x-1)^2)*({inside})"


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "build", "undine")
    for mesh in MESHES:
        deflection, before, now = "0", 1.0, 0.0
        while abs(now - before) > 1e-8:
            row = statics(program, mesh, deflection)
            before, now = now, row["middle displacement y"]
            deflection = polynomial([row[f"place{k} displacement y"] for k in range(len(PLACES))])
        print(f"{mesh} elements: {now:.8f} m, {row['reaction plate/ends y']:.4f} N", flush=True)


main()
