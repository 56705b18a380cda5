#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs of five kinds leave pages that are small, true and, in a browser, without errors of the console, with values under
the mouse, nothing beside the screen, and of a failed run the reason on the first screen. They never disturb a run.

usage: check_report.py PROGRAM FOLDER_OF_SCENES [--pictures DIR]     leaves with 77 (skipped) if there is no browser

What needs no browser is checked in any case.
"""
import argparse
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

import numpy

import browser
import scene_tools
from seen_page import Page

LIMIT = 3_000_000  # bytes
SCENES = {  # name: (scene, settings, exit code, verdict)
    "solid": ("cantilever", ["Bodies/beam/Cells=6, 1, 1", "Time/Maximum steps=12"], 0, "stable"),
    "jet": ("jet_two_sheets_2d", ["Domain/Cells=24, 12", "Time/Maximum steps=10", "Output/Budget=true"], 0, "stable"),
    "viscous": ("cavity", ["Domain/Cells=16, 16", "Time/Maximum steps=10"], 0, "stable"),
    "particles": ("dam_break_particles", ["Particles/Spacing=0.146/8", "Time/Maximum steps=4"], 0, "stable"),
    "failed": ("cook_membrane", ["Time/Step=0.1", "Time/Maximum cuts=0", "Bodies/membrane/Cells=6, 6",
                                 "Bodies/membrane/Boundaries/edge/Traction=0; -5e8*t^4"], 3, "failed"),
}


def environment(report="on"):
    return {**scene_tools.environment(), "UNDINE_REPORT": report}


def require(holds, what):
    if not holds:
        sys.exit(f"check_report.py: {what}")


def run(program, scene, folder, settings, ranks=1, **keys):
    words = [scene, "--output", str(folder)] + [word for setting in settings for word in ("--set", setting)]
    return subprocess.run(scene_tools.command(program, words, ranks), env=environment(**keys), capture_output=True, text=True)


def page_of(folder):
    return Page((folder / "report.html").read_text())


def rows_of(folder):
    names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    return names, numpy.array(rows)


def check_numbers(name, folder):
    """Every curve is a column of the file, perhaps without the initial state, or the sum of one over its rows, which add up."""
    page, (names, rows) = page_of(folder), rows_of(folder)
    times = rows[:, names.index("Time")]
    for plot in page.plots.values():
        sums = rows.cumsum(axis=0) if plot["kind"] in ("stack", "sums") else rows
        for curve in plot["curves"]:
            first = len(times) - len(curve["values"])
            require(first in (0, 1) and numpy.array_equal(times[first:], plot["times"][curve["times"]]),
                    f"{name}: times of {curve['name']} are not the file's")
            require(any(numpy.allclose(column[first:], curve["values"], rtol=1e-9, atol=0) for column in sums.T),
                    f"{name}: {curve['name']} is no column of 'statistics'")
        if plot["kind"] == "stack":
            by_name = {curve["name"]: numpy.array(curve["values"]) for curve in plot["curves"]}
            gain = by_name.pop("gain")
            size = sum(numpy.abs(each).max() for each in by_name.values())
            require(numpy.abs(sum(by_name.values()) - gain).max() < 1e-7 * size, f"{name}: the ledger does not add up to the gain")
    require(len(page.plots) > 2, f"{name}: only {len(page.plots)} plots")


def check_file(name, folder, verdict, printed):
    size = os.path.getsize(folder / "report.html")
    require(size < LIMIT, f"{name}: a page of {size} bytes")
    require(f"report: {folder / 'report.html'}" in printed, f"{name}: the page is not named:\n{printed}")
    first = page_of(folder).sections["first"]
    require(verdict in first and "No picture" not in first and "Not all files" not in first, f"{name}: begins with {first}")
    require("file report.html\n" in (folder / "record.txt").read_text(), f"{name}: the page is not in the record")
    print(f"{name}: {size / 1e6:.2f} MB")


def check_in_browser(program, name, folder, pictures, words=()):
    """`words` must be seen on the first screen."""
    file = folder / "report.html" if folder.is_dir() else folder
    for width in (700, 1280) if name in ("jet", "comparison") else (1280,):
        seen, console = browser.seen(program, file, width=width, height=800)
        require(not console, f"{name}: the console says {console}")
        require(seen["overflow"] <= 0, f"{name}: {seen['overflow']} pixels beside a screen of {width}")
        require(seen["broken"] == 0, f"{name}: {seen['broken']} broken pictures")
        require(all(box["right"] <= width for box in seen["drawings"]), f"{name}: a plot is beside a screen of {width}")
    plots = Page(file.read_text()).plots
    require(len(seen["tips"]) == len(plots) > 0, f"{name}: {len(seen['tips'])} of {len(plots)} plots have values under the mouse")
    for identifier, (time, *rows) in seen["tips"].items():
        at = float(time.split()[2])
        for curve, (label, value, *_) in zip(plots[identifier]["curves"], rows):
            times = numpy.array(plots[identifier]["times"][curve["times"]])
            shown, true = float(value.split()[0]), curve["values"][numpy.abs(times - at).argmin()]
            require(label == curve["name"] and abs(shown - true) <= 1e-6 * abs(true), f"{name}: {label} = {value}, not {true}")
    visible = " ".join(box["text"] for box in seen["verdicts"] if box["bottom"] <= 800)
    require(all(word in visible for word in words), f"{name}: the first screen says only: {visible}")
    if pictures:
        browser.screenshot(program, file, pictures / f"{name}.png", width=1280, height=2600)


def check_browser_tells(program, folder):
    """A check of consoles that says nothing about wrong scripts would be none."""
    page = folder / "wrong.html"
    page.write_text("<body><script>nothing_of_this_name()</script></body>")
    require(browser.seen(program, page)[1], "the browser does not tell what is wrong with scripts")


def check_comparison(folders, folder):
    out = folder / "comparison.html"
    done = subprocess.run([sys.executable, "-B", "-m", "report", *map(str, folders), "--out", str(out)], capture_output=True,
                          text=True, env={**environment(), "PYTHONPATH": scene_tools.ROOT})
    require(done.returncode == 0, f"a comparison fails: {done.stderr}")
    names = {curve["name"].split(",")[0] for plot in Page(out.read_text()).plots.values() for curve in plot["curves"]}
    require(names == {folder.name for folder in folders}, f"curves of {names} are compared")
    return out


def check_pages_on_the_way(program, scene, folder):
    """The page of a run that goes on says so; that of one that was killed then says that."""
    words = [scene, "--output", str(folder), "--set", "Output/Interval=0.001", "--set", "Time/Step=0.001", "--set", "Time/End=1e6",
             "--set", "Domain/Cells=16, 16"]
    process = subprocess.Popen([program, *words], env=environment("always"), stdout=subprocess.DEVNULL)
    begin = time.time()
    while not (folder / "report.html").exists() and process.poll() is None and time.time() < begin + 100:
        time.sleep(0.05)
    process.send_signal(signal.SIGSTOP)
    require((folder / "report.html").exists(), "no page is written while a run goes on")
    page = page_of(folder)
    require("running" in page.sections["first"] and "seconds" in page.sections, f"begins with {page.sections['first']}")
    process.kill()
    process.wait()
    time.sleep(2)  # for a page that the run may have begun
    done = subprocess.run([sys.executable, "-B", "-m", "report", str(folder)], capture_output=True, text=True,
                          env={**environment(), "PYTHONPATH": scene_tools.ROOT})
    require(done.returncode == 0 and "not ended" in page_of(folder).sections["first"], "a killed run is not called so")


def check_undisturbed(program, scene, folder):
    """A file of somebody else, a scene or an environment that wants none: the run is the same without a page."""
    settings = ["Domain/Cells=8, 8", "Time/Maximum steps=2"]
    folder.mkdir()
    (folder / "report.html").write_text("mine")
    done = run(program, scene, folder, settings)
    require(done.returncode == 0 and done.stdout.count("'report.html' is not written") == 1 and
            (folder / "report.html").read_text() == "mine", f"somebody's file: {done.stdout} {done.stderr}")
    for name, more, report in (("by the scene", ["Output/Report=false"], "on"), ("by the environment", [], "off")):
        done = run(program, scene, folder / name, settings + more, report=report)
        require(done.returncode == 0 and not (folder / name / "report.html").exists() and "report:" not in done.stdout,
                f"switched off {name}: {done.stdout}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("scenes", type=pathlib.Path)
    parser.add_argument("--pictures", type=pathlib.Path, help="keep pictures of the pages here")
    options = parser.parse_args()
    found = browser.find()
    with tempfile.TemporaryDirectory() as place:
        place = pathlib.Path(place)
        for name, (scene, settings, code, verdict) in SCENES.items():
            done = run(options.program, str(options.scenes / f"{scene}.prm"), place / name, settings, ranks=2 if name == "viscous" else 1)
            require(done.returncode == code, f"{name}: exit code {done.returncode}\n{done.stdout[-2000:]}\n{done.stderr}")
            check_file(name, place / name, verdict, done.stdout)
            check_numbers(name, place / name)
        cavity = str(options.scenes / "cavity.prm")
        check_pages_on_the_way(options.program, cavity, place / "way")
        check_undisturbed(options.program, cavity, place / "undisturbed")
        comparison = check_comparison([place / "solid", place / "failed"], place)
        if found is None:
            print(f"skipped: pages in a browser, none of {', '.join(browser.NAMES)} is installed")
            sys.exit(77)
        check_browser_tells(found, place)
        for name in SCENES:
            words = ("failed", "What happened", "What to try") if name == "failed" else ("stable",)
            check_in_browser(found, name, place / name, options.pictures, words)
        check_in_browser(found, "comparison", comparison, options.pictures)


main()
