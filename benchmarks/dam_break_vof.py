#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The broken dam of prm/dam_break_particles.prm by other means, to judge its front by: two fluids, water and air, on a
grid of volumes with fractions of water (interFoam of OpenFOAM), the column let go at once. Needs the Debian package openfoam.

usage: benchmarks/dam_break_vof.py [--cells N] [--wall slip|noSlip] [--width METRES] [--surface-tension SIGMA]

Prints T = t sqrt(2 g / a), the front z / a, where half of a cell is water, and the height left at the wall over 2 a, as in
tests/reference/dam_break_vof.csv (72 cells, slip; in half an hour; 36 cells take three minutes).
"""
import argparse
import math
import os
import re
import subprocess
import sys
import tempfile

GRAVITY = 9.81
LENGTH, HEIGHT = 4, 3  # of the tank [widths of the column]

FILES = {
    "system/blockMeshDict": ("dictionary", """
scale {width};
vertices ((0 0 0) ({length} 0 0) ({length} {height} 0) (0 {height} 0)
          (0 0 1) ({length} 0 1) ({length} {height} 1) (0 {height} 1));
blocks (hex (0 1 2 3 4 5 6 7) ({columns} {rows} 1) simpleGrading (1 1 1));
edges ();
boundary (
  walls {{ type wall; faces ((0 4 7 3) (1 2 6 5) (0 1 5 4)); }}
  top   {{ type patch; faces ((3 7 6 2)); }}
  sides {{ type empty; faces ((0 3 2 1) (4 5 6 7)); }}
);"""),
    "system/controlDict": ("dictionary", """
application interFoam; startFrom startTime; startTime 0; stopAt endTime; endTime {end};
deltaT {interval}; writeControl adjustableRunTime; writeInterval {interval}; writeFormat ascii; writePrecision 8;
adjustTimeStep yes; maxCo 0.3; maxAlphaCo 0.3; maxDeltaT 1; runTimeModifiable no;"""),
    "system/fvSchemes": ("dictionary", """
ddtSchemes {{ default Euler; }}
gradSchemes {{ default Gauss linear; }}
divSchemes {{
  div(rhoPhi,U) Gauss linearUpwind grad(U); div(phi,alpha) Gauss vanLeer; div(phirb,alpha) Gauss linear;
  div(((rho*nuEff)*dev2(T(grad(U))))) Gauss linear;
}}
laplacianSchemes {{ default Gauss linear corrected; }}
interpolationSchemes {{ default linear; }}
snGradSchemes {{ default corrected; }}"""),
    "system/fvSolution": ("dictionary", """
solvers {{
  "alpha.water.*" {{ nAlphaCorr 2; nAlphaSubCycles 1; cAlpha 1; MULESCorr yes; nLimiterIter 5;
                    solver smoothSolver; smoother symGaussSeidel; tolerance 1e-8; relTol 0; }}
  "pcorr.*" {{ solver PCG; preconditioner DIC; tolerance 1e-5; relTol 0; }}
  p_rgh {{ solver PCG; preconditioner DIC; tolerance 1e-7; relTol 0.01; }}
  p_rghFinal {{ solver PCG; preconditioner DIC; tolerance 1e-7; relTol 0; }}
}}
PIMPLE {{ momentumPredictor no; nOuterCorrectors 1; nCorrectors 3; nNonOrthogonalCorrectors 0; }}"""),
    "system/setFieldsDict": ("dictionary", """
defaultFieldValues (volScalarFieldValue alpha.water 0);
regions (boxToCell {{ box (0 0 -1) ({width} {twice} 1); fieldValues (volScalarFieldValue alpha.water 1); }});"""),
    "constant/g": ("uniformDimensionedVectorField", "dimensions [0 1 -2 0 0 0 0]; value (0 -{gravity} 0);"),
    "constant/turbulenceProperties": ("dictionary", "simulationType laminar;"),
    "constant/transportProperties": ("dictionary", """
phases (water air);
water {{ transportModel Newtonian; nu 1e-6; rho 1000; }}
air {{ transportModel Newtonian; nu 1.5e-5; rho 1.2; }}
sigma {sigma};"""),
    "0/alpha.water": ("volScalarField", """
dimensions [0 0 0 0 0 0 0]; internalField uniform 0;
boundaryField {{ walls {{ type zeroGradient; }} sides {{ type empty; }}
                top {{ type inletOutlet; inletValue uniform 0; value uniform 0; }} }}"""),
    "0/U": ("volVectorField", """
dimensions [0 1 -1 0 0 0 0]; internalField uniform (0 0 0);
boundaryField {{ walls {{ type {wall}; }} sides {{ type empty; }}
                top {{ type pressureInletOutletVelocity; value uniform (0 0 0); }} }}"""),
    "0/p_rgh": ("volScalarField", """
dimensions [1 -1 -2 0 0 0 0]; internalField uniform 0;
boundaryField {{ walls {{ type fixedFluxPressure; value uniform 0; }} sides {{ type empty; }}
                top {{ type totalPressure; p0 uniform 0; }} }}"""),
}


def write_case(folder, arguments):
    width = arguments.width
    unit = math.sqrt(width / (2 * GRAVITY))
    values = {"width": width, "twice": 2 * width, "length": LENGTH, "height": HEIGHT, "columns": LENGTH * arguments.cells,
              "rows": HEIGHT * arguments.cells, "end": 3.1 * unit, "interval": 0.05 * unit, "gravity": GRAVITY,
              "wall": arguments.wall, "sigma": arguments.surface_tension}
    for name, (kind, text) in FILES.items():
        path = os.path.join(folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w") as file:
            file.write(f"FoamFile {{ version 2.0; format ascii; class {kind}; object {os.path.basename(name)}; }}\n"
                       + text.format(**values) + "\n")


def solve(folder):
    environment = dict(os.environ)
    environment.setdefault("WM_PROJECT_DIR", "/usr/share/openfoam")  # where Debian has it
    for program in ("blockMesh", "setFields", "interFoam"):
        try:
            result = subprocess.run([program], cwd=folder, env=environment, capture_output=True, text=True)
        except FileNotFoundError:
            sys.exit(f"There is no program {program}: install the Debian package openfoam.")
        if result.returncode != 0:
            sys.exit(f"{program} failed:\n{result.stdout[-2000:]}{result.stderr[-2000:]}")


def fractions(path, columns):
    """Rows of cells from the floor up."""
    with open(path) as file:
        text = file.read()
    numbers = re.search(r"internalField\s+nonuniform List<scalar>\s+\d+\s*\(([^)]*)\)", text)[1].split()
    return [[float(word) for word in numbers[k:k + columns]] for k in range(0, len(numbers), columns)]


def end_of_water(row):
    """Where the last half full cell of a row ends in air, in cells; 0 without water."""
    wet = [k for k, fraction in enumerate(row) if fraction >= 0.5]
    if not wet:
        return 0.0
    last = wet[-1]
    after = row[last + 1] if last + 1 < len(row) else 0.0
    return last + 0.5 + (row[last] - 0.5) / (row[last] - after)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--cells", type=int, default=36, help="across the column's width")
    parser.add_argument("--wall", choices=("slip", "noSlip"), default="slip")
    parser.add_argument("--width", type=float, default=0.146, help="of the column [m]")
    parser.add_argument("--surface-tension", type=float, default=0.0, help="[N/m]")
    arguments = parser.parse_args()
    if arguments.cells < 2 or arguments.width <= 0:
        parser.error("at least two cells in a width above zero are needed")
    with tempfile.TemporaryDirectory() as folder:
        write_case(folder, arguments)
        solve(folder)
        unit = math.sqrt(arguments.width / (2 * GRAVITY))
        print("T,z_over_a,height_over_2a")
        for name in sorted((name for name in os.listdir(folder) if re.fullmatch(r"\d[\d.e-]*", name)), key=float):
            if float(name) > 0:
                rows = fractions(os.path.join(folder, name, "alpha.water"), LENGTH * arguments.cells)
                front = max(end_of_water(row) for row in rows)
                height = end_of_water([row[0] for row in rows])
                print(f"{float(name) / unit:.3f},{front / arguments.cells:.4f},{height / arguments.cells / 2:.4f}")


if __name__ == "__main__":
    main()
