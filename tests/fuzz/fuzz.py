#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The mutating tester: spoils scenes, meshes and command lines at random and judges what the program does.

usage: fuzz.py PROGRAM [--cases N] [--first K] [--seed S] [--jobs J] [--run STEPS] [--ranks R ...] [--minimise]
               [--keep DIR] [--log FILE] [--work DIR] [--limit SECONDS] [--memory GB] [--time SECONDS]
               [--launcher "COMMAND -n {ranks}"] [--only K ...] [--unmutated] [--fork-server]

Case k of seed S is the same whatever the other options. Every case is validated; with --run what is accepted is
also run for so many steps on each number of ranks, run again from the parameters.prm that it wrote, and stopped and
resumed. Verdicts are explained in tests/fuzz/README.md. The exit code is 1 if anything is wrong.
"""
import sys

sys.dont_write_bytecode = True

import argparse  # noqa: E402  what follows must not leave compiled files in the sources
import collections  # noqa: E402
import concurrent.futures  # noqa: E402
import json  # noqa: E402
import pathlib  # noqa: E402
import shlex  # noqa: E402
import shutil  # noqa: E402
import signal  # noqa: E402
import tempfile  # noqa: E402
import time  # noqa: E402
import traceback  # noqa: E402

import cases as making  # noqa: E402
import fork_server  # noqa: E402
import judge as judging  # noqa: E402
import key_types  # noqa: E402
import minimise  # noqa: E402
import process  # noqa: E402
import seeds  # noqa: E402
import verdicts  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0],
                                     epilog="Explained in tests/fuzz/README.md.")
    parser.add_argument("program")
    parser.add_argument("--cases", type=int, default=200, help="how many")
    parser.add_argument("--first", type=int, default=0, help="number of the first case")
    parser.add_argument("--only", type=int, nargs="+", help="these cases instead")
    parser.add_argument("--unmutated", action="store_true", help="the scenes as they are, made small")
    parser.add_argument("--seed", default="1", help="of the random numbers")
    parser.add_argument("--jobs", type=int, default=2, help="cases at a time")
    parser.add_argument("--run", type=int, default=0, metavar="STEPS", help="run what is accepted")
    parser.add_argument("--ranks", type=int, nargs="+", default=[1], help="run it on each of these numbers of ranks")
    parser.add_argument("--launcher", default="", help="starts the program on {ranks} ranks; default: mpirun for several")
    parser.add_argument("--fork-server", action="store_true", help="starts on one rank are copies of a loaded program")
    parser.add_argument("--minimise", action="store_true", help="the first case of each fault")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the first case of each fault")
    parser.add_argument("--log", type=pathlib.Path, help="one line of JSON for each case, written as they end")
    parser.add_argument("--work", type=pathlib.Path, help="folder for what runs write; default: a temporary one")
    parser.add_argument("--limit", type=float, default=20., metavar="SECONDS", help="for one start of the program")
    parser.add_argument("--memory", type=float, default=2., metavar="GB", help="for one start of the program")
    parser.add_argument("--time", type=float, metavar="SECONDS", help="begin no case after this time")
    return parser.parse_args()


class Campaign:
    """Judges cases, several at a time, and collects what is wrong."""

    def __init__(self, options, work):
        self.options = options
        self.until = time.monotonic() + options.time if options.time else float("inf")
        launcher = " ".join(shlex.quote(executable(word)) for word in shlex.split(options.launcher))
        program = process.Program(executable(options.program), launcher,
                                  process.Limits(options.limit, options.memory), servers(options))
        kinds = key_types.KeyTypes(reference(program, work))
        all_seeds = seeds.read_seeds(ROOT)
        self.seeds = {one.seed: one for one in all_seeds}
        self.cases = making.Cases(all_seeds, kinds, options.seed)
        self.judge = judging.Judge(program, kinds, work, options.run, options.ranks)
        self.answers = collections.Counter()
        self.wrong = collections.Counter()  # verdict -> cases
        self.faults = {}  # (verdict, detail) -> numbers of cases
        self.n_cases = self.n_wrong = self.starts = 0
        self.seconds = 0.

    def make(self, number):
        if not self.options.unmutated:
            return self.cases.make(number)
        return list(self.seeds.values())[number].copy()

    def numbers(self):
        if self.options.unmutated:
            return range(len(self.seeds))
        return self.options.only or range(self.options.first, self.options.first + self.options.cases)

    def one(self, number):
        """A case and its outcome; a mistake of the tester itself is an outcome as well."""
        case = self.make(number)
        try:
            return number, case, self.judge.judge(case, f"case_{number}", self.seeds)
        except Exception:  # whatever it is, the other cases go on
            return number, case, judging.Outcome("tester", [("tester", traceback.format_exc())])

    def all(self):
        """Outcomes as they come; no more cases wait than are needed to keep all jobs busy."""
        numbers = iter(self.numbers())
        pool = concurrent.futures.ThreadPoolExecutor(self.options.jobs)
        waiting = set()
        try:
            while True:
                while len(waiting) < 2 * self.options.jobs and time.monotonic() < self.until:
                    number = next(numbers, None)
                    if number is None:
                        break
                    waiting.add(pool.submit(self.one, number))
                if not waiting:
                    return
                done, waiting = concurrent.futures.wait(waiting, return_when="FIRST_COMPLETED")
                for future in done:
                    yield future.result()
        finally:
            pool.shutdown(cancel_futures=True)

    def go(self):
        log = open(self.options.log, "a", encoding="utf-8") if self.options.log else None
        for number, case, outcome in self.all():
            self.count(number, outcome)
            if log:
                log.write(json.dumps({"case": number, "scene": case.seed, "mutations": case.mutations,
                                      "answer": outcome.answer, "found": outcome.found,
                                      "seconds": round(outcome.seconds, 3), "starts": outcome.starts}) + "\n")
                log.flush()
        if log:
            log.close()

    def count(self, number, outcome):
        self.n_cases += 1
        self.n_wrong += bool(outcome.found)
        self.answers[outcome.answer] += 1
        self.wrong.update({verdict for verdict, _ in outcome.found})
        self.starts += outcome.starts
        self.seconds += outcome.seconds
        for verdict, detail in outcome.found:
            numbers = self.faults.setdefault((verdict, verdicts.plain(detail) if verdict != "tester" else detail), [])
            if not numbers:
                print(f"case {number}: {verdict}: {detail}", flush=True)
            numbers.append(number)

    def keep(self):
        """The first case of each fault, minimised if asked for, with the command that shows it."""
        for place, (fault, numbers) in enumerate(sorted(self.faults.items())):
            case = self.make(min(numbers))
            if self.options.minimise and fault[0] != "tester":
                case = self.smallest(case, fault, place)
            folder = self.options.keep / f"{fault[0].replace(' ', '_')}_{min(numbers)}_{place}"
            case.write(folder)
            (folder / "fault.txt").write_text(describe(case, fault, numbers, self.options), "utf-8", "backslashreplace")

    def smallest(self, case, fault, place):
        def shows(other):
            found = self.judge.judge(other, f"minimise_{place}", self.seeds).found
            return fault in [(verdict, verdicts.plain(detail)) for verdict, detail in found]
        return minimise.Minimiser(shows).minimise(case)


def executable(program):
    """Without folders that are relative: it is started elsewhere."""
    path = pathlib.Path(program)
    return str(path.resolve()) if path.is_file() else program


def servers(options):
    if not options.fork_server:
        return None
    return fork_server.ForkServers(executable(options.program), options.jobs, process.scene_tools.environment())


def reference(program, work):
    """What the program prints about its keys; without it nothing can be judged."""
    result = program.run(["--reference"], work)
    if result.code != 0 or "| key |" not in result.out:
        sys.exit(f"--reference must work: exit code {result.code}\n{result.err}")
    return result.out


def describe(case, fault, numbers, options):
    words = [options.program, *(case.run(options.run, case.output) if options.run else case.validation())]
    return (f"{fault[0]}: {fault[1]}\ncases {numbers[:20]}{' ...' if len(numbers) > 20 else ''} of seed {options.seed}\n"
            f"scene {case.seed}, mutations: {', '.join(case.mutations)}\nin this folder:\n"
            f"{' '.join(shlex.quote(word) for word in words)}\n")


def table(campaign):
    lines = [f"{answer:>10} {count}" for answer, count in sorted(campaign.answers.items())]
    lines += ["", "verdict                  cases"]
    lines += [f"{verdict:<24} {campaign.wrong[verdict]}" for verdict in (*verdicts.KINDS, "tester")
              if campaign.wrong[verdict] or verdict != "tester"]
    for (verdict, detail), numbers in sorted(campaign.faults.items(), key=lambda item: -len(item[1])):
        lines.append(f"{len(numbers):6} x {verdict}: {detail} (case {min(numbers)})")
    return "\n".join(lines)


def main():
    options = arguments()
    begin = time.monotonic()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("stopped"))  # so that what was written is removed
    if options.work:
        options.work.mkdir(parents=True, exist_ok=True)
    work = pathlib.Path(tempfile.mkdtemp(prefix="fuzz_", dir=options.work)).resolve()
    try:
        campaign = Campaign(options, work)
        campaign.go()
        if options.keep:
            campaign.keep()
    finally:
        shutil.rmtree(work, ignore_errors=True)
    seconds = time.monotonic() - begin
    print(table(campaign))
    print(f"{campaign.starts} starts of the program, {campaign.seconds / max(1, campaign.starts):.3f} s each; "
          f"{seconds:.1f} s altogether")
    print(f"{campaign.n_cases} cases, {campaign.n_wrong} wrong")
    sys.exit(1 if campaign.n_wrong or not campaign.n_cases else 0)


if __name__ == "__main__":
    main()
