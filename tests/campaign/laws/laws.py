#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Laws of energy and volume, measured over what scenes can vary: densities, moduli, steps, integrators and places.

Each campaign runs scenes at many points, prints a line for each, with what is broken there, and a table at its end:

- damping: damping only takes energy, with every integrator;
- light: bodies much lighter than the fluid rise and swing with no more energy than was put in;
- contact: sheets of any density that meet do not shake the fluid between them;
- volume: chambers hold what has flown in, wherever planes of the grid lie;
- random: scenes drawn from wide ranges run to their end with no more energy than was put in;
- hard: hard scenes drawn from wider ranges, in the plane and in space, are certified as stable.

The folder of --out gets laws.json, all figures, and the scenes of the points at which something is broken. Exit code 1
if there are any. README.md says more, and how long it takes.
"""
import argparse
import concurrent.futures
import os
import sys
import traceback

import campaign_contact
import campaign_damping
import campaign_hard
import campaign_light
import campaign_random
import campaign_volume
import law_report
from law_runs import Program

CAMPAIGNS = {"damping": campaign_damping, "light": campaign_light, "contact": campaign_contact,
             "volume": campaign_volume, "random": campaign_random, "hard": campaign_hard}
QUICK_LIMIT = 60  # seconds of a run


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--campaign", nargs="+", choices=CAMPAIGNS, default=list(CAMPAIGNS), metavar="NAME")
    parser.add_argument("--jobs", type=int, default=1, help="runs at the same time, one process each")
    parser.add_argument("--quick", action="store_true", help="about ten short points a campaign")
    parser.add_argument("--out", default=".", metavar="DIR", help="folder for laws.json (default: .)")
    parser.add_argument("--only", default="", metavar="TEXT", help="only points with this in their names")
    parser.add_argument("--limit", type=float, help="seconds after which a run counts as one that stops "
                        f"(default: 7200, with --quick {QUICK_LIMIT})")
    parser.add_argument("--unwatched", action="store_true", help="without the energy monitor, which redoes steps")
    parser.add_argument("--against-fine", action="store_true",
                        help="light: compare motions and losses with those in steps of a sixteenth, where the step resolves them")
    parser.add_argument("--scenes", type=int, metavar="N", help="random and hard: how many, of hard ones in each dimension "
                        "(default: 200, with --quick 10; 1000 and 100, with --quick 8 and 2)")
    parser.add_argument("--first", type=int, default=0, metavar="N", help="hard: the number of the first one")
    parser.add_argument("--seed", default="1", help="random and hard: of the drawing")
    return parser.parse_args()


def measured(point, program):
    """The finding of a point. A mistake in the measuring is shown as one, and the others go on."""
    try:
        finding = point.measure(program)
    except Exception as error:  # pylint: disable=broad-except
        traceback.print_exc()
        finding = law_report.Finding(point.name, {}, [f"not measured: {type(error).__name__}: {error}"])
    print(f"{finding.name}: {'; '.join(finding.broken) or 'holds'}", file=sys.stderr, flush=True)
    return finding


def carry_out(campaign, program, options):
    """The findings at all points, and those about several of them."""
    plan = campaign.plan(options)
    points = [point for point in plan.points if options.only in point.name]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        findings = list(pool.map(lambda point: measured(point, program), points))
    return findings, plan.summary(findings)


def main():
    options = read_arguments()
    os.makedirs(options.out, exist_ok=True)
    settings = {"Time/Energy monitor": "off"} if options.unwatched else {}
    program = Program(options.program, options.limit or (QUICK_LIMIT if options.quick else 7200), settings)
    results = {}
    for name in options.campaign:
        findings, more = carry_out(CAMPAIGNS[name], program, options)
        results[name] = findings + more
        print(f"\n{name}: {CAMPAIGNS[name].__doc__}\n{law_report.table(findings)}", flush=True)
        if more:
            print(law_report.table(more), flush=True)
        law_report.write(options.out, results)  # after every campaign: what is stopped keeps what it has
    broken = sum(bool(finding.broken) for findings in results.values() for finding in findings)
    print(f"\n{sum(map(len, results.values()))} points, bounds are broken at {broken}; {len(program.runs)} runs in "
          f"{sum(program.runs):.0f} s")
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
