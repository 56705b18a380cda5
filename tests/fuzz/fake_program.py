#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Stands for the program in test_fuzz.py: commits the fault that the scene's title names, at --validate, in a run,
when it is run again or resumed. Any other title is a scene without fault."""
import json
import os
import pathlib
import signal
import sys
import time

import expressions
import file_mutations
import scene_reader

RANKS = os.environ.get("FAKE_RANKS")
PLACE = "scene.prm:1: section 'Time', key 'End': wrong.\n"


def refuse(code, message):
    sys.stderr.write(message)
    sys.exit(code)


def use_memory():
    held = b"a" * 400000000
    time.sleep(30)
    return held


def wait_for_signal(code):
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(code))
    time.sleep(30)


def ignore_signal():
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    time.sleep(30)


AT_ONCE = {
    "crash": lambda: os.kill(os.getpid(), signal.SIGSEGV),
    "unexpected condition": lambda: refuse(5, "Error: an unexpected condition, please report it:\nassertion\n"),
    "exit code": lambda: refuse(1, "Error"),
    "exit code of a signal": lambda: refuse(7, "stopped"),
    "timeout": lambda: time.sleep(30),
    "memory": use_memory,
    "no message": lambda: refuse(2, ""),
    "message without place": lambda: refuse(2, "Error: wrong"),
    "message with control characters": lambda: refuse(2, "Error: \x1b[31m" + PLACE),
    "wrong place": lambda: refuse(2, "Error: " + PLACE),
    "false mistake": lambda: refuse(2, "scene.prm:1: top level, subsection 'Fluid': there is no such subsection here."),
    "foreign file": lambda: refuse(2, f"scene.prm: cannot understand '{file_mutations.SECRET}'"),
    "validate writes": lambda: pathlib.Path("left").write_text("over"),
    "refused": lambda: refuse(2, "Error: section 'Time' is wrong"),
}
IN_RUN = {
    "run crashes": lambda: os.kill(os.getpid(), signal.SIGABRT),
    "run is stopped": lambda: wait_for_signal(7),
    "run goes on": ignore_signal,
    "run refuses": lambda: refuse(2, "Error: section 'Time' is wrong"),
    "particles": lambda: RANKS == "2" and refuse(2, "top level, key 'Scheme': particles are computed by one rank"),
    "particles refused": lambda: RANKS == "2" and refuse(2, "Error: section 'Time' is wrong"),
    "run writes elsewhere": lambda: pathlib.Path("left").write_text("over"),
}


def options():
    words, named = [], {"--set": [], "--output": ["output"]}
    waiting = iter(sys.argv[1:])
    for word in waiting:
        (named[word].append(next(waiting)) if word in named else words.append(word))
    return words, named["--set"], pathlib.Path(named["--output"][-1])


def as_used(value):
    try:
        return repr(expressions.constant(value))
    except (expressions.NoExpression, expressions.Unknown):
        return value


def write_results(folder, scene, fault, again):
    used = {}
    for path, value in scene.values.items():
        *names, key = path.split("/")
        place = used
        for name in names:
            place = place.setdefault(name, {})
        place[key] = "7" if fault == "misread value" and key == "End" else as_used(value)
    rows = int(scene.values["Time/Maximum steps"]) + (fault == f"ranks differ {RANKS}")
    broken = fault == "broken JSON"
    (folder / "checkpoint").mkdir(parents=True, exist_ok=True)
    (folder / "checkpoint/state").write_text("state")
    (folder / "parameters.json").write_text(json.dumps(used) + ("}" if broken else ""))
    (folder / "solution.pvd").write_text("<a b=\"<\"/>" if fault == "broken XML" else "<a/>")
    value = "nan" if fault == "not finite" else "2" if again and fault in ("not repeatable", "resume differs") else "1"
    (folder / "statistics").write_text("# 1: step [1]\n# 2: time [s]\n# 3: a [1]\n" +
                                       "".join(f"{row} {row} {value}\n" for row in range(rows + 1)))
    with open(folder / "parameters.prm", "w", encoding="utf-8") as file:
        for path, text in scene.values.items():
            *names, key = path.split("/")
            file.write("".join(f"subsection {name}\n" for name in names) + f"set {key} = {text}\n" + "end\n" * len(names))


def main():
    if "--reference" in sys.argv:
        print("## Top level\n\n| key | default | allowed | unit | meaning |\n|---|---|---|---|---|\n"
              "| Title | | text | | |\n| Scheme | | text | | |\n| Dimension | | whole number, from 2 to 3 | | |\n\n## Time\n\n"
              "| End | | number, \\> 0 | s | |\n| Maximum steps | | whole number | | |")
        return
    words, settings, output = options()
    resumed = words[0] == "resume"
    name = words[1] + "/parameters.prm" if resumed else words[0]
    folder = pathlib.Path(name).parent
    scene = scene_reader.read_scene({path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()},
                                    pathlib.Path(name).name, settings)
    fault = scene.values.get("Title", "")
    if fault == "equivalent differs" and b"#" in pathlib.Path(name).read_bytes():
        fault = "refused"
    AT_ONCE.get(fault, lambda: None)()
    if "--validate" in words:
        print("no mistakes found")
        return
    IN_RUN.get(fault, lambda: None)()
    again = resumed if fault == "resume differs" else name.endswith("parameters.prm")
    write_results(folder if resumed else output, scene, fault, again)


main()
