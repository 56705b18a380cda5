#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tiny studies of each kind, as users run them: orders of convergence, budgets, files, resumption after a kill, limits of
time, and what is said of mistakes.

usage: check_study.py PROGRAM STUDIES PART
"""
import csv
import glob
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import xml.dom.minidom

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FILES = ("study.md", "study.csv", "study.tex", "study.json", "index.html", "work_precision_1.svg", "work_precision_1.png")


def command(program, study, out, *options):
    return ["/usr/bin/python3", "-B", "-m", "study", study, "--program", program, "--out", out, *options]


def environment():
    return dict(os.environ, PYTHONPATH=ROOT)


def run(*arguments):
    return subprocess.run(command(*arguments), env=environment(), capture_output=True, text=True)


def require(condition, what):
    if not condition:
        sys.exit(f"check_study.py: {what}")


def results(program, studies, name, folder):
    """The results of a study by quantity, after its files were looked at."""
    out = os.path.join(folder, name)
    done = run(program, os.path.join(studies, f"{name}.prm"), out)
    require(done.returncode == 0, f"{name}: exit code {done.returncode}\n{done.stdout}\n{done.stderr}")
    for file in FILES:
        require(os.path.getsize(os.path.join(out, file)) > 100, f"{name}: {file} is missing or empty")
    xml.dom.minidom.parse(os.path.join(out, "work_precision_1.svg"))
    with open(os.path.join(out, "study.json")) as file:
        data = json.load(file)
    with open(os.path.join(out, "study.csv")) as file:
        require(len(list(csv.DictReader(file))) == len(data["runs"]), f"{name}: study.csv lacks runs")
    return {quantity["name"]: quantity for quantity in data["quantities"]}


def own_orders(quantity):
    return [row["own"] for row in quantity["orders"]]


def check_kinds(program, studies, folder):
    solid = results(program, studies, "solid", folder)
    require(all(order and order > 1.7 for order in own_orders(solid["sag over time"])),
            f"orders of the cantilever's sag: {own_orders(solid['sag over time'])}")
    fluid = results(program, studies, "fluid", folder)
    require(own_orders(fluid["velocity"])[0] > 1.8, f"order of the vortices: {own_orders(fluid['velocity'])}")
    coupled = results(program, studies, "coupled", folder)
    tip, force = coupled["tip"], coupled["force"]
    require(tip["budget"][0]["refined"] == "step" and own_orders(tip)[0] > 1.8, f"budget of the piston: {tip}")
    require(own_orders(force)[0] > 1.2, f"order of the force as the rate of its impulse: {own_orders(force)}")
    particles = results(program, studies, "particles", folder)["energy"]
    require("two values only" in particles["warnings"][0], f"warnings of particles: {particles['warnings']}")


def finished(out):
    """Times at which results of runs were written, by folder."""
    found = {}
    for folder, _, files in os.walk(os.path.join(out, "cases")):
        if "result.json" in files:
            found[folder] = os.path.getmtime(os.path.join(folder, "result.json"))
    return found


def ended(out):
    """Folders whose run has come to its end, whether or not the study knows of it."""
    found = set()
    for path in glob.glob(os.path.join(out, "cases", "*", "run", "summary.json")):
        with open(path) as file:
            if json.load(file)["ended"]:
                found.add(path)
    return found


def processes_about(text):
    """Command lines of running processes in which the text occurs."""
    found = []
    for entry in os.scandir("/proc"):
        if entry.name.isdigit():
            try:
                with open(os.path.join(entry.path, "cmdline"), "rb") as file:
                    line = file.read().decode(errors="replace")
            except OSError:  # it has just ended
                continue
            if text in line:
                found.append(line.replace("\0", " "))
    return found


def check_kill(program, studies, folder):
    """What has ended before a kill is not made again, and nothing goes on running."""
    out = os.path.join(folder, "killed")
    study = os.path.join(studies, "solid.prm")
    process = subprocess.Popen(command(program, study, out, "--jobs", "1"), env=environment(), stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    for _ in range(600):
        time.sleep(0.05)
        if len(finished(out)) >= 2:
            break
    process.send_signal(signal.SIGKILL)
    process.wait()
    before, ended_before = finished(out), ended(out)
    for _ in range(100):  # a process that is killed may take its time on a loaded machine, but it must not go on
        left = processes_about(out)
        if not left:
            break
        time.sleep(0.1)
    require(not left, f"after a kill there are still processes {left}")
    require(ended(out) == ended_before, "a run went on to its end after a kill")
    require(2 <= len(before) < 8, f"{len(before)} runs had ended before the kill")
    done = run(program, study, out)
    require(done.returncode == 0, f"resumption: {done.stderr}")
    after = finished(out)
    require(len(after) == 8 and all(after[case] == then for case, then in before.items()),
            "resumption has made finished runs again")


def check_limit(program, studies, folder):
    done = run(program, os.path.join(studies, "solid.prm"), os.path.join(folder, "limited"), "--jobs", "1", "--within", "0.5")
    require("left out" in done.stderr, f"a limit of half a second leaves out nothing:\n{done.stderr}")


# Scene of benchmarks/estimates: its column, settings, and for each thing its key with values that are good and bad.
BUDGETS = {
    "bar": ("tip displacement y", {"Time/End": 0.3}, {
        "step": ("Time/Step", "1/200 | 1/400", "1/20 | 1/80"),
        "elements": ("Bodies/bar/Cells", "24, 3 | 48, 6", "4, 1 | 16, 2")}),
    "panel": ("corner displacement x", {"Time/Integrator": "static", "Time/Step": 0.05, "Time/End": 0.05,
                                       "Bodies/panel/Boundaries/pushed/Traction": "3e4; 0"}, {
        "elements": ("Bodies/panel/Cells", "16, 16 | 32, 32", "2, 2 | 8, 8"),
        "corrections": ("Solid numerics/Newton iterations", "5 | 6", "1 | 5")}),
    "disc": ("behind velocity x", {"Time/End": 0.6}, {
        "step": ("Time/Step", "1/20 | 1/40", "1/2 | 1/20"),
        "cells": ("Domain/Cells", "48, 24 | 64, 32", "10, 5 | 40, 20")}),
    "column": ("Kinetic energy of fluid", {"Time/End": 0.1}, {
        "spacing": ("Particles/Spacing", "0.02 | 0.016", "0.1 | 0.025"),
        "tolerance": ("Particles/Pressure/Tolerance", "1e-5 | 1e-6", "0.1 | 1e-4")}),
}


def budget_study(scene, bad):
    """A study of which one thing is made bad on purpose."""
    column, settings, things = BUDGETS[scene]
    settings = "\n".join(f"  set {key} = {value}" for key, value in settings.items())
    text = f"""set Scene = {ROOT}/benchmarks/estimates/{scene}.prm
set Combine = one at a time
set Repeat below = 0
subsection Settings
{settings}
end
subsection Quantities
  subsection q
    set Columns = {column}
    set Evaluate = over time
  end
end
subsection Vary
"""
    for name, (key, good, worse) in things.items():
        text += (f"subsection {name}\n set Lengths = 2, 1\n subsection Settings\n  set {key} = "
                 f"{worse if name == bad else good}\n end\nend\n")
    return text + "end\n"


def check_budgets(program, _, folder):
    """What is made bad on purpose is named first."""
    for scene, bad in (("bar", "step"), ("bar", "elements"), ("panel", "corrections"), ("disc", "cells"),
                       ("column", "spacing")):
        path, out = os.path.join(folder, f"{scene}_{bad}.prm"), os.path.join(folder, f"{scene}_{bad}")
        with open(path, "w") as file:
            file.write(budget_study(scene, bad))
        done = run(program, path, out)
        require(done.returncode == 0, f"{scene} with bad {bad}: {done.stderr}")
        with open(os.path.join(out, "study.json")) as file:
            budget = json.load(file)["quantities"][0]["budget"]
        require(budget[0]["refined"] == bad and budget[0]["moves by"] > 1.5 * budget[1]["moves by"],
                f"{scene} with bad {bad}: {budget}")


def check_map(program, studies, folder):
    """A map of stability: splitting fails where the fluid is heavy, from a density on that bisection finds, and which linear
    theory foretells; solved together all holds."""
    out = os.path.join(folder, "stability")
    done = run(program, os.path.join(studies, "stability.prm"), out)
    require(done.returncode == 0, f"stability: {done.stdout}{done.stderr}")
    for file in ("stability.md", "stability.svg", "stability.png", "index.html"):
        require(os.path.getsize(os.path.join(out, file)) > 100, f"stability: {file} is missing or empty")
    with open(os.path.join(out, "stability.csv")) as file:
        rows = list(csv.DictReader(file))
    for step in ("1/100", "1/200"):
        together, in_turns = ([(float(row["density of the fluid"]), row["verdict"]) for row in rows
                               if row["scheme"] == scheme and row["step"] == step] for scheme in ("simultaneous", "splitting u"))
        require(len(together) == 2 and all(verdict == "stable" for _, verdict in together), f"stability: {together}")
        stable = [density for density, verdict in in_turns if verdict == "stable"]
        bad = [density for density, verdict in in_turns if verdict != "stable"]
        require(stable and bad and max(stable) < min(bad) <= 2 * max(stable), f"stability: {in_turns}")
    with open(os.path.join(out, "stability.md")) as file:
        boundaries = file.read().partition("## Runs")[0]
    table = [[cell.strip() for cell in line.split("|")[1:-1]] for line in boundaries.splitlines() if line.startswith("| ")]
    for step, expected in (("1/100", 4.58), ("1/200", 3.88)):  # benchmarks/splitting_limits.py
        foretold, = (row[-1] for row in table if row[:2] == ["splitting u", step])
        require(abs(float(foretold) / expected - 1) < 0.03, f"stability: linear theory foretells {foretold} at {step}")
        require(["simultaneous", step] in (row[:2] for row in table if row[-1] == "none"), "stability: a boundary of no splitting")
    done = run(program, os.path.join(studies, "stability.prm"), os.path.join(folder, "nothing"), "--results-only")
    require(done.returncode == 1 and "has a verdict" in done.stderr, f"a map of nothing: {done.stdout}{done.stderr}")


def check_mistakes(program, studies, folder):
    with open(os.path.join(studies, "coupled.prm")) as file:
        text = file.read()
    scenes = os.path.join(ROOT, "prm")
    text = text.replace("../../prm", scenes)
    for wrong, said in ((text.replace("1/20 | 1/40 | 1/80", "1/20 | 1/80 | 1/40"), "must become finer"),
                        (text.replace("Columns", "Column"), "Did you mean 'Columns'"),
                        (text.replace("tip displacement x", "tip displacment x"), "similar: tip displacement x"),
                        (text.replace("Time/End", "Time/Ende"), "Did you mean 'End'"),
                        (text.replace("Rate     = true", "Rate = true\n    set Share of step = 0.5"), "beside 'Rate'"),
                        (text.replace("over time", "in time"), "largest")):
        path = os.path.join(folder, "wrong.prm")
        with open(path, "w") as file:
            file.write(wrong)
        done = run(program, path, os.path.join(folder, "wrong"))
        require(done.returncode not in (0, -11) and said in done.stdout + done.stderr,
                f"'{said}' is not said, exit code {done.returncode}:\n{done.stdout}\n{done.stderr}")
        if "displacment" in wrong:
            first, _, later = done.stderr.partition("[2/")
            require(later and "cannot be evaluated" in first, f"a column that is misspelt is not told after the first run:\n{done.stderr}")


def check_accuracy(program, _, folder):
    """A run with settings chosen for an error keeps it, against a run that is much finer; what cannot be had is refused."""
    sys.path.insert(0, ROOT)
    from study import columns, runs
    scene, out = os.path.join(ROOT, "prm", "piston.prm"), os.path.join(folder, "accurate")
    words = ["/usr/bin/python3", "-B", "-m", "study.accuracy", scene, "--program", program, "--output", out, "--set",
             "Time/End=0.5"]
    done = subprocess.run(words + ["--accuracy", "2%"], env=environment(), capture_output=True, text=True)
    require(done.returncode == 0 and "half of the error would take" in done.stdout, f"--accuracy: {done.stdout}{done.stderr}")
    found = columns.read(os.path.join(out, "statistics"))
    _, exact = runs.single(program, scene, {"Time/End": "0.5", "Time/Step": "1/800"})
    error = max(abs(value - exact["tip displacement x"][abs(exact["Time"] - time).argmin()])
                for time, value in zip(found["Time"], found["tip displacement x"])) / 0.01
    require(error < 0.03, f"--accuracy 2%: the error is {error:.3g}")
    require(os.path.exists(os.path.join(out, "solution.pvd")), "--accuracy: the run lacks the scene's outputs")
    done = subprocess.run(words + ["--overwrite", "--accuracy", "0.001%", "--within", "2s"], env=environment(),
                          capture_output=True, text=True)
    require(done.returncode == 1 and "was not reached" in done.stderr, f"--accuracy within 2 s: {done.stdout}{done.stderr}")


def check_earlier(program, _, folder):
    """Of the runs of a study those are used again that differ from a scene in its step only."""
    sys.path.insert(0, ROOT)
    from study import description, earlier, knobs, pilot
    scene = os.path.join(ROOT, "prm", "cantilever.prm")
    settings = {"Time/End": "0.1", "Bodies/beam/Cells": "6, 1, 1"}
    for changed, count in ((settings, 4), ({**settings, "Time/Integrator": "generalised_alpha"}, 4),
                           ({**settings, "Time/End": "0.2"}, 0)):
        parameters = knobs.parameters(program, scene, [f"{key}={value}" for key, value in changed.items()])
        study = description.Study("", scene, scene, 1, 0.0, 0.0, "core seconds", "all", [], changed, [])
        known = pilot.Pilot(program, study, lambda _: pilot.quantity_of("tip displacement y", "end"), folder, None)
        found = earlier.load(known, tuple(knobs.knobs_of(parameters)), parameters, folder)
        steps = sorted(round(120 / setting.factors[0]) for setting in known.values)
        require(found == count and steps in ([], sorted(round(120 * 120 / n) for n in (40, 80, 160, 320))),
                f"{changed}: {found} runs, steps {steps}")


def check_shipped(program, _, folder):
    """That the program reads all shipped studies, and their scenes with the settings of the finest run; that the rows of
    reference files are there."""
    sys.path.insert(0, ROOT)
    from study import cases, description, references, runs
    files = sorted(glob.glob(os.path.join(ROOT, "prm", "studies", "*.prm")))
    require(files, "no studies are shipped")
    for file in files:
        study = description.read(program, file)
        case = cases.make_cases(study)[-1]
        scene, settings = runs.scene_and_settings(study, case, folder)
        done = subprocess.run([program, "read-scene", scene, *runs.assignments(settings)], capture_output=True, text=True)
        require(done.returncode == 0, f"{file}, {case.name(study)}: {done.stderr}")
        for quantity in study.quantities:
            if quantity.reference_file:
                references.rows_of(quantity)


PARTS = {
    "kinds": (check_kinds, check_earlier),  # the second needs what the first has computed
    "budgets": (check_budgets, check_map),
    "mistakes": (check_kill, check_limit, check_mistakes),
    "accuracy": (check_accuracy,),
    "shipped": (check_shipped,),
}


def main():
    program, studies, part = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        for check in PARTS[part]:
            check(program, studies, folder)


if __name__ == "__main__":
    main()
