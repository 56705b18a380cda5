# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs that studies of a scene have made before, for estimates that need not make them again."""
import glob
import json
import os
from dataclasses import dataclass

from study import knobs, runs
from study.cases import of_scene
from study.description import numbers
from study.pilot import Refused, Setting

FOLDER = os.path.join("output", "studies")
SAME = 1e-9  # relative, of factors
RECORDED = ("Output/", "Probes/")  # what is written changes nothing


@dataclass(frozen=True)
class Kept:
    """The settings of a run, as its study has given them; what `runs` needs of a case."""
    values: tuple

    def settings(self, _):
        return dict(self.values)


def factor_of(knob, parameters):
    """By how much parameters refine a knob; None if they do not do so evenly."""
    ratios = []
    for key, values in knob.values.items():
        given = numbers(parameters[key]) if key in parameters else []
        if len(given) != len(values):
            return None
        ratios += [new / old if knob.counts else old / new for new, old in zip(given, values)]
    factor = max(ratios)
    if knob.counts:
        return factor if all(numbers(parameters[key]) == numbers(text) for key, text in knob.settings(factor).items()) else None
    return factor if min(ratios) > factor * (1 - SAME) else None


def setting_of(all_knobs, scene, parameters):
    """That of parameters that differ from those of a scene in nothing but the knobs and what is recorded; else None."""
    keys = {key for knob in all_knobs for key in knob.values}
    if any(parameters.get(key) != scene.get(key) for key in (parameters.keys() | scene.keys()) - keys
           if not key.startswith(RECORDED)):
        return None
    factors = tuple(factor_of(knob, parameters) for knob in all_knobs)
    return None if None in factors else Setting(all_knobs, factors)


def probes(parameters):
    return {key: value for key, value in parameters.items() if key.startswith("Probes/")}


def load(pilot, all_knobs, scene, folder=FOLDER, same_probes=False):
    """Give the pilot all runs of its scene, with these parameters, that studies in a folder have kept, if they are of the same
    program and have the columns of its quantity; their number. `same_probes`: only those with the probes of the scene, where
    the columns of the first decide what the quantity is."""
    digest, found = runs.digest_of_file(pilot.program), 0
    for path in sorted(glob.glob(os.path.join(folder, "*", "cases", "*", "result.json"))):
        try:
            with open(path) as file:
                result = {"failure": "", "settings": {}, **json.load(file)}
        except (OSError, TypeError, ValueError):
            continue  # of a study that was stopped hard, or of another kind of program
        settings, case = of_scene(result["settings"]), os.path.dirname(path)
        kept = Kept(tuple(result["settings"].items()))
        if result["failure"] or not all(settings.values()) or os.path.basename(case) != runs.identity(
                pilot.study, kept, digest):
            continue
        if settings.get("Output/Interval", "0") != "0":
            continue  # its steps have landed on outputs: they are not what 'Time/Step' says
        parameters = knobs.parameters(pilot.program, pilot.study.scene, [f"{key}={value}" for key, value in settings.items()])
        setting = setting_of(all_knobs, scene, parameters)
        if not setting or setting in pilot.values or (same_probes and probes(parameters) != probes(scene)):
            continue
        try:
            pilot.take(setting, result, case)
            found += setting in pilot.values
        except Refused:  # it has recorded other columns
            pilot.forget(setting)
    return found
