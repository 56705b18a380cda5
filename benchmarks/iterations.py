#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How many iterations flexible GMRES needs for a block system of the simultaneous scheme, over
densities, stiffnesses, lengths of step, shapes and grids, as Markdown tables (doc/solver.md).

usage: benchmarks/iterations.py PROGRAM [--quick] [--3d] [--list FILE]

--quick takes the corners of the ranges and the coarse grid; --3d the cases in space instead of
those in the plane. --list writes every case with its count to FILE; those it holds already are
not run again.
A case runs three steps from rest; its count is the most that one solve to 1e-8 has taken.
"""
import collections
import itertools
import os
import re
import statistics
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "checks"))
import scene_tools  # noqa: E402

# Spacing of grids: cells a metre. ratio: the bodies' density over the fluid's.
Case = collections.namedtuple("Case", "shape cells fluid ratio modulus step dimension",
                              defaults=(2,))
PRECONDITIONERS = ("block triangular", "band correction")
SHAPES = ("sheet", "slab", "cavity")
FLUIDS = (1000.,)  # kg/m^3; a lighter one is as stiffer bodies in this one
PUSHED = 1e-3  # m, by the inflow in one step: a twentieth of the sheets' thickness
STEPS = 3
COLUMN = "Most iterations of a solve"

SCENE = """
set Title = {shape}
set Dimension = {dimension}
subsection Time
  set End = 1
  set Step = {step!r}
end
subsection Domain
  set Upper corner = {extent}
  set Cells = {grid}
end
subsection Fluid
  set Density = {fluid}
  subsection Boundaries
    subsection inlet
      set Sides = {inlet}
      set Region = {region}
      set Kind = inflow
      set Velocity = {velocity}
    end
    subsection outlet
      set Sides = {outlet}
      set Kind = outflow
    end
  end
end
subsection Bodies
  subsection body
    set Shape = box
    set Lower corner = {lower}
    set Upper corner = {upper}
    set Cells = {elements}
    set Density = {density!r}
    set Young's modulus = {modulus!r}
    set Poisson's ratio = 0.3
    subsection Boundaries
      subsection foot
        set Where = {held}
        set Kind = clamp
      end
    end
  end
end
subsection Effects
  subsection convection
  end
end
subsection Output
  set Parts = statistics
end
"""


def vector(values, dimension):
    return ", ".join(str(value) for value in values[:dimension])


def on_floor(thickness, case):
    """A body that stands on the floor in a jet from the left: {key: value} of the scene."""
    n, dimension = case.cells, case.dimension
    layers = max(1, round(thickness * n / 2), n // 24)
    jet = ["0.15 - abs(y - 0.4)", "0.15^2 - (y - 0.4)^2 - (z - 0.5)^2"][dimension - 2]
    return {"extent": vector((2, 1, 1), dimension), "grid": vector((2 * n, n, n), dimension),
            "inlet": "left", "outlet": "right", "region": jet,
            "velocity": "; ".join(["SPEED", "0", "0"][:dimension]),
            "lower": vector((0.703, -0.05, 0.2), dimension),
            "upper": vector((0.703 + thickness, 0.6, 0.8), dimension),
            "elements": vector((layers, n // 2, n // 2), dimension), "held": "-y"}


def across(case):
    """A membrane below which a cavity without outlet is inflated."""
    n, dimension = case.cells, case.dimension
    region = ["0.1 - abs(x - 0.5)", "0.1^2 - (x - 0.5)^2 - (z - 0.5)^2"][dimension - 2]
    held = ["abs(x - 0.5) - 0.54", "max(abs(x - 0.5), abs(z - 0.5)) - 0.54"][dimension - 2]
    return {"extent": vector((1, 1, 1), dimension), "grid": vector((n, n, n), dimension),
            "inlet": "bottom", "outlet": "top", "region": region,
            "velocity": "; ".join(["0", "SPEED", "0"][:dimension]),
            "lower": vector((-0.05, 0.403, -0.05), dimension),
            "upper": vector((1.05, 0.423, 1.05), dimension),
            "elements": vector((n // 2, max(1, n // 24), n // 2), dimension), "held": held}


def scene(case):
    """The text of a case."""
    keys = {"sheet": lambda: on_floor(0.02, case), "slab": lambda: on_floor(0.3, case),
            "cavity": lambda: across(case)}[case.shape]()
    # From rest: what is at rest at the start fits every body that closes a cavity.
    speed = f"{PUSHED / case.step!r} * min(1, t / {case.step!r})"
    keys["velocity"] = keys["velocity"].replace("SPEED", speed)
    return SCENE.format(shape=case.shape, dimension=case.dimension, step=case.step,
                        fluid=case.fluid, density=case.ratio * case.fluid, modulus=case.modulus,
                        **keys)


def run(program, case, settings, ranks=1, steps=STEPS):
    """Column names, their units and the rows of `statistics`, and what was printed; raises
    RuntimeError if the run fails."""
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "scene.prm")
        with open(file, "w") as stream:
            stream.write(scene(case))
        arguments = [file, "--output", os.path.join(folder, "results"),
                     "--set", f"Time/Maximum steps={steps}", "--set", "Time/Integrator=theta",
                     "--set", "Solid numerics/Inexact Newton=false"]
        for setting in settings:
            arguments += ["--set", setting]
        text = scene_tools.run(program, arguments, ranks).stdout
        return scene_tools.parse(scene_tools.statistics(os.path.join(folder, "results"))) + (text,)


def count(program, case, preconditioner, ranks=1):
    """The most iterations of one solve, and a remark on what was unusual."""
    try:
        names, _, rows, text = run(program, case, [f"Coupling/Preconditioner={preconditioner}"],
                                   ranks)
    except RuntimeError as error:
        reasons = re.findall(r"(?:failed|error).*", str(error), re.IGNORECASE)
        return None, (reasons or [str(error)])[-1][:200]
    remarks = []
    cuts = sum(row[names.index("Step cuts")] for row in rows)
    if cuts > 0:
        remarks.append(f"{cuts:.0f} step cuts")
    if "solved directly" in text:
        remarks.append("solved directly")
    return int(max(row[names.index(COLUMN)] for row in rows)), ", ".join(remarks)


def deviation(program, case, preconditioner):
    """The largest difference of any number in `statistics` from that with sparse factors of the
    whole matrix, relative to the largest number of its unit."""
    names, units, rows, _ = run(program, case, [f"Coupling/Preconditioner={preconditioner}"])
    _, _, exact, _ = run(program, case, ["Coupling/Linear solver=direct"])
    scale = {}
    for unit, *values in zip(units, *exact):
        scale[unit] = max(scale.get(unit, 0), *(abs(value) for value in values))
    return max(abs(value - other) / scale[unit]
               for row, other_row in zip(rows, exact)
               for name, unit, value, other in zip(names, units, row, other_row)
               if "iterations" not in name and scale[unit] > 0)


def cases(quick, dimension):
    ratios = (1e-3, 1., 1e3) if quick else (1e-3, 1e-1, 1., 10., 1e3)
    moduli = (1e1, 1e5, 1e9) if quick else (1e1, 1e3, 1e5, 1e7, 1e9)
    grids = (24,) if quick else (24, 48)
    shapes = SHAPES
    if dimension == 3:
        ratios, moduli, grids = (1e-3, 1., 1e3), (1e1, 1e5, 1e9), (12,) if quick else (12, 24)
        shapes = ("sheet", "cavity")
    return [Case(shape, cells, fluid, ratio, modulus, step, dimension)
            for shape, cells, fluid, ratio, modulus, step in itertools.product(
                shapes, grids, FLUIDS, ratios, moduli, (1 / 30, 1 / 240))]


def name(case):
    return (f"{case.dimension}D {case.shape}, {case.cells} cells a metre, fluid {case.fluid:g}, ratio {case.ratio:g}, "
            f"E {case.modulus:g}, h 1/{1 / case.step:.0f}")


def row(counts):
    """Cells of the table: median, 90 %, most."""
    if not counts:
        return "| - | - | - "
    ordered = sorted(counts)
    return (f"| {statistics.median(ordered):g} | {ordered[int(0.9 * (len(ordered) - 1) + 0.5)]} "
            f"| {ordered[-1]} ")


def table(counts):
    """counts: {(case, preconditioner): iterations}; one row for each shape and grid."""
    print("| shape | cells a metre | cases " +
          "".join(f"| {name}: median | 90 % | most " for name in PRECONDITIONERS) + "|")
    print("|---" * (3 + 3 * len(PRECONDITIONERS)) + "|")
    groups = sorted({(case.shape, case.cells) for case, _ in counts},
                    key=lambda group: (SHAPES.index(group[0]), group[1]))
    for group in groups + [None]:
        line = f"| {group[0]} | {group[1]} " if group else "| all | "
        chosen = {key: value for key, value in counts.items()
                  if not group or (key[0].shape, key[0].cells) == group}
        line += f"| {len({case for case, _ in chosen})} "
        for preconditioner in PRECONDITIONERS:
            line += row([value for (_, used), value in chosen.items() if used == preconditioner])
        print(line + "|")


def known(file):
    """{(preconditioner, name): (iterations, remark)} of an earlier run."""
    if not os.path.exists(file):
        return {}
    with open(file) as stream:
        lines = [line.rstrip("\n").split("; ", 3) for line in stream]
    return {(used, case): (None if iterations == "None" else int(iterations), remark)
            for iterations, used, case, remark in lines}


def measure(program, all_cases, file):
    """{(case, preconditioner): iterations} and a list of remarks."""
    counts, remarks = {}, []
    earlier = known(file)
    with open(file, "a") as listing:
        for case, preconditioner in itertools.product(all_cases, PRECONDITIONERS):
            result = earlier.get((preconditioner, name(case)))
            if not result:
                result = count(program, case, preconditioner)
                print(result[0], preconditioner, name(case), result[1], sep="; ", file=listing,
                      flush=True)
            if result[0] is not None:
                counts[case, preconditioner] = result[0]
            if result[1]:
                remarks.append(f"- {name(case)}, {preconditioner}: {result[1]}")
    return counts, remarks


def main():
    program = sys.argv[1]
    listing = sys.argv[sys.argv.index("--list") + 1] if "--list" in sys.argv else os.devnull
    all_cases = cases("--quick" in sys.argv, 3 if "--3d" in sys.argv else 2)
    counts, remarks = measure(program, all_cases, listing)
    table(counts)
    print("\nUnusual:\n" if remarks else "\nNothing unusual.", *remarks, sep="\n")

    print("\nLargest difference from the direct solver's results, relative:\n")
    for case in all_cases[::max(1, len(all_cases) // 12)]:
        try:
            found = [f"{deviation(program, case, used):.1e}" for used in PRECONDITIONERS]
        except RuntimeError as error:
            found = [str(error).splitlines()[-1]]
        print(f"- {name(case)}: {', '.join(found)}")


if __name__ == "__main__":
    main()
