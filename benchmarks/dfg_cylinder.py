#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What accuracy costs in a flow around a cylinder: drag and lift of DFG 2D-1 against published figures, over even
grids, steps and forms of convection.

usage: benchmarks/dfg_cylinder.py [PROGRAM] [--across 10]... [--step 1/25]... [--form flux]... [--reynolds 20] [--check]

--reynolds 100: mean inflow of 1 m/s, where vortices leave the cylinder: the mean drag, the amplitude of the lift and its
frequency over the last five periods. --end: other than the scene's 8 s. --check: exit code 1 if a drag by fluxes is more
than 0.5 % off. One rank; seconds with 10 cells across the cylinder, minutes with 20, half an hour with 40.
"""
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [os.path.join(ROOT, "tests", "checks"), os.path.join(ROOT, "benchmarks")]
import convection_arguments  # noqa: E402
import time_integration  # noqa: E402
from turek_hron_swinging_flag import upward_passages  # noqa: E402

SCENE = os.path.join(ROOT, "prm", "dfg_2d1.prm")
DIAMETER, LENGTH, HEIGHT = 0.1, 2.2, 0.41  # [m]
DRAG, LIFT = 5.57953523384, 0.010618948146  # Schaefer, Turek 1996; figures of spectral elements by Nabh 1998
BOUND = 0.005


def arguments():
    parser = convection_arguments.parser(__doc__)
    parser.add_argument("--reynolds", type=int, choices=(20, 100), default=20)
    parser.add_argument("--end")
    return parser.parse_args()


def settings(across, step, form, reynolds):
    cells = f"{round(LENGTH / DIAMETER * across)}, {round(HEIGHT / DIAMETER * across)}"
    inflow = f"{1.2 * reynolds / 20!r}*y*(0.41-y)/0.41^2; 0"
    return [f"Domain/Cells={cells}", "Domain/Grading x=x", "Domain/Grading y=x", f"Time/Step={step}",
            f"Effects/convection/Form={form}", f"Fluid/Initial velocity={inflow}",
            f"Fluid/Boundaries/inlet/Velocity={inflow}"]


def coefficients(columns, axis, mean_inflow):
    """Of the force of pressure and friction, over time."""
    scale = 0.5 * mean_inflow ** 2 * DIAMETER
    return [sum(values) / scale for values in zip(*(columns[f"{kind} force cylinder {axis}"]
                                                    for kind in ("pressure", "viscous")))]


def over_periods(times, drag, lift, count=5):
    """Mean drag, amplitude of the lift and frequency [Hz] over the last periods of the lift."""
    half = len(times) // 2
    passages = upward_passages(times[half:], lift[half:])
    if len(passages) <= count:
        sys.exit(f"dfg_cylinder.py: fewer than {count} periods in the second half of {times[-1]} s")
    first, last = passages[-1 - count], passages[-1]
    chosen = [k for k, time in enumerate(times) if first <= time < last]
    values = [lift[k] for k in chosen]
    return sum(drag[k] for k in chosen) / len(chosen), (max(values) - min(values)) / 2, count / (last - first)


def main():
    options = arguments()
    failed = False
    last = "lift amplitude | frequency [Hz]" if options.reynolds == 100 else "lift"
    print(f"| cells across | step [s] | form | drag | {last} | core seconds |\n|---|---|---|---|---|---|"
          + ("---|" if options.reynolds == 100 else ""))
    for across in options.across or [10, 20]:
        for step in options.step or ["1/25", "1/100"]:
            for form in options.form or ["along paths", "flux"]:
                run = time_integration.once(options.program, SCENE, settings(across, step, form, options.reynolds)
                                            + ([f"Time/End={options.end}"] if options.end else []))
                if run.complaint:
                    sys.exit(f"dfg_cylinder.py: {run.complaint}")
                drag, lift = (coefficients(run.columns, axis, options.reynolds / 100) for axis in "xy")
                row = f"| {across} | {step} | {form} |"
                if options.reynolds == 20:
                    error = drag[-1] / DRAG - 1
                    failed = failed or (form == "flux" and abs(error) > BOUND)
                    row += f" {drag[-1]:.4f} ({100 * error:+.2f} %) | {lift[-1]:.5f} ({100 * (lift[-1] / LIFT - 1):+.0f} %) |"
                else:
                    mean, amplitude, frequency = over_periods(run.columns["Time"], drag, lift)
                    row += f" {mean:.4f} | {amplitude:.4f} | {frequency:.4f} |"
                print(f"{row} {run.seconds:.0f} |", flush=True)
    sys.exit(1 if options.check and failed else 0)


if __name__ == "__main__":
    main()
