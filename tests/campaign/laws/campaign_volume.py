# SPDX-License-Identifier: LGPL-2.1-or-later
"""Chambers hold what has flown in, wherever planes of the grid lie: at faces of bodies, close beside them, in them."""
import dataclasses
import math
import os
import statistics
import threading

import law_scenes
from law_report import Finding, Plan, Point, largest

VOLUME = 1e-8  # of the chamber's, that it may differ from what it had and what has flown in
CLOSURE = 1e-7  # of energy
END = 10  # s, of runs
JUMP = 3  # times the median difference of final displacements between neighbouring grids
NOTHING = 1e-7  # of the displacement, below which differences between grids are rounding
TUBE_LENGTH = 0.25  # m

# Where a plane lies beside the face of a body, in cells: at it, beside it on either side, and so far on.
BESIDE = (-1e-3, -1e-6, 0.0, 1e-6, 1e-3)
CROSSING = (1 / 6, 2 / 6, 3 / 6, 4 / 6, 5 / 6)
QUICK_OFFSETS = {"membrane": (0.0, 1e-6, 0.5), "shell": (0.0, 1e-3), "three membranes": (0.0, 1e-6, 1 / 6),
                 "ring": (0.0, 1e-6, 1 / 6), "tube": (0.0, 1e-6, 1 / 6)}


@dataclasses.dataclass(frozen=True)
class Case:
    """A scene with chambers, and how its grid is moved."""
    file: str
    chambers: tuple  # names of probes
    bodies: tuple  # whose centres of mass are compared
    inflow: object  # function of time, to which what flows into the first chamber is proportional
    cells: tuple  # of two sequences of grids, pairs
    grid: object  # function of cells and the offset in cells: settings
    quick_end: float
    settings: dict = dataclasses.field(default_factory=dict)


def ramp(time):
    return 0.5 - 0.5 * math.cos(math.pi * time) if time < 1 else 1.0


def breath(time):
    """In and out again, so that faces pass planes in both directions."""
    return math.sin(math.pi * time) ** 2 * math.cos(math.pi * time / 8)


BREATH = "sin(pi*t)^2*cos(pi*t/8)"


def shifted(lower, size, faces, axes):
    """Grids of a box that are moved along `axes` until a plane lies at the coordinate `faces`, and on by the offset."""
    def settings(cells, offset):
        corner = list(lower)
        for axis in axes:
            width = size[axis] / cells[axis]
            # The least way down that takes a plane to the face.
            corner[axis] -= (width - (faces[axis] - lower[axis]) % width) % width
            corner[axis] += offset * width
        return {"Domain/Lower corner": law_scenes.point(corner), "Domain/Cells": ", ".join(map(str, cells)),
                "Domain/Upper corner": law_scenes.point(low + length for low, length in zip(corner, size))}
    return settings


def stretched(cells, offset):
    """Grids of the quarter ring and the quarter tube: they must end on the sides of the domain, so that the inner
    radius, 1 m, is passed by cells that become smaller."""
    length = cells[0] / (cells[0] // 3 + offset)
    depth = (TUBE_LENGTH,) * (len(cells) - 2)
    return {"Domain/Upper corner": law_scenes.point((length, length) + depth),
            "Domain/Cells": ", ".join(map(str, cells)),
            "Fluid/Void regions/air/Seed": law_scenes.point((0.99 * length, 0.99 * length)
                                                            + tuple(0.4 * size for size in depth))}


CASES = {
    "membrane": Case(os.path.join(law_scenes.ROOT, "prm", "closed_chamber.prm"), ("chamber",), ("membrane",),
                     breath, ((32, 32), (40, 40)), shifted((0.0, 0.0), (1.0, 1.0), (None, 0.4), (1,)), 0.2,
                     {"Fluid/Boundaries/inlet/Velocity": "0; 0.15*" + BREATH}),
    "shell": Case("chamber_flush_with_planes.prm", ("inside",), ("shell",), ramp, ((74, 59), (37, 30)),
                  shifted((-2.0, 0.1), (7.4, 5.9), (0.0, 0.2), (0, 1)), 0.1,
                  {"Fluid/Void regions/air/Seed": "-1.5, 5.5",
                   "Fluid/Boundaries/inlet/Velocity": "0; 0.5*if(t<1, 0.5-0.5*cos(pi*t), 1)",
                   # Faces below the shell, too, so that what flows in is the same wherever they lie.
                   "Fluid/Boundaries/inlet/Region": "(x-1.9)*(3.1-x)"}),
    "three membranes": Case("chambers_at_grid_planes.prm", ("c0", "c1", "c2"), ("m0", "m1", "m2"),
                            breath, ((32, 32), (40, 40)), shifted((0.0, 0.0), (1.0, 1.0), (0.25, None), (0,)), 0.15,
                            {"Fluid/Boundaries/in/Velocity": "0.025*" + BREATH + "; 0"}),
    "ring": Case("ring_ends_on_symmetry_planes.prm", ("cavity",), ("ring",), ramp, ((45, 45), (60, 60)), stretched,
                 # No face's centre may come to the end of the inlet on any of the grids: its area would jump.
                 0.5, {"Fluid/Boundaries/source/Region": "0.53 - y"}),
    "tube": Case("tube_ends_on_symmetry_planes.prm", ("cavity",), ("tube",), ramp, ((18, 18, 2), (24, 24, 3)),
                 stretched, 0.3, {"Fluid/Boundaries/source/Region": "0.5 - y"}),
}


def flown_in(run, inflow):
    """What trapezoid_bdf2 counts as flown in until every row, per unit of `inflow` (T9)."""
    times, result = run.times(), [0.0]
    for number, (begin, end) in enumerate(zip(times, times[1:])):
        step = end - begin
        stage, weight = (1 - math.sqrt(0.5)) * step, math.sqrt(2) / 4 * step
        first = (step - stage) * inflow(begin + stage)  # of the first step of a run
        later = weight * (inflow(begin) + inflow(begin + 2 * stage))
        result.append(result[-1] + (later if number else first) + stage * inflow(end))
    return result


def volume_error(run, case):
    """The largest of all chambers and rows, relative to the chamber's volume."""
    flow = run.column(f"{case.chambers[0]} inflow")
    shares = [case.inflow(time) for time in run.times()]
    row = max(range(len(shares)), key=lambda number: abs(shares[number]))
    area = flow[row] / shares[row] if shares[row] else 0.0
    errors = []
    for chamber in case.chambers:
        volumes = run.column(f"{chamber} volume")
        held = flown_in(run, case.inflow) if chamber == case.chambers[0] else [0.0] * len(volumes)
        errors += [abs(volume - volumes[0] - area * share) / volumes[0] for volume, share in zip(volumes, held)]
    return largest(errors)


def motion(run, case):
    """Of the centres of mass of all bodies, from the start to the end [m]."""
    return [column[-1] - column[0] for body in case.bodies for column in
            (run.column(f"centre of mass {body} {axis}") for axis in "xyz") if column]


def length(vector):
    return math.sqrt(sum(number ** 2 for number in vector))


class Sequence:
    """Neighbouring grids of a case; keeps the final displacements."""

    def __init__(self, name, case, cells, offsets, settings):
        self.name, self.case = f"{name}, {' x '.join(map(str, cells))}", case
        self.offsets = offsets
        base = law_scenes.read(os.path.join(law_scenes.SCENES, case.file))
        self.scenes = [law_scenes.with_settings(base, {"Output/Budget": "true", "Time/End": END}, case.settings, settings,
                                                case.grid(cells, offset)) for offset in offsets]
        self.motions = [None] * len(offsets)
        self.lock = threading.Lock()

    def points(self):
        return [Point(self.point_name(number), lambda program, number=number: self.measure(program, number))
                for number in range(len(self.offsets))]

    def point_name(self, number):
        return f"{self.name}, planes {self.offsets[number]:.4g} cells beside"

    def measure(self, program, number):
        run = program.run(self.scenes[number])
        finding = Finding(self.point_name(number), {}, [], [run.scene])
        finding.need_end(run)
        if len(run.times()) < 2:
            return finding
        error = volume_error(run, self.case)
        closure = largest(abs(value) for value in run.column("energy closure"))
        finding.figures.update({"volume error": error, "energy closure": closure, "redone": run.redone(),
                                "moved [m]": length(motion(run, self.case)),
                                "elastic energy [J]": run.column("solid elastic energy")[-1]})
        finding.need(error <= VOLUME, "volume")
        finding.need(closure <= CLOSURE, "energy closure")
        if not run.complaint:
            with self.lock:
                self.motions[number] = motion(run, self.case)
        return finding

    def jumps(self):
        """The law about all of them; None for less than three runs that end. The median is that of grids that differ
        by more than the planes that are close to the face."""
        pairs = [(one, other) for one, other in zip(range(len(self.offsets)), range(1, len(self.offsets)))
                 if self.motions[one] and self.motions[other]]
        differences = {pair: length([a - b for a, b in zip(self.motions[pair[0]], self.motions[pair[1]])])
                       for pair in pairs}
        wide = [value for (one, other), value in differences.items() if self.offsets[other] - self.offsets[one] > 0.1]
        if not wide or len(differences) < 2:
            return None
        scale = max(length(vector) for vector in self.motions if vector)
        median = max(statistics.median(wide), NOTHING * scale)
        (one, other), most = max(differences.items(), key=lambda item: item[1])
        finding = Finding(f"{self.name}, all grids", {
            "moved [m]": scale, "largest / median difference": most / median, "median / moved": median / scale,
            "between": f"{self.offsets[one]:.4g} and {self.offsets[other]:.4g}"}, [])
        finding.need(most <= JUMP * median, "displacement jumps")
        return finding


def plan(options):
    sequences = []
    for name, case in CASES.items():
        for cells in case.cells[:1] if options.quick else case.cells:
            offsets = QUICK_OFFSETS[name] if options.quick else BESIDE + CROSSING
            settings = {"Time/End": case.quick_end} if options.quick else {}
            sequences.append(Sequence(name, case, cells, offsets, settings))
    return Plan([point for sequence in sequences for point in sequence.points()],
                lambda findings: [finding for finding in (sequence.jumps() for sequence in sequences) if finding])
