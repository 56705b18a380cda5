#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs with 'Time / Steady within' end where they should: early, next to the end that they would come to, and not before
anything has moved; on two ranks like on one.

usage: check_steady.py PROGRAM SCENES
"""
import json
import os
import sys
import tempfile

import scene_tools

CHANNEL = {"Domain/Cells": "34, 44", "Time/Step": "1/5", "Time/End": "60", "Output/Interval": "0"}
DRAG = ("pressure force cylinder x", "viscous force cylinder x")
# The inflow begins after two seconds in which nothing moves.
LATER = {**CHANNEL, "Fluid/Initial velocity": "0; 0", "Time/End": "6", "Time/Steady within": "0.1", "Time/Steady for": "0.5",
         "Fluid/Boundaries/inlet/Velocity": "if(t<2, 0, t-2) * 1.2*y*(0.41-y)/0.41^2; 0"}
# Mass damping brings it to rest within a second.
BAR = {"Output/Interval": "0", "Effects/damping/Mass coefficient": "30", "Time/End": "20", "Time/Step": "1/40",
       "Time/Integrator": "trapezoid_bdf2", "Bodies/beam/Cells": "6, 1, 2",
       "Effects/gravity/Acceleration": "0, -0.5, 0"}
TIP = ("tip displacement y",)


def run(program, scenes, scene, settings, columns, ranks=1):
    """Time at the end [s], the sum of columns there, and the summary."""
    with tempfile.TemporaryDirectory() as folder:
        words = [os.path.join(scenes, scene + ".prm"), "--output", folder, "--overwrite"]
        for key, value in settings.items():
            words += ["--set", f"{key}={value}"]
        scene_tools.run(program, words, ranks)
        names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
        with open(os.path.join(folder, "summary.json")) as file:
            summary = json.load(file)
    return rows[-1][names.index("Time")], sum(rows[-1][names.index(name)] for name in columns), summary


def require(condition, what):
    if not condition:
        sys.exit(f"check_steady.py: {what}")


def check_channel(program, scenes):
    _, end, _ = run(program, scenes, "dfg_2d1", {**CHANNEL, "Time/End": "30"}, DRAG)
    for within, allowed in ((0.02, 1e-3), (0.002, 1e-4)):
        steady = {**CHANNEL, "Time/Steady within": within, "Time/Steady for": "1"}
        early, drag, summary = run(program, scenes, "dfg_2d1", steady, DRAG)
        print(f"channel, steady within {within}: ends at {early:.3g} s, drag off by {drag / end - 1:.1e}")
        require(early < 30 and summary["ended"], f"the channel's flow is not steady by {early} s")
        require(abs(drag / end - 1) <= allowed, f"the drag of a flow that is steady within {within} is {drag}, in the end {end}")
        left, = (error["largest"] for error in summary["errors"] if error["kind"] == "steady")
        require(0 < left <= within, f"summary.json says {left}, asked {within}")
    on_two, again, _ = run(program, scenes, "dfg_2d1", steady, DRAG, ranks=2)
    require(abs(on_two - early) < 1e-9 and abs(again / drag - 1) < 1e-6, f"two ranks end at {on_two} s with {again}")


def check_rest(program, scenes):
    end, _, _ = run(program, scenes, "dfg_2d1", LATER, DRAG)
    require(end > 2.5, f"a flow that begins at 2 s was called steady at {end} s")


def check_bar(program, scenes):
    _, at_rest, _ = run(program, scenes, "cantilever", {**BAR, "Effects/damping/Mass coefficient": "0",
                                                        "Time/Integrator": "static", "Time/Step": "1", "Time/End": "1"}, TIP)
    end, tip, _ = run(program, scenes, "cantilever", {**BAR, "Time/Steady within": "1e-3", "Time/Steady for": "0.5"}, TIP)
    print(f"cantilever: ends at {end:.3g} s, tip off by {tip / at_rest - 1:.1e} of its deflection at rest")
    require(end < 10, f"a damped cantilever is not steady by {end} s")
    require(abs(tip / at_rest - 1) <= 1e-3, f"the tip of a steady cantilever is at {tip} instead of {at_rest}")


def check_swing(program, scenes):
    """Hardly damped, it swings through points at which it rests for a moment."""
    swing = {**BAR, "Effects/damping/Mass coefficient": "0", "Time/End": "1.5", "Time/Steady within": "0.05",
             "Time/Steady for": "0.4"}
    end, _, _ = run(program, scenes, "cantilever", swing, TIP)
    require(end > 1.49, f"a swinging cantilever was called steady at {end} s")


def check_mistake(program, scenes):
    code, _, errors = scene_tools.ended(program, [os.path.join(scenes, "cavity.prm"), "--validate", "--set",
                                                  "Time/Steady within=0.1"])
    require(code == 2 and "Steady for" in errors, f"'Steady within' alone: exit code {code}, {errors}")


def main():
    program, scenes = sys.argv[1:3]
    check_channel(program, scenes)
    check_rest(program, scenes)
    check_bar(program, scenes)
    check_swing(program, scenes)
    check_mistake(program, scenes)


if __name__ == "__main__":
    main()
