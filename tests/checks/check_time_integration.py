#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What studies find of integrators: on series made up with an order and a share of a step, and on a bar of which the
motion is known exactly.

usage: check_time_integration.py PROGRAM

Made-up series have the order, and fit at the share of a step, that they were made with. The integrators come closer
to the bar's motion with the order that doc/equations.md gives them, and closer to themselves likewise. A run that
cannot hold is an entry.
"""
import glob
import math
import os
import sys
import tempfile

import numpy

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(ROOT)
from study import analysis, campaign, convergence, description, quantities, report, runs  # noqa: E402

STUDIES = os.path.join(ROOT, "prm", "studies", "time_integration_*.prm")
BAR = os.path.join(ROOT, "tests", "time_integration", "bar_study.prm")
ORDERS = {"trapezoid_bdf2": 2, "theta 1/2": 2, "theta 1": 1, "newmark 1/2": 2, "newmark 1": 1, "alpha 0.5": 2}
SHARES = [k / 20 for k in range(31)]  # of a step
ALLOWED = 0.15  # of an order
END = 0.25  # of the bar's runs [s]


def expect(what, value, wanted, allowed=ALLOWED):
    """A complaint, or nothing."""
    print(f"{what}: {value:.3f}, expected {wanted}")
    return [] if abs(value - wanted) <= allowed else [f"{what}: {value:.3f} instead of {wanted}"]


def studies(program):
    """Each has a scene and enough steps, each half as long as the one before."""
    files = glob.glob(STUDIES)
    if len(files) < 6:
        yield f"there are only {files}"
    for file in files:
        study = description.read(program, file)
        lengths = next(each for each in study.variations if each.name == "step").lengths
        if len(lengths) < 3 or any(abs(a / b - 2) > 1e-9 for a, b in zip(lengths, lengths[1:])):
            yield f"{file}: steps {lengths}"
        if not os.path.exists(study.scene):
            yield f"{file}: there is no {study.scene}"


def made_up(order, per_second, share=1.0):
    """Columns of cos(6 t) with an error of this order that grows with time, at a share of each step."""
    times = numpy.arange(per_second + 1) / per_second
    places = numpy.concatenate([[0], times[:-1] + share / per_second])
    return {"Time": times, "a": numpy.cos(6 * places) + places * per_second ** -float(order)}


def over_time(columns, share):
    """The values of a series, as a study has them: each step's at a share of it."""
    texts = dict.fromkeys(description.Quantity.__dataclass_fields__, "")
    quantity = description.Quantity(**{**texts, "name": "a", "columns": ["a"], "factor": 1.0, "evaluate": "over time",
                                       "share_of_step": share, "start": 1e-6, "until": 0.0, "periods": 0})
    return quantities.evaluate(quantity, columns)


def deviation(found, share, reference):
    """Relative, of a series whose values are taken for those at a share of its steps, where there is a reference."""
    times, inside = found["Time"][:-1] + share * numpy.diff(found["Time"]), slice(0, -1)
    wanted = reference.at(times[inside])
    return convergence.norm(found["a"][1:][inside, None] - wanted) / convergence.norm(wanted)


def estimators():
    """What is found in made-up series."""
    for made in (1, 2, 3):
        series = [over_time(made_up(made, per_second), 1.0) for per_second in (64, 128, 256)]
        times = series[0].times
        values = [each.at(times) for each in series]
        exact = numpy.cos(6 * times)[:, None]
        yield from expect(f"series of order {made}, by itself",
                          convergence.observed_order([4, 2, 1], values), made, 0.01)
        yield from expect(f"series of order {made}, by the exact one", convergence.order_to_limit(
            [2, 1], [convergence.norm(each - exact) for each in values[-2:]]), made, 0.01)
        yield from expect(f"series of order {made}, largest error over h^{made}",
                          numpy.abs(values[0] - exact).max() / numpy.abs(exact).max() * 64 ** made, 1, 0.01)
    fine = over_time(made_up(3, 4096), 1.0)
    for share in (0, 0.5, 0.7, 1):
        found = made_up(3, 64, share)
        yield from expect(f"series at {share} of a step, fits at",
                          min(SHARES, key=lambda each: deviation(found, each, fine)), share, 0.001)


def integrators(program):
    """Orders, errors and costs of the bar's motion."""
    with tempfile.TemporaryDirectory() as folder:
        found = analysis.Analysis(program, *campaign.of_file(program, BAR, folder, 1))
        text = report.text(found)
    study = found.study
    for why in list(found.failures().values()) + list(found.unevaluated.values()):
        yield why
    for result in found.quantities:
        rows = found.orders(result)
        if len(rows) != len(ORDERS):
            yield f"{result.quantity.name}: orders of {len(rows)} integrators"
        for base, _, own, against in rows:
            name = study.variations[0].names[base.index[0]]
            yield from expect(f"{name}, {result.quantity.name}: order", against, ORDERS[name])
            yield from expect(f"{name}, {result.quantity.name}: own order", own, ORDERS[name])
            errors = [result.errors[base.with_value(1, step)] for step in (1, 2)]
            yield from expect(f"{name}, {result.quantity.name}: order from 1/1024 to 1/2048 s", convergence.order_to_limit(
                [2, 1], errors), ORDERS[name])
            if ORDERS[name] == 2 and not errors[-1] < 0.001:
                yield f"{name}, {result.quantity.name}: error {errors[-1]:.2e}"
    for case, each in found.results.items():
        if not each.get("Newton iterations", 0) >= END / study.variations[1].lengths[case.index[1]]:
            yield f"{case.name(study)} has cost nothing"
    yield from cheapest(study, found, text)


def cheapest(study, found, text):
    """Steps are dear where the order is low: the table of the cheapest runs says so."""
    displacement, names = found.quantities[0], study.variations[0].names
    second, first = (found.cheapest(displacement, (names.index(name),), 0.01) for name in ("newmark 1/2", "theta 1"))
    print(f"cheapest within 1 %: newmark 1/2 {second and second.name(study)}, theta 1 {first and first.name(study)}")
    if not second or (first and first.index[1] <= second.index[1]):
        yield f"cheapest within 1 %: newmark 1/2 {second}, theta 1 {first}"
    if "Reference: expression of the study" not in text or text.count("| theta 1 | 1/2048 |") != 3:
        yield f"tables lack something:\n{text}"


def failure(program):
    """One correction is allowed, and it cannot reach 1e-10 of the forces: the run stops at once."""
    result, columns = runs.single(program, os.path.join(ROOT, "tests", "time_integration", "bar.prm"), {
        "Bodies/bar/Material": "neo-Hookean", "Bodies/bar/Initial displacement": "0.3*x; 0", "Time/Step": "1/64",
        "Solid numerics/Newton tolerance": "1e-10", "Solid numerics/Newton maximum iterations": "1",
        "Time/Maximum cuts": "0"})
    print(f"a run that cannot hold: until {columns['Time'][-1]} s, '{result['failure']}'")
    if not result["failure"] or columns["Time"][-1] > 0:
        yield "a run that cannot hold is not told from one that does"


def main():
    program = sys.argv[1]
    found = list(studies(program)) + list(estimators()) + list(integrators(program)) + list(failure(program))
    if found:
        sys.exit("\n".join(found))


if __name__ == "__main__":
    main()
