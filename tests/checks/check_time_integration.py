#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""benchmarks/time_integration.py on a bar of which the motion is known exactly.

usage: check_time_integration.py PROGRAM

Made-up series have the order, and fit at the share of a step, that they were made with. The integrators come closer
to the bar's motion with the order that doc/equations.md gives them, and closer to themselves likewise. A run that
cannot hold is an entry.
"""
import math
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(ROOT, "benchmarks"))
import accuracy  # noqa: E402
import time_integration as benchmark  # noqa: E402
import time_integration_report as report  # noqa: E402

BAR = benchmark.Case("bar", "tests/time_integration/bar.prm", 0.25,
                     {"displacement": "tip displacement x", "velocity": "tip velocity x"}, (512, 1024, 2048))
ORDERS = {"trapezoid_bdf2": 2, "theta 1/2": 2, "theta 1": 1, "newmark 1/2": 2, "newmark 1": 1, "alpha 0.5": 2}
ALLOWED = 0.15  # of an order


def expect(what, value, wanted, allowed=ALLOWED):
    """A complaint, or nothing."""
    print(f"{what}: {value:.3f}, expected {wanted}")
    return [] if abs(value - wanted) <= allowed else [f"{what}: {value:.3f} instead of {wanted}"]


def cases():
    """Each has a scene and enough steps, each half as long as the one before."""
    for name, case in benchmark.CASES.items():
        halved = all(b == 2 * a for a, b in zip(case.steps, case.steps[1:]))
        if len(case.steps) < benchmark.QUICK_STEPS or not halved:
            yield f"case {name}: steps {case.steps}"
        if not os.path.exists(os.path.join(ROOT, case.scene)):
            yield f"case {name}: there is no {case.scene}"


def made_up(order, per_second, share=1):
    """cos(6 t) with an error of this order that grows with time, at a share of each step."""
    times = [n / per_second for n in range(per_second + 1)]
    places = [0] + [(n + share) / per_second for n in range(per_second)]
    return times, [math.cos(6 * t) + t * (1 / per_second)**order for t in places]


def estimators():
    """What accuracy.py finds in made-up series."""
    for made in (1, 2, 3):
        series = [accuracy.series_of_mean(*made_up(made, per_second), 1) for per_second in (64, 128, 256)]
        exact = accuracy.Series(series[-1].times, [math.cos(6 * t) for t in series[-1].times])
        yield from expect(f"series of order {made}, by itself", accuracy.own_order(series), made, 0.01)
        yield from expect(f"series of order {made}, by the exact one", accuracy.order(
            *(accuracy.errors(one, exact)[0] for one in series[-2:])), made, 0.01)
        yield from expect(f"series of order {made}, largest error over h^{made}",
                          accuracy.errors(series[0], exact)[1] * 64**made, 1, 0.01)
    fine = accuracy.series_of_mean(*made_up(3, 4096), 1)
    for share in (0, 0.5, 0.7, 1):
        yield from expect(f"series at {share} of a step, fits at",
                          accuracy.fitted_share(*made_up(3, 64, share), fine), share, 0.001)


def exact(quantity, length=0.5, cells=8, ratio=2e4 / 100, amplitude=0.01):
    """Of the bar's tip, often enough for linear interpolation to hit all steps."""
    angle = math.pi / 2 / cells
    omega = math.sqrt(6 * ratio * (1 - math.cos(angle)) / (2 + math.cos(angle))) * cells / length
    times = [n / BAR.steps[-1] for n in range(BAR.steps[-1])]
    return accuracy.Series(times, [amplitude * (math.cos(omega * t) if quantity == "displacement" else
                                                -omega * math.sin(omega * t)) for t in times])


def integrators(program):
    names = [name for name in benchmark.known_integrators(program) if name in ORDERS]
    if len(names) < 5:
        yield f"only {names} are known to the program"
    runs = benchmark.measure(program, BAR, names, [benchmark.TO_THE_END], BAR.steps, 1, 1)
    for name in names:
        for quantity in BAR.quantities:
            series = [runs[name, benchmark.TO_THE_END, step].series(BAR, quantity, name) for step in BAR.steps]
            by_exact = [accuracy.errors(one, exact(quantity))[0] for one in series]
            yield from expect(f"{name}, {quantity}: order", accuracy.order(*by_exact[-2:]), ORDERS[name])
            yield from expect(f"{name}, {quantity}: own order", accuracy.own_order(series), ORDERS[name])
            if ORDERS[name] == 2 and not by_exact[-1] < 0.001:
                yield f"{name}, {quantity}: error {by_exact[-1]:.2e}"
    if not all(run.corrections() >= step * BAR.end for (_, _, step), run in runs.items()):
        yield "a run has cost nothing"
    yield from cheapest(runs)


def cheapest(runs):
    """Steps are dear where the order is low: the table of the cheapest runs says so, the shortest being the reference."""
    newmark = [runs["newmark 1/2", benchmark.TO_THE_END, step] for step in BAR.steps[::-1]]
    result = report.Result("bar", BAR, BAR.steps, runs, "newmark 1/2", newmark[:2])
    second, first = (result.cheapest(name, benchmark.TO_THE_END, "displacement") for name in ("newmark 1/2", "theta 1"))
    print(f"cheapest within 1 %: newmark 1/2 {second}, theta 1 {first}")
    if not second or (first and first[2] <= second[2]):
        yield f"cheapest within 1 %: newmark 1/2 {second}, theta 1 {first}"
    text = "\n".join(report.section(result))
    if "Reference: newmark 1/2, 1/2048 s" not in text or text.count("| theta 1 | 1e-10 |") != 3:
        yield f"tables lack something:\n{text}"


def failure(program):
    """One correction is allowed, and it cannot reach 1e-14 of the forces: the run stops at once."""
    case = benchmark.Case(**{**vars(BAR), "settings": (
        "Bodies/bar/Material=neo-Hookean", "Bodies/bar/Initial displacement=0.3*x; 0",
        "Solid numerics/Newton maximum iterations=1")})
    (run,) = benchmark.measure(program, case, ["newmark 1/2"], [benchmark.TO_THE_END], (64,), 1, 1).values()
    print(f"a run that cannot hold: until {run.until()} s, '{run.complaint}'")
    if not run.complaint or run.until() > 0:
        yield "a run that cannot hold is not told from one that does"


def main():
    program = sys.argv[1]
    found = list(cases()) + list(estimators()) + list(integrators(program)) + list(failure(program))
    if found:
        sys.exit("\n".join(found))


main()
