# SPDX-License-Identifier: LGPL-2.1-or-later
"""What makes a scene more accurate: its step, cells, elements and spacings, each of which can be refined by a factor."""
import json
import math
import re
import subprocess
import sys
from dataclasses import dataclass

from study.description import flat, numbers

FEWEST_CELLS = 3
CLOSE = 1.05  # factor between choices
AROUND = 1.25
ANY_STEPS = 2 ** 32 - 1  # so many that no run is stopped by their number
UNEVEN = 0.12  # by rounding to whole numbers of cells


@dataclass
class Knob:
    """Something of a scene that can be refined. `order`: what is expected of its error; `growth`: of the cost over the
    factor of refinement."""
    name: str
    values: dict  # {"Section/Key": [numbers]} of the scene
    order: float
    growth: float
    counts: bool  # numbers of cells, which grow; else lengths, which fall
    multiple: float = 0  # a length that is a whole number of these lengths; 0: none
    longest: float = 0  # a length in a run with outputs, which steps land on; 0: any

    def settings(self, factor):
        """{"Section/Key": value}, finer than the scene by the factor."""
        result = {}
        for key, values in self.values.items():
            if self.counts:
                result[key] = ", ".join(str(max(1, round(value * factor))) for value in values)
            else:
                length = values[0] / self.realised(factor)
                is_round = self.multiple or length <= self.longest * (1 + 1e-9)
                result[key] = f"{length:.{12 if is_round else 4}g}"
        return result

    def realised(self, factor):
        """The factor that whole numbers of cells make of another one: that of the largest number."""
        if self.multiple:
            length = next(iter(self.values.values()))[0]
            return max(1, round(self.multiple / length * factor)) * length / self.multiple
        if not self.counts:
            own = next(iter(self.values.values()))[0]
            if own / factor > self.longest * (1 + 1e-9) or not self.longest:
                return factor
            return round(self.longest * factor / own) * own / self.longest  # steps that land on outputs by themselves
        largest = max(value for values in self.values.values() for value in values)
        return max(1, round(largest * factor)) / largest

    def coarsest(self):
        """The smallest factor that is sensible: whole numbers of cells can fall along all axes alike."""
        if not self.counts:
            return max(1 / 64, next(iter(self.values.values()))[0] / self.multiple if self.multiple else 0.0)
        largest = min(max(values) for values in self.values.values())
        smallest = min((value for values in self.values.values() for value in values if value > 1), default=largest)
        return min(1.0, max(FEWEST_CELLS / largest, 1 / smallest))

    def least_with_outputs(self):
        """The smallest factor that a run with outputs can have: its steps are no longer than the time between outputs."""
        return next(iter(self.values.values()))[0] / self.longest if self.longest else 0.0

    def choices(self, low, high):
        """Factors between two others that can be had, as far as numbers of cells along all axes grow alike by them, a few
        per cent apart."""
        found, factor = [], low
        while factor <= high * (1 + 1e-9):
            choice = self.realised(factor)
            if self.is_even(choice) and (not found or choice > found[-1] * 1.01):
                found.append(choice)
            factor *= CLOSE
        return found

    def nearest(self, factor):
        """The factor that can be had next to another one."""
        return min(self.choices(factor / AROUND, factor * AROUND) or [self.realised(factor)],
                   key=lambda choice: abs(math.log(choice / factor)))

    def is_even(self, factor):
        """Do numbers of cells along all axes grow alike?"""
        if not self.counts:
            return True
        cells = [value * factor for values in self.values.values() for value in values if value > 1]
        return all(abs(math.log(max(1, round(each)) / each)) < UNEVEN for each in cells)

    def single_cells(self, factor):
        """Keys with a single cell along an axis, of which no run can tell what it does to the error."""
        if not self.counts or factor >= 1.5:
            return []
        return [key for key, values in self.values.items() if 1 in values]


def parameters(program, scene, assignments):
    """{"Section/Key": text} of a scene with its defaults; a mistake ends the program with its message."""
    words = [program, "read-scene", scene]
    for assignment in assignments:
        words += ["--set", assignment]
    result = subprocess.run(words, capture_output=True, text=True)
    if result.returncode != 0:
        sys.stderr.write(result.stderr)
        sys.exit(result.returncode)
    return flat(json.loads(result.stdout))


def common_length(lengths):
    """The largest length of which all others are whole multiples."""
    result = 0.0
    for length in lengths:
        while length > 1e-9 * max(lengths):
            result, length = length, result % length if result else 0.0
            if length > result - 1e-9 * max(lengths):
                length = 0.0
    return result


def lengths_in(found, unit):
    """Numbers in the region of the fluid and the corners of bodies and obstacles that are whole numbers of a unit."""
    texts = [text for key, text in found.items() if key == "Fluid/Region" or key.endswith(" corner")]
    values = [float(word) for text in texts for word in re.findall(r"(?<![\w.])\d+\.?\d*(?:e-?\d+)?", text)]
    return [value for value in values if value > 0 and abs(value / unit - round(value / unit)) < 1e-6]


def spacing(found, dimension):
    """Of particles: it divides the sides of the domain, and what is a whole number of the scene's own spacings, so that
    there is as much fluid with every spacing."""
    own = numbers(found["Particles/Spacing"])
    sides = [upper - lower for lower, upper in zip(numbers(found["Domain/Lower corner"]), numbers(found["Domain/Upper corner"]))]
    return Knob("spacing of particles", {"Particles/Spacing": own}, 1.0, dimension + 1, False,
                common_length(sides + lengths_in(found, own[0])))


def order_in_time(found):
    """Of the error that the integrator of a scene promises."""
    weights = {"theta": "Time/Theta", "newmark": "Time/Gamma"}  # of second order with one half only
    weight = found.get(weights.get(found.get("Time/Integrator")), "0.5")
    return 1.0 if found["Scheme"] == "time_splitting" or float(weight) != 0.5 else 2.0


def knobs_of(found):
    """All that the parameters of a scene have, by name."""
    dimension = int(found["Dimension"])
    if float(found.get("Time/Maximum steps", ANY_STEPS)) < ANY_STEPS:
        sys.exit("Error: with 'Time/Maximum steps' runs of other steps end at other times. Give 'Time/End' in its place.")
    if found["Scheme"] == "particle":
        print("note: sub-steps of particles follow from their spacing, which is refined; where 'Time/Step' bounds them, that is not "
              "looked at", file=sys.stderr)
        return [spacing(found, dimension)]
    result = []
    if found.get("Time/Integrator") != "static":
        result.append(Knob("time step", {"Time/Step": numbers(found["Time/Step"])}, order_in_time(found), 1.0, False,
                           longest=float(found.get("Output/Interval", 0))))
    planes = [key for key in ("Domain/Planes x", "Domain/Planes y", "Domain/Planes z") if found.get(key)]
    if planes:
        sys.exit(f"The grid is given by '{planes[0]}', which cannot be refined by a factor: the error of the grid would be left "
                 "out. Try: 'Domain/Cells', with 'Grading' where they are to be uneven.")
    if "Domain/Cells" in found:
        result.append(Knob("cells of the fluid", {"Domain/Cells": numbers(found["Domain/Cells"])}, 2.0, dimension, True))
    elements = {key: numbers(text) for key, text in found.items()
                if key.startswith("Bodies/") and key.count("/") == 2 and key.endswith("/Cells") and
                found.get(key[:-len("Cells")] + "Shape", "box") == "box"}
    others = [key.split("/")[1] for key, shape in found.items()
              if key.startswith("Bodies/") and key.count("/") == 2 and key.endswith("/Shape") and shape != "box"]
    if others:
        print(f"note: the error of the elements of {', '.join(others)} is not looked at: only those of boxes can be refined by a "
              "factor", file=sys.stderr)
    if elements:
        degree = int(found.get("Solid numerics/Element degree", "1"))
        result.append(Knob("elements of bodies", elements, degree + 1.0, dimension, True))
    return result
