# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs a study: a scene with many settings, to see what accuracy costs.

usage: ./undine study STUDY.prm... [--out DIR] [--jobs N] [--within 20min] [--results-only]

Several studies also have their diagrams side by side in one picture.
"""
import argparse
import os
import sys

from study import analysis, campaign, description, plots, report, stability, stability_report
from study.duration import duration


def arguments():
    parser = argparse.ArgumentParser(prog="./undine study", description="Runs a scene with many settings and tells what "
                                     "accuracy costs. Finished runs are kept: the same command goes on after a stop.")
    parser.add_argument("studies", metavar="STUDY.prm", nargs="+", help="several: also side by side in one picture")
    parser.add_argument("--out", metavar="DIR", help="folder for runs and results (default: output/studies/NAME); of several "
                        "studies: in which each has one (default: output/studies)")
    parser.add_argument("--jobs", metavar="N", type=int, default=len(os.sched_getaffinity(0)),
                        help="processors to use (default: all)")
    parser.add_argument("--within", metavar="TIME", type=duration,
                        help="leave out the dearest runs so that all ends within this time, such as 20min")
    parser.add_argument("--results-only", action="store_true", help="make no runs: tables and pictures of those that are there")
    parser.add_argument("--program", default=os.environ.get("UNDINE_PROGRAM", "build/undine"), help=argparse.SUPPRESS)
    return parser.parse_args()


def name_of(file):
    return os.path.splitext(os.path.basename(file))[0]


def carry_out(options, file, folder):
    """The analysis of one study, after its results are written."""
    if description.read(options.program, file).ranges():
        found = stability.of_file(options.program, file, folder, options.jobs, 0 if options.results_only else options.within)
        if not found.lines():
            sys.exit(f"Error: no run of this study has a verdict in '{folder}'. Call it without --results-only, or with more time.")
        print(stability_report.text(found))
        print("written: " + ", ".join(stability_report.write(found, folder)))
        return found
    study, results, folders = campaign.of_file(options.program, file, folder, options.jobs,
                                               0 if options.results_only else options.within)
    if options.results_only and all(result.get("left out") for result in results.values()):
        sys.exit(f"Error: '{folder}' has no runs of this study by this program. Call it without --results-only.")
    found = analysis.Analysis(options.program, study, results, folders)
    files = report.write(found, folder)
    print(report.text(found))
    print("written: " + ", ".join(files))
    for quantity, reason in found.unevaluated.items():
        print(f"study: '{quantity}' was not evaluated: {reason}", file=sys.stderr)
    return found


def main():
    options = arguments()
    names = [name_of(file) for file in options.studies]
    if len(set(names)) < len(names):
        sys.exit("Error: two of the studies have files of the same name, so that their results would be in one folder.")
    if len(names) == 1:
        found = [carry_out(options, options.studies[0], options.out or os.path.join("output", "studies", names[0]))]
    else:
        parent = options.out or os.path.join("output", "studies")
        found = [carry_out(options, file, os.path.join(parent, name)) for file, name in zip(options.studies, names)]
        drawn = [each for each in found if each.quantities]
        for kind in ("svg", "png") if drawn else ():
            path = os.path.join(parent, f"{'+'.join(names)}.{kind}")
            plots.side_by_side(drawn, path)
            print(f"written: {path}")
    sys.exit(1 if any(each.unevaluated for each in found) else 0)


if __name__ == "__main__":
    main()
