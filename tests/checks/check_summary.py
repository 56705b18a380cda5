#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""summary.json says what a run has cost and what it knows of its own error: at its end, after a failure, when it was taken
up again, and nothing that was not measured.

usage: check_summary.py PROGRAM SCENES
"""
import json
import os
import sys
import tempfile

import scene_tools

SHORT = ["--set", "Bodies/beam/Cells=4, 1, 1", "--set", "Time/Step=0.01", "--set", "Output/Parts=checkpoint"]


def require(condition, what):
    if not condition:
        sys.exit(f"check_summary.py: {what}")


def summary(folder):
    with open(os.path.join(folder, "summary.json")) as file:
        return json.load(file)


def error(found, kind):
    """The largest error of a kind; None if the run knows none."""
    return next((each["largest"] for each in found["errors"] if each["kind"] == kind), None)


def check_end(program, scene, folder):
    done = scene_tools.run(program, [scene, "--output", folder, *SHORT, "--set", "Time/End=0.05"])
    found = summary(folder)
    names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    columns = dict(zip(names, zip(*rows)))
    require(found["ended"] and found["failure"] == "" and found["time [s]"] == 0.05, f"at the end: {found}")
    require(found["steps"] == len(rows) - 1, f"{found['steps']} steps, but {len(rows) - 1} rows")
    require(found["Newton iterations"] == sum(columns["Newton iterations"]), "Newton iterations differ from statistics")
    require(0 < found["cost"]["core seconds"] < 60 and found["cost"]["peak memory [bytes]"] > 1e7, f"cost: {found['cost']}")
    require(0 < error(found, "Newton") <= float(found["tolerances"]["Solid numerics/Newton tolerance"]),
            f"Newton: {error(found, 'Newton')}")
    require(not found["time is estimated"] and error(found, "time") is None and "not estimated" in done.stdout,
            "an error in time that nothing has estimated")


def check_estimate(program, scene, folder):
    scene_tools.run(program, [scene, "--output", folder, *SHORT, "--set", "Time/End=0.05", "--set", "Time/Tolerance=0.01"])
    found = summary(folder)
    require(found["time is estimated"] and 0 < error(found, "time") < 0.02, f"estimate in time: {found['errors']}")


def check_resumption(program, folder):
    scene_tools.run(program, ["resume", folder, "--set", "Time/End=0.08"])
    found = summary(folder)
    require(found["begin [s]"] == 0.05 and found["time [s]"] == 0.08 and found["steps"] >= 3, f"resumed: {found}")


def check_nothing_left(program, folder):
    """A run that has reached its end and is taken up again makes no step: its summary stays."""
    before = summary(folder)
    scene_tools.run(program, ["resume", folder])
    require(summary(folder) == before, "a resumption without a step has changed the summary")


def check_failure(program, scene, folder):
    code, _, said = scene_tools.ended(program, [scene, "--output", folder, *SHORT, "--set", "Time/End=0.05", "--set",
                                                "Time/Maximum cuts=2", "--set",
                                                "Solid numerics/Newton maximum iterations=1"])
    found = summary(folder)
    require(code == 3 and not found["ended"] and "step 1" in found["failure"] and found["failure"].split()[0] in said,
            f"a run that fails: exit code {code}, {found}")


def check_fluid(program, scene, folder):
    scene_tools.run(program, [scene, "--output", folder, "--set", "Time/End=0.02", "--set", "Output/Budget=true"], 2)
    found = summary(folder)
    limit = float(found["tolerances"]["Fluid/Pressure solver/Divergence tolerance"])
    require(found["ranks"] == 2 and error(found, "mass") <= limit, f"mass: {found}")
    require(error(found, "energy") is not None and error(found, "momentum") is not None, f"balances: {found['errors']}")


def check_particles(program, scene, folder):
    scene_tools.run(program, [scene, "--output", folder, "--set", "Time/End=0.02", "--set", "Particles/Spacing=0.05"])
    found = summary(folder)
    limit = float(found["tolerances"]["Particles/Pressure/Tolerance"])
    require(found["unknowns"]["particles"] > 100 and 0 < error(found, "pressure") <= limit, f"particles: {found}")


def main():
    program, scenes = sys.argv[1:]
    beam = os.path.join(scenes, "cantilever.prm")
    with tempfile.TemporaryDirectory() as folder:
        place = lambda name: os.path.join(folder, name)  # noqa: E731
        check_end(program, beam, place("end"))
        check_nothing_left(program, place("end"))
        check_resumption(program, place("end"))
        check_estimate(program, beam, place("estimate"))
        check_failure(program, beam, place("failure"))
        check_particles(program, os.path.join(scenes, "hydrostatic_particles.prm"), place("particles"))
        check_fluid(program, os.path.join(scenes, "taylor_green.prm"), place("fluid"))


if __name__ == "__main__":
    main()
