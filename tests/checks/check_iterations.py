#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The counts of benchmarks/iterations.py for a few of its cases, the worst ones among them, are
those recorded here, up to a little.

usage: check_iterations.py PROGRAM RANKS [--record]

--record prints the list of cases with the counts that are found, which fills RECORDED. Give it one rank: with
more only every fourth case is run.
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "benchmarks"))
from iterations import PRECONDITIONERS, Case, count, name  # noqa: E402

SLACK = 3  # iterations; multigrid's aggregates depend on the number of ranks
RECORDED = {
    Case("sheet", 24, 1000., 1e-3, 1e1, 1 / 30): (24, 4),
    Case("sheet", 24, 1000., 1e-1, 1e5, 1 / 240): (21, 7),
    Case("sheet", 24, 1000., 1., 1e3, 1 / 30): (15, 6),
    Case("sheet", 24, 1000., 1e3, 1e9, 1 / 240): (5, 4),
    Case("slab", 24, 1000., 1e-3, 1e5, 1 / 240): (21, 6),
    Case("slab", 24, 1000., 1e3, 1e1, 1 / 30): (4, 4),
    Case("cavity", 24, 1000., 1e-3, 1e1, 1 / 30): (32, 3),
    Case("cavity", 24, 1000., 1., 1e5, 1 / 240): (16, 6),
    Case("cavity", 24, 1000., 10., 1e7, 1 / 30): (8, 6),
    Case("cavity", 48, 1000., 1e-3, 1e1, 1 / 30): (53, 9),
    Case("sheet", 12, 1000., 1., 1e5, 1 / 30, 3): (24, 10),
}


def main():
    program, ranks, record = sys.argv[1], int(sys.argv[2]), "--record" in sys.argv
    cases = list(RECORDED)[::1 if ranks == 1 else 4]
    wrong = []
    for case in cases:
        found = [count(program, case, used, ranks) for used in PRECONDITIONERS]
        if record:
            print(f"    Case{tuple(case)}: {tuple(iterations for iterations, _ in found)},")
            continue
        if len(found) != len(RECORDED[case]):
            sys.exit(f"{len(RECORDED[case])} preconditioners are recorded, not {PRECONDITIONERS}")
        for used, most, (iterations, remark) in zip(PRECONDITIONERS, RECORDED[case], found):
            if remark or not 1 <= iterations <= most + SLACK:
                wrong.append(f"{name(case)}, {used}: {iterations} iterations instead of {most}; "
                             f"{remark}")
    if wrong:
        sys.exit("\n".join(wrong))
    if not record:
        print(f"{len(cases)} cases on {ranks} rank(s): as recorded")


main()
