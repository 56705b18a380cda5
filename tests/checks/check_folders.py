#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Folders of results: nothing of others is replaced, no unfinished run is lost, two runs do not mix, and a
run that cannot be taken up again leaves its folder as it was.

usage: check_folders.py PROGRAM FOLDER_OF_SCENES
"""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

import scene_tools


MOVING_PILLAR = """
set Dimension = 2
subsection Time
  set End  = 0.6
  set Step = 0.1
end
subsection Domain
  set Cells = 10, 10
end
subsection Fluid
  set Density = 1
end
subsection Obstacles
  subsection pillar
    set Shape        = ball
    set Centre       = 0.25, 0.5
    set Radius       = 0.15
    set Displacement = 0.5*t; 0
  end
end
subsection Probes
  subsection room
    set Kind  = chamber
    set Point = 0.52, 0.52
  end
end
"""


BLOCK_AT_REST = """
set Dimension = 2
subsection Time
  set Step = .01
  set End = 1
end
subsection Domain
  set Cells = 10, 10
end
subsection Fluid
  set Density = 1000
  subsection Boundaries
    subsection top
      set Sides = top
      set Kind = pressure
      set Pressure = 0
    end
  end
end
subsection Bodies
  subsection block
    set Shape = box
    set Lower corner = .33, .32
    set Upper corner = .69, .68
    set Cells = 2, 2
    set Density = 1000
    set Young's modulus = 1e9
    set Poisson's ratio = .3
  end
end
subsection Effects
  subsection gravity
    set Acceleration = 0, -9.81
  end
end
"""


def call(program, *arguments, ranks=1):
    return subprocess.run(scene_tools.command(program, [str(a) for a in arguments], ranks),
                          env=scene_tools.environment(), capture_output=True, text=True, timeout=120)


def expect(what, holds, result=None):
    if not holds:
        sys.exit(f"not so: {what}" + (f"\nexit code {result.returncode}\n{result.stdout}\n{result.stderr}"
                                      if result else ""))


def contents(folder):
    """Name and bytes of every file, but the lock."""
    return {str(path.relative_to(folder)): path.read_bytes()
            for path in sorted(pathlib.Path(folder).rglob("*")) if path.is_file() and path.name != "lock"}


def settings(*assignments):
    return [word for assignment in assignments for word in ("--set", assignment)]


def steps(folder):
    _, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    return [int(row[0]) for row in rows]


def check_foreign_files(program, scene, folder):
    """Somebody's files stay, and stop a run only where it would replace them."""
    results = folder / "foreign"
    for name in ("solution/mine.txt", "checkpoint/mine.txt", "mine.txt"):
        (results / name).parent.mkdir(parents=True, exist_ok=True)
        (results / name).write_text("mine")
    short = settings("Time/Maximum steps=2")
    for name in ("statistics", "summary.json"):
        (results / name).write_text("mine")
        before = contents(results)
        for extra in ([], ["--overwrite"]):
            result = call(program, scene, "--output", results, *short, *extra)
            expect(f"a folder with somebody's '{name}' is refused", result.returncode == 4 and
                   name in result.stderr and "--output" in result.stderr, result)
            expect("nothing in it has changed", contents(results) == before, result)
        (results / name).unlink()
    before = contents(results)
    for _ in range(2):  # the second run replaces the first
        result = call(program, scene, "--output", results, *short)
        expect("a run beside files of others works", result.returncode == 0, result)
        after = contents(results)
        expect("files of others stay", all(after[name] == b"mine" for name in before))
    last = sorted(name for name in after if name.startswith("solution/fluid"))[-1]
    (results / "solution/fluid_000099.vtu").write_text("mine")
    result = call(program, scene, "--output", results, *short)
    expect("a picture that no run has written is refused", result.returncode == 4 and
           "fluid_000099" in result.stderr and (results / last).exists(), result)


def check_unfinished_runs(program, scene, folder):
    """A run that can go on is replaced only by --overwrite."""
    results = folder / "unfinished"
    endless = settings("Time/End=1e6", "Output/checkpoint/Interval=2")
    process = subprocess.Popen([program, scene, "--output", results, *endless],
                               env=scene_tools.environment(), stdout=subprocess.DEVNULL)
    while not (results / "checkpoint/slot_1.h5").exists() and process.poll() is None:
        time.sleep(0.02)

    result = call(program, scene, "--output", results, "--overwrite")
    expect("a second run in the folder is refused", result.returncode == 4 and
           f"process {process.pid}" in result.stderr, result)
    result = call(program, "resume", results)
    expect("so is one that goes on", result.returncode == 4 and f"process {process.pid}" in result.stderr, result)
    process.send_signal(signal.SIGKILL)
    expect("the run is killed before its end", process.wait() == -signal.SIGKILL)
    expect("a killed run leaves its lock", (results / "lock").exists())

    before = contents(results)
    result = call(program, scene, "--output", results, *settings("Time/Maximum steps=2"))
    expect("an unfinished run is not replaced", result.returncode == 4 and
           all(word in result.stderr for word in ("undine resume", "--overwrite", "--output")), result)
    expect("nothing of it has changed", contents(results) == before)
    last = steps(results)[-1]
    result = call(program, "resume", results, *settings(f"Time/Maximum steps={last + 2}"))
    expect("it can go on", result.returncode == 0 and steps(results) == list(range(last + 3)), result)
    expect("no lock is left", not (results / "lock").exists())
    result = call(program, scene, "--output", results, *settings("Time/Maximum steps=2"))
    expect("what has ended is replaced", result.returncode == 0 and steps(results) == [0, 1, 2], result)

    (results / "record.txt").write_text((results / "record.txt").read_text().replace("run has ended\n", ""))
    result = call(program, scene, "--output", results, "--overwrite", *settings("Time/Maximum steps=1"))
    expect("--overwrite replaces what has not", result.returncode == 0 and steps(results) == [0, 1], result)


def check_refused_resumes(program, scenes, folder):
    """What cannot go on stays as it was, and a branch leaves its origin alone."""
    results = folder / "refused"
    scene = scenes / "obstacle_flow.prm"
    coarse = settings("Domain/Cells=24, 12", "Time/Maximum steps=4")
    result = call(program, scene, "--output", results, *coarse)
    expect("a run of four steps works", result.returncode == 0 and steps(results) == list(range(5)), result)
    before = contents(results)
    more = "Time/Maximum steps=6"

    def refused(what, word, *assignments, given=results):
        result = call(program, "resume", given, *settings(more, *assignments))
        expect(f"{what} is refused", result.returncode in (2, 4) and word in result.stderr, result)

    refused("an unknown key", "Stepp", "Time/Stepp=3")
    refused("another number of columns", "columns", "Probes/p/Kind=fluid point", "Probes/p/Point=0.1, 0.1")
    refused("another grid of the same size", "the grid of the fluid", "Domain/Upper corner=3.01, 1")
    refused("other planes", "the grid of the fluid", "Domain/Grading x=x^1.01")
    refused("an obstacle elsewhere", "the obstacles", "Obstacles/disc/Centre=0.01, 0.013")
    expect("the folder is as it was", contents(results) == before)

    text = (results / "statistics").read_text()
    for what, other in (("cut short", text[:len(text) * 3 // 4].rsplit("\n", 1)[0] + "\n"),
                        ("changed", text[:-3] + ("1" if text[-3] != "1" else "2") + text[-2:])):
        (results / "statistics").write_text(other)
        refused(f"a file 'statistics' that was {what}", "statistics")
        expect(f"{what} as it was", (results / "statistics").read_text() == other)
    (results / "statistics").write_text(text)

    branch = folder / "branch"
    result = call(program, "resume", results, "--output", branch, *settings(more))
    expect("a branch goes on elsewhere", result.returncode == 0 and steps(branch) == list(range(7)), result)
    expect("and leaves its origin as it was", contents(results) == before)
    result = call(program, "resume", results, *settings(more))
    expect("which can go on itself, alike", result.returncode == 0 and
           scene_tools.statistics(results) == scene_tools.statistics(branch), result)
    before = contents(results)
    result = call(program, "resume", results)
    after = contents(results)
    expect("a run at its end keeps what it knows of itself", result.returncode == 0 and
           all(after[name] == before[name] for name in ("timing", "summary.json", "effects.json", "statistics")), result)
    refused("another folder by a key", "--output", f"Output/Directory={folder / 'elsewhere'}")
    (results / "statistics").unlink()
    result = call(program, "resume", results, *settings("Time/Maximum steps=8"))
    expect("without 'statistics' a new one begins", result.returncode == 0 and steps(results) == [7, 8], result)


SMOKE = """
set Dimension = 2
subsection Time
  set End  = 0.4
  set Step = 0.1
end
subsection Domain
  set Cells = 8, 8
end
subsection Fluid
  set Density = 1
end
subsection Effects
  subsection scalar transport
    subsection smoke
      set Initial value = x
    end
  end
end
"""


def check_new_rates(program, folder):
    """What else changes a scalar than the flow may begin where a run is taken up again."""
    scene, results = folder / "smoke.prm", folder / "smoke"
    scene.write_text(SMOKE)
    result = call(program, scene, "--output", results, *settings("Time/Maximum steps=2"))
    expect("smoke drifts", result.returncode == 0 and steps(results) == [0, 1, 2], result)
    result = call(program, "resume", results, *settings("Time/Maximum steps=4", "Effects/scalar transport/smoke/Source=1"))
    expect("then it has a source", result.returncode == 0 and steps(results) == list(range(5)), result)
    names, _, rows = scene_tools.parse(scene_tools.statistics(results))
    smoke = [row[names.index("Integral of smoke")] for row in rows]
    expect(f"which adds to it: {smoke}", abs(smoke[2] - 0.5) < 1e-9 and abs(smoke[4] - 0.7) < 1e-9)


def check_failing_probe(program, folder):
    """A probe that fails in the middle of a run leaves rows that lead up to the state that is kept."""
    scene, results = folder / "probe.prm", folder / "probe"
    scene.write_text(MOVING_PILLAR)
    result = call(program, scene, "--output", results)
    expect("the pillar reaches the probe in the third step", result.returncode == 3 and
           "step 3, which begins" in result.stderr and "Probes/room" in result.stderr and
           steps(results) == [0, 1, 2], result)
    result = call(program, "resume", results, *settings("Probes/room/Point=0.9, 0.9"))
    expect("elsewhere it can go on", result.returncode == 0 and steps(results) == list(range(7)), result)


def check_other_integrators(program, folder):
    """A block at rest in a fluid stays so where another integrator goes on, which other rates belong to."""
    scene, kinds = folder / "rest.prm", ("trapezoid_bdf2", "generalised_alpha", "theta")
    scene.write_text(BLOCK_AT_REST)
    for first, second in ((a, b) for a in kinds for b in kinds if a != b):
        results = folder / f"{first}_{second}"
        for arguments in ([scene, "--output", results, *settings(f"Time/Integrator={first}", "Time/Maximum steps=5")],
                          ["resume", results, *settings(f"Time/Integrator={second}", "Time/Maximum steps=8")]):
            result = call(program, *arguments)
            expect(f"{first}, then {second}", result.returncode == 0, result)
        names, _, rows = scene_tools.parse(scene_tools.statistics(results))
        speeds = [row[names.index("max speed block")] for row in rows]
        # It rings a little, as the pressure of the fluid makes it smaller.
        expect(f"{first}, then {second}: nothing sets it in motion: {speeds} m/s",
               len(speeds) == 9 and max(speeds[6:]) < 5e-3)


def check_changed_bodies(program, scenes, folder):
    for scene, changes in (("cantilever.prm", ["Bodies/beam/Upper corner=0.5, 0.05, 0.101"]),
                           ("floating_block.prm", ["Bodies/block/Lower corner=0.4, 0.27",
                                                   "Bodies/block/Upper corner=0.6, 0.47"])):
        results = folder / scene
        result = call(program, scenes / scene, "--output", results, *settings("Time/Maximum steps=1"))
        expect(f"{scene} runs", result.returncode == 0 and steps(results) == [0, 1], result)
        result = call(program, "resume", results, *settings("Time/Maximum steps=2", *changes))
        expect(f"other bodies in {scene} are refused", result.returncode == 4 and
               "bodies at rest" in result.stderr, result)


def main():
    program, scenes = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        check_foreign_files(program, scenes / "taylor_green.prm", folder)
        check_unfinished_runs(program, scenes / "taylor_green.prm", folder)
        check_refused_resumes(program, scenes, folder)
        check_changed_bodies(program, scenes, folder)
        check_new_rates(program, folder)
        check_failing_probe(program, folder)
        check_other_integrators(program, folder)
    print("folders of results: nothing lost, nothing mixed, nothing of others touched")


main()
