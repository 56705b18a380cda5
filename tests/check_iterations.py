#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The counts of benchmarks/iterations.py for a few of its cases, the worst ones among them, are
those recorded here, up to a little.

usage: check_iterations.py PROGRAM RANKS [--record]

--record prints the list of cases with the counts that are found.
"""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "benchmarks"))
from iterations import PRECONDITIONERS, Case, count, name  # noqa: E402

SLACK = 3  # iterations; multigrid's aggregates depend on the number of ranks
RECORDED = {}


def main():
    program, ranks = sys.argv[1], int(sys.argv[2])
    cases = list(RECORDED)[::1 if ranks == 1 else 4]
    wrong = []
    for case in cases:
        found = [count(program, case, used, ranks) for used in PRECONDITIONERS]
        if "--record" in sys.argv:
            print(f"    {tuple(case)}: {tuple(iterations for iterations, _ in found)},")
        for used, most, (iterations, remark) in zip(PRECONDITIONERS, RECORDED[case], found):
            if remark or iterations > most + SLACK:
                wrong.append(f"{name(case)}, {used}: {iterations} iterations instead of {most}; "
                             f"{remark}")
    if wrong and "--record" not in sys.argv:
        sys.exit("\n".join(wrong))
    print(f"{len(cases)} cases on {ranks} rank(s): as recorded")


main()
