#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs are stopped at random moments, go on, and must end as if nothing had happened.

A moment is a scene (kill_scenes.py) on one or two ranks that is hit once or twice: by SIGKILL, SIGTERM or SIGINT to
its ranks, to one of them or to mpirun, by a second SIGTERM, or by a full disk; while it starts, at any time, while it
writes a checkpoint or another file, or at its end. Each time it goes on, also on other numbers of ranks. Then:

- statistics and files for ParaView are those of the uninterrupted run: to the bit on the same ranks, else the
  statistics to 1e-8;
- a kill and a full disk lose at most one interval of checkpoints, SIGTERM and SIGINT no accepted step;
- after SIGTERM and SIGINT the exit code is 7 and it is said how to go on, on a full disk it is 4, with a reason;
- what is there after a hit is valid, after the end nothing temporary is left, and foreign files stay.

Prints a table of what happened. Exit code 1 if anything was wrong; those folders are kept.
"""
import argparse
import collections
import concurrent.futures
import itertools
import os
import random
import shutil
import signal
import sys
import tempfile

import kill_faults as faults
import kill_scenes
from kill_trial import Launcher, Moment, Trial, run_reference

INTERVALS = (1, 3, 7)  # steps between checkpoints
SIGNALS = (signal.SIGKILL, signal.SIGTERM, signal.SIGINT)
REFERENCE_RANKS = (1, 2)


def draw_time(generator, reference):
    """When a signal strikes."""
    kind = generator.choices(("start", "any", "checkpoint", "frame", "end"), (3, 7, 5, 3, 2))[0]
    if kind == "start":
        return faults.AfterSeconds(generator.uniform(0, 1.2 * reference.start))
    if kind == "any":
        return faults.AfterSeconds(generator.uniform(0, reference.seconds))
    if kind == "end":
        return faults.AtTheEnd(reference.last_step, generator.uniform(0, 0.1))
    pattern = {"checkpoint": "checkpoint/*.part", "frame": "solution*/*.part"}[kind]
    return faults.WhileWriting(pattern, generator.randint(1, 5))


def draw_hit(generator, ranks, reference, disks):
    """A fault, and its time, None for one that finds it itself."""
    weights = (16, 1 if ranks > 1 else 0, 4 if disks.serve(ranks) else 0)
    kind = generator.choices(("signal", "second signal", "full disk"), weights)[0]
    if kind == "full disk":
        return faults.FullDisk(generator.uniform(0.01, 0.95)), None
    if kind == "second signal":
        return faults.SecondSignal(), faults.AfterSeconds(
            generator.uniform(0.3, 0.8) * reference.seconds)
    to = generator.choice(("ranks", "a rank", "launcher")) if ranks > 1 else "ranks"
    return faults.Signal(generator.choice(SIGNALS), to), draw_time(generator, reference)


def draw_moment(number, arguments, references, disks):
    """The same for the same seed, but for the times, which are shares of those of the references."""
    generator = random.Random(f"{arguments.seed} {number}")
    scene = kill_scenes.SCENES[number % len(kill_scenes.SCENES)]
    most = min(scene.most_ranks, arguments.most_ranks)
    first = min(most, 1 + number // len(kill_scenes.SCENES) % 2)
    others = range(1, most + 1)
    ranks = [first] + generator.choices([first] * 3 + list(others), k=generator.choice((1, 1, 2)))
    hits = [draw_hit(generator, at, references[scene.name, min(at, 2)], disks) for at in ranks[:-1]]
    return Moment(number, scene, tuple(ranks), generator.choice(INTERVALS), tuple(hits))


def make_references(launcher, scenes, most_ranks, work, pool):
    """The uninterrupted runs, by scene and ranks."""
    def make(case):
        scene, ranks = case
        folder = os.path.join(work, f"{kill_scenes.SCENES.index(scene)}_on_{ranks}")
        reference = run_reference(launcher, scene, ranks, folder)
        print(f"{scene.name}, {ranks} rank(s): {reference.last_step} steps in "
              f"{reference.seconds:.1f} s, {reference.bytes / 1e6:.1f} MB", flush=True)
        return (scene.name, ranks), reference

    cases = itertools.product(scenes, REFERENCE_RANKS)
    return dict(pool.map(make, [case for case in cases
                                if case[1] <= min(case[0].most_ranks, most_ranks)]))


def print_table(outcomes):
    """What the hits have done."""
    by_fault = collections.defaultdict(list)
    for outcome in outcomes:
        by_fault[str(outcome.fault)].append(outcome)
    ends = ("stopped", "killed", "killed at start", "ended before", "hung")
    columns = ("hits",) + ends + ("most steps lost", "locks left", "files torn")
    print(f"\n{'':36}" + "".join(f"{column:>17}" for column in columns))
    for fault, hits in sorted(by_fault.items()):
        numbers = [len(hits)] + [sum(hit.end == end for hit in hits) for end in ends]
        numbers += [max(hit.steps_lost for hit in hits), sum(hit.lock_left for hit in hits),
                    sum(hit.torn for hit in hits)]
        print(f"{fault:36}" + "".join(f"{number:>17}" for number in numbers))


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--moments", type=int, default=100)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--most-ranks", type=int, default=3, help="for machines of few processors")
    parser.add_argument("--only", type=int, metavar="NUMBER", help="carry out this moment alone")
    parser.add_argument("--jobs", type=int, default=1, help="moments at the same time")
    parser.add_argument("--launcher", metavar="COMMAND",
                        help="what starts the program on {ranks} ranks (default: mpirun, from two on)")
    parser.add_argument("--work", metavar="DIR", help="folder for all runs (default: a temporary one)")
    parser.add_argument("--time", type=float, default=600,
                        help="wall seconds after which a run counts as hung")
    return parser.parse_args()


def main():
    arguments = read_arguments()
    if arguments.work:
        os.makedirs(arguments.work, exist_ok=True)
    work = tempfile.mkdtemp(prefix="kills.", dir=arguments.work)
    launcher, disks = Launcher(arguments.program, arguments.launcher), faults.SmallDisks()
    print(disks.describe(), flush=True)
    numbers = range(arguments.moments) if arguments.only is None else [arguments.only]
    scenes = kill_scenes.SCENES
    if arguments.only is not None:
        scenes = [scenes[arguments.only % len(scenes)]]

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        references = make_references(launcher, scenes, arguments.most_ranks, work, pool)

        def carry_out(number):
            moment = draw_moment(number, arguments, references, disks)
            folder = os.path.join(work, f"moment_{number}")
            trial = Trial(moment, launcher, references, disks, folder, arguments.time)
            problem = trial.carry_out()
            print(f"{moment}: {', '.join(outcome.end for outcome in trial.outcomes)}"
                  + (f"\n  WRONG: {problem}\n  see {folder}" if problem else ""), flush=True)
            if not problem:
                shutil.rmtree(folder)
            return trial.outcomes, problem

        results = list(pool.map(carry_out, numbers))
    print_table([outcome for outcomes, _ in results for outcome in outcomes])
    wrong = sum(problem is not None for _, problem in results)
    if not wrong:
        shutil.rmtree(work)
    print(f"\n{len(results)} moments, {wrong} wrong")
    sys.exit(1 if wrong else 0)


main()
