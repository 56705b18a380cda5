#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every malformed scene is refused with a message that says what is wrong and what is allowed.

usage: check_malformed.py PROGRAM FOLDER

Each .prm file in FOLDER names in a comment `# expect: text | text` what the message must contain; the
file's own name is always expected. What `# never: text | text` lists it must not contain. Files with the
comment `# run` are valid and fail while running. The exit code is 2, or what `# exit: code` says.
The good scenes that the others include must be accepted.
"""
import concurrent.futures
import pathlib
import re
import subprocess
import sys
import tempfile

import scene_tools



def call(program, arguments):
    with tempfile.TemporaryDirectory() as folder:
        return subprocess.run([program, *arguments, "--output", folder + "/results"],
                              env=scene_tools.environment(), capture_output=True, text=True,
                              timeout=120)


def faults(program, scene):
    """What is wrong with the answer to one malformed scene."""
    text = scene.read_text()
    expected = re.search(r"^# expect: (.*)$", text, re.M)
    if not expected:
        return ["no comment '# expect: ...'"]
    runs = re.search(r"^# run$", text, re.M) is not None
    result = call(program, [str(scene)] + ([] if runs else ["--validate"]))
    found = []
    exit_code = re.search(r"^# exit: (\d+)$", text, re.M)
    wanted = int(exit_code[1]) if exit_code else 2
    if result.returncode != wanted:
        found.append(f"exit code {result.returncode} instead of {wanted}")
    words = [word.strip() for word in expected[1].split(" | ")]
    if not runs:
        words.append(scene.name)
    for word in words:
        if word not in result.stderr:
            found.append(f"the message lacks: {word}")
    unwanted = re.search(r"^# never: (.*)$", text, re.M)
    for word in unwanted[1].split(" | ") if unwanted else []:
        if word.strip() in result.stderr:
            found.append(f"the message must not contain: {word.strip()}")
    if found:
        found.append("the message: " + result.stderr.strip())
    return found


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    failed = 0
    for name in ("fluid.inc", "solid.inc", "particles.inc"):
        result = call(program, [str(folder / name), "--validate"])
        if result.returncode != 0:
            failed += 1
            print(f"{name} must be accepted: {result.stderr}")
    scenes = sorted(folder.glob("*.prm"))
    # Two at a time: most of a run is the start of the program.
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        found_of = list(pool.map(lambda scene: faults(program, scene), scenes))
    for scene, found in zip(scenes, found_of):
        if found:
            failed += 1
            print(f"{scene.name}:\n    " + "\n    ".join(found))
    print(f"{len(scenes)} malformed scenes, {failed} not as expected")
    sys.exit(1 if failed or len(scenes) < 30 else 0)


main()
