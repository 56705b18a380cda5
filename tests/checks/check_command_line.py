#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The program's options do what doc/running.md says.

usage: check_command_line.py PROGRAM SCENE.prm
"""
import os
import subprocess
import sys
import tempfile

import scene_tools


def call(program, *arguments, folder=None):
    return subprocess.run([program, *arguments], env=scene_tools.environment(), cwd=folder,
                          capture_output=True, text=True)


def expect(what, holds, result):
    if not holds:
        sys.exit(f"{what}\nexit code {result.returncode}\n{result.stdout}\n{result.stderr}")


def check_questions(program, scene):
    for option, word in (("--help", "--validate"), ("--version", "undine"),
                         ("--reference", "| key |")):
        result = call(program, option)
        expect(f"{option} must print '{word}'", result.returncode == 0 and word in result.stdout,
               result)
    with tempfile.TemporaryDirectory() as folder:
        result = call(program, scene, "--validate", folder=folder)
        expect("--validate must write nothing", result.returncode == 0 and not os.listdir(folder),
               result)
    for arguments, code, word in (([], 2, "no scene"), (["--no-such-option"], 2, "--no-such-option"),
                                  ([scene, "--set", "Time"], 2, "'--set Time' must have the form"),
                                  (["no_such_file.prm"], 4, "'no_such_file.prm'"),
                                  ([scene, "--set", "Time/Stepp=1"], 2, "Did you mean 'Step'"),
                                  ([scene, "--output", "--validate"], 2, "'--validate' is an option"),
                                  (["resume", "no_such_folder"], 4, "no_such_folder")):
        result = call(program, *arguments)
        expect(f"{arguments} must be refused with exit code {code} and '{word}'",
               result.returncode == code and word in result.stderr, result)


def check_reference_of_sections(program):
    """Of a section: what the whole has of it, and no other."""
    whole = call(program, "--reference").stdout
    for section, headings in (("output/VTU", ["Output / vtu"]), ("Output", ["Output", "Output / checkpoint", "Output / vtu"]),
                              ("viscosity", ["Effects / viscosity"])):
        result = call(program, "--reference", section)
        found = [line[3:] for line in result.stdout.splitlines() if line.startswith("## ")]
        expect(f"--reference {section} must print {headings}, not {found}", found == headings, result)
        expect(f"--reference {section} must be a part of all", all(block.strip() in whole for block in
                                                                   result.stdout.split("\n## ")), result)
    result = call(program, "--reference", "put")
    expect("a section that is not there is refused", result.returncode == 2 and "'put'" in result.stderr, result)


def check_new_scenes(program):
    """What './undine new' writes is without mistakes, bears its name, and nothing is replaced."""
    script = os.path.join(scene_tools.ROOT, "undine")
    with tempfile.TemporaryDirectory() as folder:
        for kind in ("grid", "particles", "solid"):
            result = call(script, "new", f"my {kind} & more", kind, folder=folder)
            expect(f"'new' must write a scene: {kind}", result.returncode == 0, result)
            result = call(program, f"my {kind} & more.prm", "--validate", folder=folder)
            expect(f"the scene must be good: {kind}", result.returncode == 0 and "no mistakes" in result.stdout, result)
            with open(os.path.join(folder, f"my {kind} & more.prm")) as file:
                expect("its title must be its name", f"= my {kind} & more\n" in file.read(), result)
        for arguments, word in ((["my solid & more"], "is there already"), (["other", "no-kind"], "three kinds"), ([], "a name")):
            result = call(script, "new", *arguments, folder=folder)
            expect(f"'new {arguments}' must be refused", result.returncode == 1 and word in result.stderr, result)


def check_numbers_of_other_methods(program, scene):
    """Are not read, with a note that says so; what only another method can do is refused."""
    particles = os.path.join(scene_tools.ROOT, "prm", "hydrostatic_particles.prm")
    for file, setting, word in ((scene, "Particles/Spacing=0.1", "section 'Particles'"),
                                (particles, "Domain/Cells=8, 8", "section 'Domain', key 'Cells'"),
                                (particles, "Solid numerics/Element degree=2", "section 'Solid numerics'")):
        result = call(program, file, "--validate", "--set", setting)
        expect(f"{setting} must be noted as not read", result.returncode == 0 and "note: " in result.stdout and
               f"{word}: is not read" in result.stdout, result)
    result = call(program, particles, "--validate", "--set", "Output/Budget=true")
    expect(
        "a ledger of particles must be skipped with a note",
        result.returncode == 0 and "key 'Budget': is not read by this scheme" in result.stdout + result.stderr,
        result,
    )


def check_output(program, scene):
    with tempfile.TemporaryDirectory() as folder:
        results = os.path.join(folder, "new", "results")
        result = call(program, scene, "--output", results, "--set", "Time/Maximum steps=1",
                      "--set", "Title=A new title")
        with open(os.path.join(results, "parameters.prm")) as file:
            used = file.read()
        expect("--set and --output must be obeyed", result.returncode == 0 and
               "set Title = A new title" in used and "set Maximum steps = 1" in used, result)
        with open(os.path.join(results, "original.prm")) as file, open(scene) as original:
            expect("original.prm must be the scene", file.read() == original.read(), result)

        again = os.path.join(folder, "again")
        result = call(program, os.path.join(results, "parameters.prm"), "--output", again)
        expect("parameters.prm must give the same run", result.returncode == 0 and
               scene_tools.statistics(results) == scene_tools.statistics(again), result)

        blocked = os.path.join(folder, "file")
        open(blocked, "w").close()
        result = call(program, scene, "--output", os.path.join(blocked, "results"))
        expect("an impossible folder must be refused with its name",
               result.returncode == 4 and blocked in result.stderr, result)


def main():
    program, scene = sys.argv[1:3]
    check_questions(program, scene)
    check_reference_of_sections(program)
    check_numbers_of_other_methods(program, scene)
    check_new_scenes(program)
    check_output(program, scene)
    print("the command line does what doc/running.md says")


main()
