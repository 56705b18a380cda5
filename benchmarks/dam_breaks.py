#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Dam breaks of particles against experiments: the front along the floor (Martin and Moyce 1952, Koshizuka and Oka 1996)
and the pressure at the wall that it hits (Lobovsky et al. 2014), in the plane and in space.

usage: benchmarks/dam_breaks.py [fronts] [impacts] [--dimension 2|3] [--program PROGRAM] [--executor host|device]
                                [--spacing METRES] [--runs N] [--set SECTION/KEY=VALUE]... [--check]

Fronts: z / a over T = t sqrt(2 g / a), a the column's width, and the height left at the wall, over 2 a; the mean and the largest
deviation before T = 2 and from then on, from the same flow computed by other means (dam_break_vof.py) and from each
experiment. In experiments something had to get out of the water's way, and computations let it go at once: so
experiments are compared by their clocks, with clocks 0.175 late, which Lethe takes for the same experiment (its example
dam-break-2d.py), and with all others, to say between which ones no point before T = 2 is more than 15 % and none after it
more than 8 % away.

Impacts: pressures over rho g H, time over sqrt(H / g); the largest mean over 15 ms of the 200 values a second in the first
hit (that is before 4), and the mean from 4 to 5. Peaks scatter from run to run, as they do in the experiment: --runs repeats
these runs with gravity a millionth larger each time; printed are medians, and of peaks the least and the largest.

--check: fail if the front or the height is more than 4 % from the other computation, or no one lateness fits all
experiments, or the median of a first peak is more than 25 % from the measured one.
"""
import argparse
import csv
import math
import os
import statistics
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "checks"))
import scene_tools  # noqa: E402

FRONT = "dam_break_particles.prm"
WIDTH = 0.146  # of the column whose front is followed [m]
TANKS = {2: ["Domain/Upper corner=2.336, 0.584", "Probes/right wall/Point=2.336, 0.02"],  # as long as any experiment's
         3: ["Dimension=3", "Domain/Lower corner=0, 0, 0", "Domain/Upper corner=2.336, 0.584, 0.073",
             "Effects/gravity/Acceleration=0, -9.81, 0", "Probes/right wall/Point=2.336, 0.02, 0.0365"]}
LONG_RUN = ["Time/End=0.81", "Time/Step=0.0025", "Probes/front/Gap=3", "Probes/height/Kind=front", "Probes/height/Direction=y"]
COMPUTED_UNTIL = 2.9  # the tank of dam_break_vof.py ends [T]
COMPUTED_BOUND = 0.04  # how far from that the front and the height may be
BOUNDS = ((0.0, 2.0, 0.15), (2.0, math.inf, 0.08))  # from T, to T, allowed deviation
RELEASE = 0.175  # how late an experiment's clock is [T]
IMPACTS = {2: "dam_break_impact_particles.prm", 3: "dam_break_impact_particles_3d.prm"}
PROBES = {"p3": "lobovsky2014_p3_z30mm.csv", "p4": "lobovsky2014_p4_z80mm.csv"}
GRAVITY, DENSITY = 9.81, 1000.0
HEIGHT = 0.3   # of the column that hits the wall [m]
HIT = 4.0      # end of the first hit, start of the plateau [sqrt(H / g)]
PLATEAU_END = 5.0
WINDOW = 3     # values: 15 ms
PEAK_BOUND = 0.25


def reference(name):
    with open(os.path.join(ROOT, "tests", "reference", name)) as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def run(scene, arguments, more=()):
    settings = [f"Particles/Executor={arguments.executor}", "Output/Parts=statistics", *more, *arguments.set]
    return scene_tools.timed_columns(arguments.program, os.path.join(ROOT, "prm", scene), settings)


def interpolate(x, xs, ys):
    for k in range(1, len(xs)):
        if xs[k] >= x:
            return ys[k - 1] + (ys[k] - ys[k - 1]) * (x - xs[k - 1]) / (xs[k] - xs[k - 1])
    return None


def points_of(name, time, value, **chosen):
    return [(float(row[time]), float(row[value])) for row in reference(name)
            if all(row[key] == wanted for key, wanted in chosen.items())]


def measured_fronts():
    """Of each source, pairs of T and z / a."""
    sources = sorted({row["source"] for row in reference("dam_break_front.csv")})
    result = {source: points_of("dam_break_front.csv", "T", "z_over_a", source=source) for source in sources}
    return {**result, "MartinMoyce1952 table 2": points_of("martin_moyce_tables.csv", "T", "value", table="2")}


def deviations(points, times, values, late=0.0):
    """Pairs of T and how far `values` are from the points, by a clock that is `late`."""
    return [(T, interpolate(max(T - late, times[0]), times, values) / point - 1)
            for T, point in points if times[0] < T < times[-1]]


def in_words(found):
    words = []
    for first, last, _ in BOUNDS:
        part = [deviation for T, deviation in found if first <= T < last]
        words.append(f"{100 * sum(part) / len(part):+5.1f} {100 * max(part, key=abs):+6.1f} % ({len(part):2d})" if part
                     else f"{'':19s}")
    return "   ".join(words)


def is_within_bounds(found):
    return all(abs(deviation) <= allowed for T, deviation in found for first, last, allowed in BOUNDS if first <= T < last)


def fitting_lateness(sources, times, front):
    """The least and the most with which the front is within the bounds of all sources' points, in words."""
    fits = [late for late in (0.005 * k for k in range(121))
            if all(is_within_bounds(deviations(points, times, front, late)) for points in sources)]
    return f"within bounds if {fits[0]:.2f} to {fits[-1]:.2f} late" if fits else "never within bounds"


def compare_front(dimension, arguments):
    """Returns what is farther away than it should be."""
    spacing = [f"Particles/Spacing={arguments.spacing}"] if arguments.spacing else []
    columns, seconds = run(FRONT, arguments, TANKS[dimension] + LONG_RUN + spacing)
    times = [t * math.sqrt(2 * GRAVITY / WIDTH) for t in columns["Time"]]
    front = [x / WIDTH for x in columns["front"]]
    height = [y / (2 * WIDTH) for y in columns["height"]]
    failures = []

    def compare(name, clock, points, values, late=0.0, allowed=None):
        found = deviations(points, times, values, late)
        print(f"  {name:32s} {clock:15s}  {in_words(found)}")
        if not (allowed is None or all(abs(deviation) <= allowed for _, deviation in found)):
            failures.append(f"{name} is more than {100 * allowed:.0f} % away")
        if allowed is not None and not (points and points[-1][0] < times[-1]):
            failures.append(f"{name}: the run ends at T = {times[-1]:.2f}, before the last of {len(points)} points")

    print(f"{FRONT} in {dimension} dimensions: {seconds:.1f} s\n{'':52s}before T = 2: mean, most; from T = 2 on")
    for name, ours, value in (("front", front, "z_over_a"), ("height", height, "height_over_2a")):
        computed = [point for point in points_of("dam_break_vof.csv", "T", value) if point[0] < COMPUTED_UNTIL]
        compare(f"{name}, fractions of volumes", "", computed, ours, allowed=COMPUTED_BOUND)
    compare("height, MartinMoyce1952 table 6", "its clock", points_of("martin_moyce_tables.csv", "T", "value", table="6"), height)
    sources = measured_fronts()
    for source, points in sources.items():
        compare(source, "its clock", points, front)
        compare(source, f"{RELEASE} late", points, front, RELEASE)
        print(f"  {'':32s} {fitting_lateness([points], times, front)}")
    experiments = fitting_lateness([points for source, points in sources.items() if "MPS" not in source], times, front)
    print(f"  {'all experiments':32s} {experiments}")
    return failures + [f"fronts of experiments are {experiments}"] * ("never" in experiments)


def peak(times, values, end):
    means = [sum(values[k:k + WINDOW]) / WINDOW for k in range(len(values) - WINDOW + 1) if times[k + WINDOW - 1] < end]
    return max(means)


def impact(dimension, arguments, gravity):
    """When the front arrives, and of each probe the first peak and the mean after it, without units; seconds of the run."""
    more = [f"Effects/gravity/Acceleration={', '.join(['0', str(-gravity), '0'][:dimension])}"]
    if arguments.spacing:
        more.append(f"Particles/Spacing={arguments.spacing}")
    columns, seconds = run(IMPACTS[dimension], arguments, more)
    times = [t / math.sqrt(HEIGHT / GRAVITY) for t in columns["Time"]]
    figures = {"seconds": seconds, "arrival": interpolate(1.60, columns["front"], times)}
    for probe in PROBES:
        values = [p / (DENSITY * GRAVITY * HEIGHT) for p in columns[f"{probe} pressure"]]
        plateau = [p for t, p in zip(times, values) if HIT <= t < PLATEAU_END]
        figures[f"{probe} peak"] = peak(times, values, HIT)
        figures[f"{probe} plateau"] = sum(plateau) / len(plateau)
    return figures


def compare_pressure(dimension, arguments):
    """As compare_front()."""
    runs = [impact(dimension, arguments, GRAVITY * (1 + 1e-6 * k)) for k in range(arguments.runs)]
    middle = {name: statistics.median(figures[name] for figures in runs) for name in runs[0]}
    print(f"{IMPACTS[dimension]}: {len(runs)} runs of {middle['seconds']:.1f} s, the front arrives at {middle['arrival']:.2f} "
          "(experiment 2.42)")
    failures = []
    for probe, name in PROBES.items():
        rows = reference(name)
        measured = max(float(row["p_star"]) for row in rows if float(row["t_star"]) < HIT)
        peaks = [figures[f"{probe} peak"] for figures in runs]
        plateau = [float(row["p_star"]) for row in rows if HIT <= float(row["t_star"]) < PLATEAU_END]
        print(f"  {probe}: first peak {middle[f'{probe} peak']:.2f} ({min(peaks):.2f} to {max(peaks):.2f}), experiment "
              f"{measured:.2f} ({100 * (middle[f'{probe} peak'] / measured - 1):+.0f} %); "
              f"after it {middle[f'{probe} plateau']:.2f}, experiment {sum(plateau) / len(plateau):.2f}", flush=True)
        if not abs(middle[f"{probe} peak"] / measured - 1) <= PEAK_BOUND:
            failures.append(f"the first peak of {probe} is more than {100 * PEAK_BOUND:.0f} % away")
    return failures


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("what", nargs="*", default=["fronts", "impacts"], metavar="fronts|impacts")
    parser.add_argument("--dimension", type=int, choices=(2, 3), action="append", default=[], help="else both")
    parser.add_argument("--program", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--executor", choices=("host", "device"), default="host")
    parser.add_argument("--spacing", type=float, help="of the particles [m]")
    parser.add_argument("--runs", type=int, default=1, help="of each impact, whose medians are printed")
    parser.add_argument("--set", action="append", default=[], metavar="SECTION/KEY=VALUE", help="of the scenes' parameters")
    parser.add_argument("--check", action="store_true", help="fail if figures are farther away than they should be")
    arguments = parser.parse_args()
    if arguments.runs < 1:
        parser.error("--runs: at least one")
    compare = {"fronts": compare_front, "impacts": compare_pressure}
    for what in arguments.what:
        if what not in compare:
            parser.error(f"'{what}' is neither of: {', '.join(compare)}")
    failures = []
    for what in arguments.what:
        for dimension in arguments.dimension or (2, 3):
            failures += compare[what](dimension, arguments)
    if arguments.check and failures:
        sys.exit("\n".join(failures))


if __name__ == "__main__":
    main()
