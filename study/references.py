# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the quantities of a study are compared with."""
import csv
import math
import subprocess
from dataclasses import dataclass, field

import numpy

from study import convergence
from study.cases import variant, variant_name
from study.quantities import Values, interpolate


class NoReference(Exception):
    """Why there is nothing to compare with."""


@dataclass
class Reference:
    """Values [time][component], how far they may be off (in their norm), from where they are, and warnings."""
    values: numpy.ndarray
    uncertainty: float
    source: str
    warnings: list = field(default_factory=list)


def by_expression(program, quantity, times):
    """At all times and points; components in the order of Quantity.components()."""
    points = [point + [0.0] * (3 - len(point)) for point in quantity.points()] if quantity.field else [[0.0] * 3]
    lines = "".join(f"{x!r} {y!r} {z!r} {float(time)!r}\n" for time in times for x, y, z in points)
    parts = []
    for expression in quantity.reference:
        result = subprocess.run([program, "evaluate", "--", expression], input=lines, capture_output=True, text=True)
        if result.returncode != 0:
            raise NoReference(result.stderr.strip())
        parts.append(numpy.array(list(map(float, result.stdout.split()))).reshape(len(times), len(points)))
    values = numpy.concatenate(parts, axis=1)
    if values.shape[1] != len(quantity.components()):
        raise NoReference(f"the reference of '{quantity.name}' has {len(quantity.reference)} components, which does not fit")
    return Reference(values, 0.0, "expression of the study")


def table(path, **wanted):
    """The rows of a CSV file, each by the names in its first line that is no comment: those with the wanted values."""
    with open(path) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return [row for row in rows if all(row.get(name) == value for name, value in wanted.items())]


def rows_of(quantity):
    try:
        rows = table(quantity.reference_file)
    except OSError as error:
        raise NoReference(str(error)) from error
    chosen = [row for row in rows if all(row.get(name) == value for name, value in quantity.reference_row.items())]
    wanted = [quantity.reference_column] + ([quantity.reference_times] if quantity.evaluate == "over time" else [])
    for name in wanted:
        if not chosen or name not in chosen[0]:
            raise NoReference(f"'{quantity.reference_file}' has no such row, or no column '{name}'; its columns: " +
                              ", ".join(rows[0] if rows else []))
    return chosen


def by_file(quantity, times):
    rows = rows_of(quantity)
    values = quantity.reference_factor * numpy.array([[float(row[quantity.reference_column])] for row in rows])
    source = quantity.reference_file.rsplit("/", 1)[-1]
    if quantity.evaluate != "over time":
        if len(rows) > 1:
            raise NoReference(f"{len(rows)} rows of '{source}' fit: say which in 'Reference row'")
        return Reference(values, 0.0, source)
    given = numpy.array([float(row[quantity.reference_times]) for row in rows])
    if times[0] < given[0] - 1e-9 or times[-1] > given[-1] + 1e-9:
        raise NoReference(f"'{source}' has values from {given[0]:g} to {given[-1]:g} s alone: choose 'From' and 'Until'")
    return Reference(interpolate(given, values, times), 0.0, source)


def along(study, values, base, axis):
    """Lengths and values of the cases that differ from a base in one refinement, as far as they have succeeded."""
    cases = [base.with_value(axis, k) for k in range(len(study.variations[axis].names))]
    found = [(study.variations[axis].lengths[k], values[case]) for k, case in enumerate(cases) if case in values]
    return [length for length, _ in found], [value for _, value in found]


@dataclass
class AllLimits:
    """The limit by all refinements from one case: its value, how far it may be off (infinity: nothing tells), what is
    wrong with it, and how many refinements have changed nothing."""
    value: numpy.ndarray
    uncertainty: float = 0.0
    warnings: list = field(default_factory=list)
    unmoved: int = 0

    def rank(self):
        """Less is surer. What refinements do not change is no better known for that: it may not depend on them."""
        return self.unmoved, len(self.warnings), self.uncertainty


def limit_of_all(study, values, base):
    """From one case. Each refinement adds its own correction, which holds for errors small enough to be a sum of terms of
    each length."""
    result = AllLimits(values[base].copy())
    if not study.refinements():
        result.uncertainty = math.inf
        result.warnings.append("nothing is refined: how far the values are from a limit is not known")
    for axis in study.refinements():
        found = convergence.limit(*along(study, values, base, axis))
        result.value += found.value - values[base]
        result.uncertainty += found.uncertainty
        result.unmoved += found.uncertainty == 0
        if found.remark:
            result.warnings.append(f"{study.variations[axis].name}: the sequence {found.remark}")
    finest = study.combine == "all" and any(base.index[axis] < len(study.variations[axis].names) - 1
                                            for axis in study.refinements())
    if finest:
        result.warnings.append(f"the finest run is missing; this is the limit from {base.name(study)}")
    return result


def base_cases(study, values):
    """Where limits begin, one for each variant: the finest case that there is, or, if only one value changes at a time,
    the one in which nothing is refined."""
    bases = {}
    for case in values:
        refined = sum(case.index[axis] for axis in study.refinements())
        best = bases.get(variant(study, case))
        if best is None or (refined > best[0] if study.combine == "all" else refined < best[0]):
            bases[variant(study, case)] = (refined, case)
    return {key: case for key, (_, case) in bases.items()}


def by_finest(study, values):
    """From the runs themselves: of the variant whose limit is surest."""
    found = [(limit_of_all(study, values, base), key) for key, base in base_cases(study, values).items()]
    limit, key = min(found, key=lambda each: each[0].rank())
    uncertainty, warnings = limit.uncertainty, list(limit.warnings)
    for other, other_key in found:
        apart = convergence.norm(other.value - limit.value)
        if other.unmoved <= limit.unmoved and apart > limit.uncertainty + other.uncertainty:
            uncertainty = max(uncertainty, apart)
            warnings.append(f"runs with {variant_name(study, other_key)} lead elsewhere, by {apart:.3g}, than they should by both "
                            "uncertainties")
    return Reference(limit.value, uncertainty, f"limit of the finest runs ({variant_name(study, key)})", warnings)


def common_times(evaluated):
    """Those of the run with fewest: the others are brought to them."""
    return min((each.times for each in evaluated.values()), key=len)


def on_common_times(quantity, evaluated):
    """Times, and values of all cases at them."""
    times = common_times(evaluated)
    if quantity.evaluate == "over time":
        begin = max(each.times[0] for each in evaluated.values())
        end = min(each.times[-1] for each in evaluated.values())
        slack = 1e-9 * max(abs(end), 1e-300)
        times = times[(times >= begin - slack) & (times <= end + slack)]
        return times, {case: each.at(times) for case, each in evaluated.items()}
    return times, {case: each.values for case, each in evaluated.items()}


def make(program, study, quantity, times, values):
    """The reference of a quantity at common times; raises NoReference."""
    if quantity.reference:
        found = by_expression(program, quantity, times)
    elif quantity.reference_file:
        try:
            found = by_file(quantity, times)
        except (TypeError, ValueError) as error:
            raise NoReference(f"'{quantity.reference_file}' holds what is no number: {error}") from error
    else:
        found = by_finest(study, values)
    n_components = next(iter(values.values())).shape[1]
    if found.values.shape[1] != n_components:
        raise NoReference(f"the reference of '{quantity.name}' has {found.values.shape[1]} component(s) in the place of "
                          f"{n_components}")
    if not numpy.isfinite(found.values).all():
        raise NoReference("the reference is no finite number at all times")
    return found


__all__ = ["NoReference", "Reference", "Values", "along", "base_cases", "limit_of_all", "make", "on_common_times", "table"]
