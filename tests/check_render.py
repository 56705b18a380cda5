#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""contrib/render makes pictures of bodies, of a fluid and of an obstacle that are not just background.

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
    return (subprocess.run(["/usr/bin/python3", "-c", "import vtk"],
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


def main():
    render, program, scenes = sys.argv[1:4]
    if not is_installed():
        print("skipped: the Debian packages python3-vtk9 and xvfb are not installed")
        sys.exit(77)
    for name, options in (("cook_membrane", ["--field", "von_Mises_stress"]), ("plume", []),
                          ("obstacle_flow", ["--field", "velocity"])):
        with tempfile.TemporaryDirectory() as folder:
            scene_tools.run(program, [f"{scenes}/{name}.prm", "--output", folder,
                                      "--set", "Time/Maximum steps=2"])
            result = subprocess.run([render, folder, "--frames", "-1:", "--size", "320x180",
                                     "--out", folder + "/frames", *options],
                                    capture_output=True, text=True)
            pictures = list(pathlib.Path(folder, "frames").glob("*.png"))
            if result.returncode != 0 or len(pictures) != 1:
                sys.exit(f"{name}: exit code {result.returncode}, pictures {pictures}\n"
                         f"{result.stderr}")
            width, height, rows = pixels(pictures[0])
            if (width, height) != SIZE or len(set(rows)) < 64:
                sys.exit(f"{name}: a picture of {width} x {height} with {len(set(rows))} values")
            print(f"{name}: {result.stdout.strip()}")


main()
