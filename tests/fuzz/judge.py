# SPDX-License-Identifier: LGPL-2.1-or-later
"""Put a case to the program: validated, and if accepted run, run again, stopped and resumed."""
import dataclasses
import os
import random
import shutil
import threading

import expressions
import file_mutations
import misreadings
import result_files
import verdicts

MOST_SIZE = 20000  # cells or particles of what is run here
STEPS_BETWEEN = "Time/Maximum steps"


@dataclasses.dataclass
class Outcome:
    """`answer`: refused, accepted, run, failed, stopped, or too large to be run here."""
    answer: str
    found: list  # pairs (verdict, detail)
    seconds: float = 0.
    starts: int = 0


class Judge:
    """`steps`: to be run, 0 if cases are only validated; `ranks`: on how many."""

    def __init__(self, program, key_types, work, steps=0, ranks=(1,)):
        self.program = program
        self.key_types = key_types
        self.work = work
        self.steps = steps
        self.ranks = ranks
        self.of_seeds = {}  # name of a seed -> (lock, folder, outcome)
        self.lock = threading.Lock()

    def judge(self, case, name, seeds_by_name=None):
        """In the folder `name`, which is removed afterwards. `seeds_by_name`: what equivalent cases come from."""
        folder = self.work / name
        try:
            outcome = self.judge_in(case, folder)
            if case.equivalent and seeds_by_name:
                outcome.found += self.difference_from_seed(case, folder, outcome, seeds_by_name)
            return outcome
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def judge_in(self, case, folder):
        case.write(folder)
        outcome = Outcome("refused", [])
        before = tree(folder)
        result = self.start(outcome, folder, case.validation())
        outcome.found += verdicts.of_end(result) + verdicts.of_message(case, result)
        if tree(folder) != before:
            outcome.found.append(("wrote elsewhere", "--validate writes or removes files"))
        if result.code == 0 and not case.words and "no mistakes found" in result.out:
            outcome.answer = "accepted"
            scene = misreadings.read_case(case)
            outcome.found += [("misread", text) for text in misreadings.misreadings(scene, self.key_types)]
            if self.steps and size(scene) > MOST_SIZE:
                outcome.answer = "too large"
            elif self.steps and not outcome.found:
                self.run(case, folder, scene, outcome)
        return outcome

    def start(self, outcome, folder, arguments, ranks=1, may_be_stopped=False):
        result = self.program.run(arguments, folder, ranks, may_be_stopped)
        outcome.seconds += result.seconds
        outcome.starts += 1
        return result

    def run(self, case, folder, scene, outcome):
        before = tree(folder)
        codes = {}
        for ranks in self.ranks:
            output = self.output(case, ranks)
            result = self.start(outcome, folder, case.run(self.steps, output), ranks, may_be_stopped=True)
            if ranks > 1 and scene.values.get("Scheme") == "particle":
                outcome.found += verdicts.of_particles(case, result)
                continue
            codes[ranks] = result.code
            outcome.answer = "stopped" if result.too_long else "run" if result.code == 0 else "failed"
            outcome.found += self.faults_of_run(case, result, folder / os.path.normpath(output), scene)
            if outcome.found or result.too_long:
                return
        self.compare_ranks(case, folder, codes, outcome)
        outside = tree(folder).symmetric_difference(before)
        own = tuple(os.path.normpath(self.output(case, ranks)) + "/" for ranks in codes)
        if not all(name.startswith(own) for name, _ in outside):
            outcome.found.append(("wrote elsewhere", "a run writes outside of its folder"))
        if codes.get(self.ranks[0]) == 0 and not outcome.found:
            self.repeat(case, folder, outcome)
            self.resume(case, folder, outcome)

    def output(self, case, ranks):
        return case.output if ranks == self.ranks[0] else f"./{case.results()} on {ranks} ranks"

    def faults_of_run(self, case, result, results, scene):
        found = verdicts.of_end(result) + verdicts.of_message(case, result)
        if result.code == 2 and "step " not in result.err:
            found.append(("validate and run differ", verdicts.plain(result.err)))
        if os.path.isdir(results):  # not a method of pathlib: the name may be too long
            found += result_files.faults(results)
        if not found and os.path.isfile(results / "parameters.json"):
            used = result_files.read_json(results / "parameters.json")
            found += [("misread", text) for text in misreadings.misreadings(self.with_steps(scene), self.key_types, used)]
        return found

    def with_steps(self, scene):
        return dataclasses.replace(scene, values={**scene.values, STEPS_BETWEEN: str(self.steps)})

    def compare_ranks(self, case, folder, codes, outcome):
        first, *others = codes or [None]
        for ranks in others:
            if codes[ranks] != codes[first]:
                outcome.found.append(("ranks differ", f"exit code {codes[first]} on {first}, {codes[ranks]} on {ranks}"))
            elif codes[first] == 0:
                one, other = (result_files.content(folder / os.path.normpath(self.output(case, number)), "statistics")
                              .split(b"\n") for number in (first, ranks))
                if len(one) != len(other) or [line for line in one if line[:1] == b"#"] != [
                        line for line in other if line[:1] == b"#"]:
                    outcome.found.append(("ranks differ", "columns or number of rows of statistics"))

    def repeat(self, case, folder, outcome):
        """The parameters.prm that a run wrote gives the same run."""
        result = self.start(outcome, folder, [f"./{case.results()}/parameters.prm", "--output", "again"], self.ranks[0])
        found = verdicts.of_end(result)
        if not found and result.code != 0:
            found = [("not repeatable", f"exit code {result.code}: {verdicts.plain(result.err)}")]
        found = found or [("not repeatable", text) for text in result_files.same_run(folder / case.results(), folder / "again")]
        outcome.found += found

    def resume(self, case, folder, outcome):
        """A run that goes on from a checkpoint gives the same run; damaged files may be refused."""
        result = self.start(outcome, folder, case.run(1, "part"), self.ranks[0])
        if result.code != 0 or outcome.found or not (folder / "part/checkpoint").is_dir():
            return
        damaged = self.damage(case, folder / "part")
        result = self.start(outcome, folder, ["resume", "part", "--set", f"{STEPS_BETWEEN}={self.steps}"], self.ranks[0])
        outcome.found += verdicts.of_end(result)
        if result.code != 0 and not damaged and not outcome.found:
            outcome.found.append(("resume differs", f"exit code {result.code}: {verdicts.plain(result.err)}"))
        elif result.code == 0:
            found = [] if damaged else result_files.faults(folder / "part")
            outcome.found += found or [("resume differs", f"{text}{damaged}") for text in
                                       result_files.same_run(folder / case.results(), folder / "part")]
        elif not outcome.found and not result.err.strip():
            outcome.found.append(("unclear message", f"none, exit code {result.code}"))

    def damage(self, case, results):
        """In half of all cases bytes of one file are changed; says what was damaged."""
        rng = random.Random(str(case.files))
        files = sorted(path for path in results.rglob("*") if path.is_file() and (
            path.name in ("statistics", "record.txt") or path.parent == results / "checkpoint"))
        if rng.random() < 0.5 or not files:
            return ""
        path = rng.choice(files)
        path.write_bytes(file_mutations.changed_bytes(rng, path.read_bytes()))
        return f", {path.name} damaged"

    def difference_from_seed(self, case, folder, outcome, seeds_by_name):
        """The case and the scene it comes from must be answered alike."""
        seed = seeds_by_name[case.seed]
        with self.lock:
            lock = self.of_seeds.setdefault(case.seed, [threading.Lock(), None])
        original = self.work / ("seed_" + case.seed.replace("/", "_"))
        with lock[0]:
            if lock[1] is None:
                lock[1] = self.judge_in(seed, original)
        if "stopped" in (lock[1].answer, outcome.answer):
            return []  # for their time, which says nothing about the edits
        if lock[1].answer != outcome.answer:
            why = "".join(f" ({verdict}: {detail})" for verdict, detail in lock[1].found)
            return [("equivalent differs", f"{outcome.answer}, but {lock[1].answer} without the edits{why}")]
        if outcome.answer == "run":
            return [("equivalent differs", text) for text in
                    result_files.same_run(folder / case.results(), original / seed.results())]
        return []


def tree(folder):
    """Names and sizes of all files."""
    return {(os.path.relpath(os.path.join(place, name), folder), os.path.getsize(os.path.join(place, name)))
            for place, _, names in os.walk(folder) for name in names}


def size(scene):
    """Number of cells or particles, roughly; infinite if it cannot be told."""
    if not scene.judged:
        return 1e300
    try:
        total = cells_of(scene, "Domain", 2) if "Particles/Spacing" not in scene.values else particles_of(scene)
        for path in scene.values:
            if path.startswith("Bodies/") and path.count("/") == 2 and path.endswith("/Density"):
                total += cells_of(scene, path.rpartition("/")[0], 3)
        return total
    except (expressions.NoExpression, expressions.Unknown, ArithmeticError, TypeError):
        return 1e300


def cells_of(scene, section, per_refinement):
    result = 1.
    for word in scene.values.get(f"{section}/Cells", "1").split(","):
        result *= expressions.constant(word.strip()) if word.strip() else 1
    return result * 2 ** (per_refinement * expressions.constant(scene.values.get(f"{section}/Refinements", "0")))


def particles_of(scene):
    spacing = expressions.constant(scene.values["Particles/Spacing"])
    result = 1.
    for lower, upper in zip(*(misreadings.entries(scene.values.get(f"Domain/{key} corner", ""))
                              for key in ("Lower", "Upper"))):
        result *= abs(expressions.constant(upper) - expressions.constant(lower)) / spacing + 4
    return result
