# SPDX-License-Identifier: LGPL-2.1-or-later
"""A sheet with a picture of each scene of prm/hard, from runs with steps of 1/30 s."""
import math
import os
import re
import subprocess
from fractions import Fraction

import hard_case_laws as laws
from study import runs

RENDER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "contrib", "render")
STEP = 1 / 30
ACROSS = 6
COLOURS = 160  # of the palette


def end_of(scene):
    with open(scene) as file:
        return float(Fraction(re.search(r"^ *set End *= *(\S+)", file.read(), re.M)[1]))


def times_of(folder):
    """Of the pictures that a run has written."""
    path = os.path.join(folder, "solution.pvd")
    if not os.path.exists(path):
        return []
    with open(path) as file:
        return sorted(set(map(float, re.findall(r'timestep="([^"]+)"', file.read()))))


def make_run(options, scene, folder):
    """As far as it comes within the limit."""
    words = [options.program, scene, "--output", folder, "--overwrite", "--set", "Output/Parts=vtu", "--set", "Output/Interval=1/30"]
    with open(os.path.join(options.out, "pictures", "printed"), "w+") as printed:
        runs.execute(words, options.limit, printed)


def picture(options, name, scene):
    """The file of a picture, which is made if it is not there, and the time that it shows; None if there is none."""
    folder = os.path.join(options.out, "pictures", name)
    file = os.path.join(folder, "frame_0000.png")
    if not os.path.exists(file):
        make_run(options, scene, folder)
    times = times_of(folder)
    if not times:
        return None
    wanted = laws.SCENES[name].shown * end_of(scene)
    frame = min(range(len(times)), key=lambda k: abs(times[k] - wanted))
    if not os.path.exists(file):
        subprocess.run([RENDER, folder, "--out", folder, "--size", "640x360", "--frames", f"{frame}:{frame + 1}"],
                       stdout=subprocess.DEVNULL, check=False)
        made = sorted(each for each in os.listdir(folder) if each.startswith("frame_"))
        if made:
            os.replace(os.path.join(folder, made[0]), file)
    return (file, times[frame]) if os.path.exists(file) else None


def title(name, scene, shown):
    """The name, and how far a run came that was too slow for the picture that was wanted."""
    wanted = laws.SCENES[name].shown * end_of(scene)
    return name if shown > wanted - 1.5 * STEP else f"{name}\n{shown:.2g} of {wanted:.2g} s"


def sheet(options, scenes):
    """All scenes, {name: file}, on a sheet: hard_cases.png in the folder of results."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    from PIL import Image  # which matplotlib needs, too
    os.makedirs(os.path.join(options.out, "pictures"), exist_ok=True)
    down = math.ceil(len(scenes) / ACROSS)
    figure, axes = pyplot.subplots(down, ACROSS, squeeze=False, figsize=(1.8 * ACROSS, 1.3 * down))
    for axis in axes.flat:
        axis.axis("off")
    for axis, (name, scene) in zip(axes.flat, scenes.items()):
        made = picture(options, name, scene)
        if made:
            axis.imshow(pyplot.imread(made[0]))
        axis.set_title(title(name, scene, made[1] if made else 0), fontsize=6, pad=2)
        print(name, made or "no picture", flush=True)
    figure.tight_layout(pad=0.3)
    file = os.path.join(options.out, "hard_cases.png")
    figure.savefig(file, dpi=110)
    Image.open(file).convert("RGB").quantize(COLOURS).save(file, optimize=True)
