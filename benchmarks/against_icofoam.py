#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lid-driven box beside OpenFOAM's icoFoam: seconds of a step, and errors of the steady plane flow, on the same cells.

usage: benchmarks/against_icofoam.py PROGRAM [--cells 100] [--steps 4] [--ranks 1,2] [--plane 32,64] [--mpirun mpirun]

Reynolds number 100. Seconds: a cube of so many cells along each edge, steps in which the lid moves by a cell, without the
first two; Undine with its default integrator of two stages and with `theta` of one, both to a divergence of 1e-10;
icoFoam with two corrections, pressure and velocity to 1e-8, by implicit Euler and by its two-step formula of second order
(backward), its pressure by multigrid (GAMG) and by conjugate gradients (PCG), of which the faster one counts. Errors:
extrema of the velocities on the centre lines of a square after 20 s, in steps of a cell, against the spectral solution of
Botella and Peyret (tests/reference). Needs Debian's package openfoam. Nothing else should run meanwhile.
"""
import argparse
import os
import re
import shlex
import subprocess
import sys
import tempfile

import step_costs
import viscous_flows
from step_costs import SECONDS, STEP

ROOT = step_costs.ROOT
VISCOSITY = 0.01
OPENFOAM = "/usr/share/openfoam"  # of Debian's package

HEADER = "FoamFile {{ version 2.0; format ascii; class {kind}; object {name}; }}\n"
MESH = """scale 1;
vertices ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1));
blocks (hex (0 1 2 3 4 5 6 7) ({n} {n} {depth}) simpleGrading (1 1 1));
edges ();
boundary (
  lid {{ type wall; faces ((3 7 6 2)); }}
  walls {{ type wall; faces ((0 4 7 3) (2 6 5 1) (1 5 4 0)); }}
  sides {{ type {sides}; faces ((0 3 2 1) (4 5 6 7)); }}
);
mergePatchPairs ();
"""
CONTROL = """application icoFoam; startFrom startTime; startTime 0; stopAt endTime; endTime {end:.10g}; deltaT {step:.10g};
writeControl timeStep; writeInterval {interval}; writeFormat ascii; writePrecision 12; timeFormat general; timePrecision 10;
runTimeModifiable false;
"""
SCHEMES = """ddtSchemes {{ default {integrator}; }}
gradSchemes {{ default Gauss linear; }}
divSchemes {{ default none; div(phi,U) Gauss linear; }}
laplacianSchemes {{ default Gauss linear orthogonal; }}
interpolationSchemes {{ default linear; }}
snGradSchemes {{ default orthogonal; }}
"""
SOLVERS = {"GAMG": "solver GAMG; smoother DICGaussSeidel;", "PCG": "solver PCG; preconditioner FDIC;"}
SOLUTION = """solvers {{
  p {{ {pressure} tolerance 1e-8; relTol 0.05; }}
  pFinal {{ $p; relTol 0; }}
  U {{ solver smoothSolver; smoother symGaussSeidel; tolerance 1e-8; relTol 0; }}
}}
PISO {{ nCorrectors 2; nNonOrthogonalCorrectors 0; pRefCell 0; pRefValue 0; }}
"""
VELOCITY = """dimensions [0 1 -1 0 0 0 0];
internalField uniform (0 0 0);
boundaryField {{
  lid {{ type fixedValue; value uniform (1 0 0); }}
  walls {{ type noSlip; }}
  sides {{ type {sides}; }}
}}
"""
PRESSURE = """dimensions [0 2 -2 0 0 0 0];
internalField uniform 0;
boundaryField {{
  lid {{ type zeroGradient; }}
  walls {{ type zeroGradient; }}
  sides {{ type {sides}; }}
}}
"""
DECOMPOSITION = "numberOfSubdomains {ranks}; method simple; simpleCoeffs {{ n ({ranks} 1 1); delta 0.001; }}\n"


def write_case(folder, cells, is_plane, integrator, solver, steps, ranks):
    files = {
        "system/blockMeshDict": MESH.format(n=cells, depth=1 if is_plane else cells, sides="empty" if is_plane else "wall"),
        "system/controlDict": CONTROL.format(end=steps / cells, step=1 / cells, interval=steps),
        "system/fvSchemes": SCHEMES.format(integrator=integrator),
        "system/fvSolution": SOLUTION.format(pressure=SOLVERS[solver]),
        "system/decomposeParDict": DECOMPOSITION.format(ranks=ranks),
        "constant/transportProperties": f"nu [0 2 -1 0 0 0 0] {VISCOSITY};\n",
        "0/U": VELOCITY.format(sides="empty" if is_plane else "noSlip"),
        "0/p": PRESSURE.format(sides="empty" if is_plane else "zeroGradient"),
    }
    for name, text in files.items():
        kind = {"0/U": "volVectorField", "0/p": "volScalarField"}.get(name, "dictionary")
        path = os.path.join(folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w") as file:
            file.write(HEADER.format(kind=kind, name=os.path.basename(name)) + text)


def call(words, folder):
    environment = {**os.environ, "WM_PROJECT_DIR": os.environ.get("WM_PROJECT_DIR", OPENFOAM)}
    result = subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True)
    if result.returncode:
        sys.exit(f"{words[0]} failed:\n{result.stdout[-1000:]}{result.stderr[-1000:]}")
    return result.stdout


def icofoam(folder, mpirun, ranks):
    """What it prints."""
    call(["blockMesh"], folder)
    if ranks == 1:
        return call(["icoFoam"], folder)
    call(["decomposePar"], folder)
    return call([*mpirun, "-n", str(ranks), "icoFoam", "-parallel"], folder)


def icofoam_seconds(cells, steps, ranks, integrator, solver, mpirun):
    """Of a step [s], by the clock of its processes."""
    first = step_costs.FIRST
    with tempfile.TemporaryDirectory() as folder:
        write_case(folder, cells, False, integrator, solver, first + steps, ranks)
        times = [float(found) for found in re.findall(r"ExecutionTime = ([\d.]+) s", icofoam(folder, mpirun, ranks))]
    if len(times) < first + steps:
        sys.exit(f"icoFoam: {len(times)} of {first + steps} steps")
    return (times[first + steps - 1] - times[first - 1]) / steps


def undine_seconds(program, cells, steps, ranks, integrator):
    scene = os.path.join(ROOT, "prm", "studies", "scenes", "lid_driven_box.prm")
    settings = {"Domain/Cells": ", ".join([str(cells)] * 3), "Time/Step": f"{1 / cells:.10g}", "Time/Integrator": integrator}
    return step_costs.measure(program, scene, settings, ranks, steps)[STEP, SECONDS]


def centres(cells):
    return [(k + 0.5) / cells for k in range(cells)]


def undine_lines(program, cells):
    """Velocities u on the line x = 1/2, v on y = 1/2, at the centres of cells."""
    settings = {"Domain/Cells": f"{cells}, {cells}", "Effects/viscosity/Dynamic viscosity": f"{VISCOSITY}",
                "Time/Step": f"{1 / cells:.10g}", "Time/End": "20"}
    for k, place in enumerate(centres(cells)):
        for name, x, y in (("u", 0.5, place), ("v", place, 0.5)):
            settings.update({f"Probes/{name}{k}/Kind": "fluid point", f"Probes/{name}{k}/Point": f"{x:.15g}, {y:.15g}"})
    result, columns = viscous_flows.runs.single(program.path, os.path.join(ROOT, "prm", "cavity.prm"), settings)
    if result["failure"]:
        sys.exit(f"against_icofoam.py: {result['failure']}")
    return [[columns[f"{name}{k} velocity {axis}"][-1] for k in range(cells)] for name, axis in (("u", "x"), ("v", "y"))]


def icofoam_lines(cells):
    """The same; between two columns of cells the mean of both."""
    with tempfile.TemporaryDirectory() as folder:
        write_case(folder, cells, True, "Euler", "GAMG", 20 * cells, 1)
        icofoam(folder, [], 1)
        with open(os.path.join(folder, "20", "U")) as file:
            rows = re.findall(r"^\(([-\d.e+]+) ([-\d.e+]+) [-\d.e+]+\)$", file.read(), re.MULTILINE)
    value = {(k % cells, k // cells): (float(u), float(v)) for k, (u, v) in enumerate(rows)}
    half = cells // 2
    return [[(value[half - 1, k][0] + value[half, k][0]) / 2 for k in range(cells)],
            [(value[k, half - 1][1] + value[k, half][1]) / 2 for k in range(cells)]]


def differences(cells, lines):
    """[(what, computed, in proportion to the published one)]"""
    published = {entry["quantity"]: float(entry["value"]) for entry in viscous_flows.references.table(
        os.path.join(viscous_flows.REFERENCE, "cavity_extrema.csv"), source="botella-peyret", Re="100")}
    u, v = (viscous_flows.extrema(centres(cells), line) for line in lines)
    return [(what, value, value / published[what] - 1) for what, value in (("u_min", u[0]), ("v_max", v[1]), ("v_min", v[0]))]


def print_seconds(options, program, mpirun):
    print(f"\nSeconds of a step, {options.cells}^3 cells, after the first {step_costs.FIRST}:\n")
    print("| program | integrator | pressure | " + " | ".join(f"{ranks} rank(s)" for ranks in options.ranks) + " |")
    print("|---|---|---|" + "---|" * len(options.ranks))
    for integrator, order in (("trapezoid_bdf2", "of two stages"), ("theta", "of one stage")):
        seconds = [undine_seconds(program, options.cells, options.steps, ranks, integrator) for ranks in options.ranks]
        print(f"| Undine | `{integrator}`, {order} | multigrid | " + " | ".join(f"{each:.2f}" for each in seconds) + " |", flush=True)
    for integrator in ("Euler", "backward"):
        for solver in SOLVERS:
            seconds = [icofoam_seconds(options.cells, options.steps, ranks, integrator, solver, mpirun)
                       for ranks in options.ranks]
            print(f"| icoFoam | {integrator} | {solver} | " + " | ".join(f"{each:.2f}" for each in seconds) + " |", flush=True)


def print_errors(options, program):
    print("\nErrors of the steady flow in a square with even cells:\n\n| cells | figure | Undine | icoFoam |\n|---|---|---|---|")
    for cells in options.plane:
        for (what, ours, our_error), (_, theirs, their_error) in zip(
                differences(cells, undine_lines(program, cells)), differences(cells, icofoam_lines(cells))):
            print(f"| {cells}² | {what} | {ours:.5f} ({100 * our_error:+.2f} %) | {theirs:.5f} ({100 * their_error:+.2f} %) |",
                  flush=True)


def whole_numbers(text):
    return [int(word) for word in text.split(",")]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--cells", type=int, default=100)
    parser.add_argument("--steps", type=int, default=4)
    parser.add_argument("--ranks", type=whole_numbers, default=[1, 2])
    parser.add_argument("--plane", type=whole_numbers, default=[32, 64])
    parser.add_argument("--mpirun", default="mpirun")
    options = parser.parse_args()
    program = step_costs.Program(options.program, options.mpirun)
    print_errors(options, program)
    print_seconds(options, program, shlex.split(options.mpirun))


if __name__ == "__main__":
    main()
