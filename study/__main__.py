# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a study: a scene with many settings, to see what accuracy costs.

usage: ./undine study STUDY.prm [--out DIR] [--jobs N] [--within 20min] [--results-only]
"""
import argparse
import os
import re
import sys

from study import analysis, campaign, report

UNITS = {"": 1, "s": 1, "min": 60, "h": 3600}


def duration(text):
    """Seconds of "90", "20min" or "2h"."""
    found = re.fullmatch(r"(\d+(?:\.\d*)?)\s*(s|min|h|)", text)
    if not found:
        raise argparse.ArgumentTypeError(f"'{text}' is no time; examples: 90s, 20min, 2h")
    return float(found[1]) * UNITS[found[2]]


def arguments():
    parser = argparse.ArgumentParser(prog="./undine study", description="Runs a scene with many settings and tells what "
                                     "accuracy costs. Finished runs are kept: the same command goes on after a stop.")
    parser.add_argument("study", metavar="STUDY.prm")
    parser.add_argument("--out", metavar="DIR", help="folder for runs and results (default: output/studies/NAME)")
    parser.add_argument("--jobs", metavar="N", type=int, default=len(os.sched_getaffinity(0)),
                        help="processors to use (default: all)")
    parser.add_argument("--within", metavar="TIME", type=duration,
                        help="leave out the dearest runs so that all ends within this time, such as 20min")
    parser.add_argument("--results-only", action="store_true", help="make no runs: tables and pictures of those that are there")
    parser.add_argument("--program", default=os.environ.get("UNDINE_PROGRAM", "build/undine"), help=argparse.SUPPRESS)
    return parser.parse_args()


def main():
    options = arguments()
    name = os.path.splitext(os.path.basename(options.study))[0]
    folder = options.out or os.path.join("output", "studies", name)
    study, results, folders = campaign.of_file(options.program, options.study, folder, options.jobs,
                                               0 if options.results_only else options.within)
    if options.results_only and all(result.get("left out") for result in results.values()):
        sys.exit(f"Error: '{folder}' has no runs of this study by this program. Call it without --results-only.")
    found = analysis.Analysis(options.program, study, results, folders)
    files = report.write(found, folder)
    print(report.text(found))
    print("written: " + ", ".join(files))
    for quantity, reason in found.unevaluated.items():
        print(f"study: '{quantity}' was not evaluated: {reason}", file=sys.stderr)
    sys.exit(1 if found.unevaluated else 0)


if __name__ == "__main__":
    main()
