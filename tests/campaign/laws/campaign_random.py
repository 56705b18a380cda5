# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes drawn from wide ranges (random_ranges.py) run to their end with no more energy than loads and gravity give."""
import collections

import law_energy
import random_scenes
from law_report import Finding, Plan, Point, largest

GAIN = 0.01  # of the largest work put in, that the energy may have above the work so far
ROUNDING = 1e-9  # of all forces times a metre, which is no gain
LEAST_SHARE = 1.0  # of scenes that hold

SCENES, QUICK_SCENES = 200, 10
QUICK_STEPS = 12  # of each run


def forces(drawn, run):
    """The sum of sizes [N]."""
    result = 0.0
    for body in drawn.bodies:
        weight = (body.density + drawn.around.density) * drawn.around.gravity
        result += run.column(f"volume {body.name}")[0] * (weight + sum(map(abs, body.load)))
    return result


def measure(program, name, drawn, more):
    scene = dict(drawn.scene, Time={**drawn.scene["Time"], **more})
    run = program.run(scene)
    finding = Finding(name, dict(drawn.figures), [], [run.scene])
    if run.was_refused:
        finding.figures["verdict"] = "refused"
        finding.broken.append(f"refused: {run.complaint}")
        return finding
    finding.need_end(run)
    energies = law_energy.energies(run)
    if energies:
        works = law_energy.works(run, drawn.bodies, drawn.around)
        most = largest(works) + energies[0]
        gain = largest(energy - energies[0] - work for energy, work in zip(energies, works))
        floor = ROUNDING * forces(drawn, run)
        finding.figures.update({"most work [J]": most, "gain / work": gain / max(most, floor), "redone": run.redone()})
        finding.need(gain <= GAIN * most + floor, "more energy than was put in")
    finding.figures["verdict"] = "holds" if not finding.broken else "stops" if run.complaint else "gains energy"
    return finding


def shares(findings):
    """How many scenes hold."""
    counts = collections.Counter(finding.figures.get("verdict", "not measured") for finding in findings)
    share = counts["holds"] / max(1, len(findings))
    result = Finding("all scenes",
                     {"share that holds": share, **{verdict: counts[verdict] for verdict in sorted(counts)}}, [])
    result.need(share >= LEAST_SHARE, f"only {100 * share:.1f} % hold")
    return [result]


def point(seed, number, most_steps):
    drawn = random_scenes.drawn(seed, number)
    name = f"{number}: {drawn.scene['Title'].partition(', ')[2]}"
    more = {"Maximum steps": str(most_steps)} if most_steps else {}
    return Point(name, lambda program: measure(program, name, drawn, more))


def plan(options):
    count = options.scenes or (QUICK_SCENES if options.quick else SCENES)
    most_steps = QUICK_STEPS if options.quick else None
    return Plan([point(options.seed, number, most_steps) for number in range(count)], shares)
