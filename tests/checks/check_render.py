#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""contrib/render makes pictures of bodies, of a fluid, of an obstacle, of bodies in a fluid, of particles
and of two runs side by side that are not just background.

usage: check_render.py RENDER PROGRAM SCENES      leaves with 77 (skipped) where VTK is missing
"""
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

import scene_tools

SIZE = (320, 180)


def is_installed():
    return (subprocess.run(["/usr/bin/python3", "-c", "import numpy, vtk"],
                           capture_output=True).returncode == 0 and
            subprocess.run(["sh", "-c", "command -v Xvfb"], capture_output=True).returncode == 0)


def pixels(file):
    """Width, height and the decompressed rows of an 8-bit PNG, filters and all."""
    data = file.read_bytes()
    width, height = struct.unpack(">II", data[16:24])
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    return width, height, zlib.decompress(packed)


def check(name, render, arguments, folder, n_expected):
    """Pictures into folder/frames; leaves if there are not so many or the last one is empty."""
    result = subprocess.run([render, *arguments, "--size", "320x180", "--out", folder + "/frames"],
                            capture_output=True, text=True)
    pictures = sorted(pathlib.Path(folder, "frames").glob("*.png"))
    if result.returncode != 0 or len(pictures) != n_expected:
        sys.exit(f"{name}: exit code {result.returncode}, pictures {pictures}\n{result.stderr}")
    width, height, rows = pixels(pictures[-1])
    if (width, height) != SIZE or len(set(rows)) < 64:
        sys.exit(f"{name}: a picture of {width} x {height} with {len(set(rows))} values")
    print(f"{name}: {result.stdout.strip()}")


def check_comparison(render, program, scenes):
    """The second run has the shorter interval and stops first: its five times, two of the other."""
    with tempfile.TemporaryDirectory() as folder:
        runs = [folder + "/long", folder + "/short"]
        for results, step in zip(runs, ("1/30", "1/60")):
            scene_tools.run(program, [f"{scenes}/jet_two_sheets_2d.prm", "--output", results,
                                      "--set", "Time/Maximum steps=4", "--set", "Time/Step=" + step,
                                      "--set", "Output/Interval=" + step])
        check("two runs", render, ["--compare", *runs], folder, 7)


def main():
    render, program, scenes = sys.argv[1:4]
    if not is_installed():
        print("skipped: the Debian packages python3-vtk9, python3-numpy and xvfb are not installed")
        sys.exit(77)
    for name, options in (("cook_membrane", ["--field", "von_Mises_stress"]), ("plume", []),
                          ("obstacle_flow", ["--field", "speed", "--streamlines"]),
                          ("jet_two_sheets", ["--slice", "z=0.5", "--vectors"]),
                          ("floating_block", ["--field", "pressure"]), ("elastic_sphere", ["--surface"])):
        with tempfile.TemporaryDirectory() as folder:
            scene_tools.run(program, [f"{scenes}/{name}.prm", "--output", folder,
                                      "--set", "Time/Maximum steps=2"])
            check(name, render, [folder, "--frames", "-1:", *options], folder, 1)
    check_comparison(render, program, scenes)


main()
