#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Short stretches of the flows of Turek and Hron around a cylinder with a flag, on coarse grids.

usage: check_flag_in_stream.py PROGRAM PRM_FOLDER REFERENCE_FOLDER

CFD2 (rigid flag, Reynolds number 100) from its developed profile until 2 s: forces as on this grid before, within 0.5
and 2 %, and as near to the published ones as a grid with ten cells across the cylinder comes (doc/viscous_flows.md), 1
and 15 %. FSI2 (elastic flag) from rest until 0.5 s, while the inflow grows: the drag is within 1 % of what grids of 120 by
61 and 180 by 92 cells and steps of 1/50 and 1/100 s agree on, what flows in flows out but for what the flag is
compressed by, and the budgets of energy and momentum close.
"""
import os
import sys

import scene_tools  # which finds the library of studies, too
from study import references

RIGID = {"drag": (137.54, 0.005), "lift": (11.904, 0.02)}  # forces at 2 s [N/m], relative change allowed
PUBLISHED = {"drag": 0.01, "lift": 0.15}  # relative errors allowed on this grid
ELASTIC_DRAG = 31.54  # at 0.5 s [N/m]
ROUNDING = 1e-9
SWEPT = 1e-4  # volume, of what has flown in: the end of the flag inside the cylinder meets no fluid


def published(folder):
    return references.table(os.path.join(folder, "turek_hron_cfd.csv"), case="CFD2", source="Turek-Hron2006")[0]


def force(columns, axis):
    """Of pressure and friction on all that is in the stream, at the end [N/m]."""
    return sum(values[-1] for name, values in columns.items()
               if name.startswith(("pressure force", "viscous force")) and name.endswith(f" {axis}"))


def near(what, value, wanted, allowed):
    error = value / wanted - 1
    print(f"{what}: {value:.5g}, expected {wanted:.5g}, error {100 * error:+.2f} %, allowed {100 * allowed:.3g} %")
    return abs(error) <= allowed


def vanishes(what, values, allowed=ROUNDING):
    largest = max(map(abs, values))
    print(f"{what}: {largest:.1e}, allowed {allowed:.0e}")
    return largest <= allowed


def stretch(program, scene, settings):
    columns, seconds = scene_tools.timed_columns(
        program, scene, ["Output/Parts=statistics", "Output/Interval=0"] + settings)
    print(f"{os.path.basename(scene)}: {seconds:.0f} s")
    return columns


def volume_lost(columns, swept):
    """Volume that has flown out (in: negative) and is not `swept`, of what has flown in."""
    through = [columns["Time"], columns["Flux through inlet"], columns["Flux through outlet"]]
    steps = [t - before for t, before in zip(through[0][1:], through[0])]
    flown_in, beyond = (sum(dt * flux for dt, flux in zip(steps, fluxes[1:])) for fluxes in (
        through[1], [into + out for into, out in zip(*through[1:])]))
    return (beyond - swept) / flown_in


def rigid(program, scenes, folder):
    columns = stretch(program, os.path.join(scenes, "turek_hron_cfd2.prm"),
                      ["Domain/Cells=48, 55", "Time/Step=1/50", "Time/End=2"])
    reference = published(folder)
    return [vanishes("CFD2 volume lost", [volume_lost(columns, 0)])] + [
        near(f"CFD2 {name} [N/m], {source}", force(columns, axis), wanted, allowed)
        for name, axis in (("drag", "x"), ("lift", "y"))
        for source, wanted, allowed in (("this grid", *RIGID[name]),
                                        ("published", float(reference[f"{name}_mean"]), PUBLISHED[name]))]


def elastic(program, scenes):
    columns = stretch(program, os.path.join(scenes, "turek_hron_fsi2.prm"),
                      ["Time/Step=1/50", "Time/End=0.5", "Output/Budget=true"])
    swept = columns["volume flag"][-1] - columns["volume flag"][0]
    return [near("FSI2 drag [N/m], finer grids", force(columns, "x"), ELASTIC_DRAG, 0.01),
            vanishes("FSI2 volume lost", [volume_lost(columns, swept)], SWEPT)] + [
                vanishes(f"FSI2 {what} closure", columns[f"{what} closure"]) for what in ("energy", "momentum")]


def main():
    program, scenes, folder = sys.argv[1:4]
    if not all(rigid(program, scenes, folder) + elastic(program, scenes)):
        sys.exit("outside the allowed error")


main()
