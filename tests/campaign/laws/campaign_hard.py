# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hard scenes drawn from wide ranges (hard_ranges.py), in the plane and in space, run to their end and are certified as stable."""
import collections

import hard_scenes
from law_report import Finding, Plan, Point

SCENES = {2: 1000, 3: 100}  # by dimension
QUICK_SCENES = {2: 8, 3: 2}
QUICK_STEPS = 6  # of each run
LEAST_SHARE = 1.0  # of scenes that are stable
MOST_REDONE = 0.01  # of the steps, that is not worth a note


def measure(program, drawn, more):
    run = program.run(dict(drawn.scene, Time={**drawn.scene["Time"], **more}))
    finding = Finding(drawn.name, dict(drawn.figures), [], [run.scene])
    certificate = run.summary.get("certificate", {})
    verdict = "refused" if run.was_refused else certificate.get("verdict", "no end")
    if run.complaint and verdict != "refused":
        verdict = "failed" if verdict == "failed" else "no end"
    steps = max(1, certificate.get("steps", 0) + certificate.get("steps redone", 0))
    finding.figures.update({"verdict": verdict, "redone": certificate.get("steps redone", 0) / steps, "seconds": run.seconds})
    finding.need(verdict == "stable", f"{verdict}: {run.complaint or certificate.get('text', '')}")
    return finding


def shares(findings):
    """How many scenes have which verdict, by dimension."""
    results = []
    for dim in SCENES:
        these = [finding for finding in findings if finding.name.startswith(f"{dim}D ")]
        counts = collections.Counter(finding.figures.get("verdict", "not measured") for finding in these)
        often = sum(finding.figures.get("redone", 0) > MOST_REDONE for finding in these)
        result = Finding(f"all in {dim}D", {"share that is stable": counts["stable"] / max(1, len(these)), **dict(sorted(counts.items())),
                                            f"more than {MOST_REDONE:.0%} redone": often}, [])
        result.need(not these or counts["stable"] >= LEAST_SHARE * len(these), f"{len(these) - counts['stable']} are not stable")
        results.append(result)
    return results


def plan(options):
    more = {"Maximum steps": str(QUICK_STEPS)} if options.quick else {}
    points = []
    for dim, count in (QUICK_SCENES if options.quick else SCENES).items():
        for number in range(options.first, options.first + (options.scenes or count)):
            drawn = hard_scenes.drawn(options.seed, dim, number)
            points.append(Point(drawn.name, lambda program, drawn=drawn: measure(program, drawn, more)))
    return Plan(points, shares)
