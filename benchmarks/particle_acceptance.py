#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Long runs of particles that have to hold bounds, as one table: what was asked, what was found, kept or not.

usage: benchmarks/particle_acceptance.py [--rows NAME...] [--short] [--program PROGRAM] [--executor host|device] [--check]

rest      full boxes of water stay at rest for 10 s: largest speed at most 5e-3 sqrt(g H), not growing in the second half;
          in the plane and in space, in single and double precision
sinking   a ball in a full box falls half its radius as with its added mass, within 10 %, at three spacings
soft      soft balls (1e3 and 1e4 Pa, densities 100 to 2000 kg/m^3), released at rest and thrown downwards into water with
          0.5 and 2 m/s, 5 s: where rho v^2 and rho g H are below the modulus energy is never above the start by more than
          0.1 % of what can be released, no water is in the body, and none is lost
stiff     a ball of 1e9 Pa by implicit steps: the same with 0.5 % of the energy at the start
many      200 balls of mixed sizes and densities settle in a tank: no two overlap by more than 0.3 spacings, and a sub-step takes at
          most 1.3 times as long a particle as with one ball

--short: two seconds instead of ten and five, 20 balls instead of 200, one precision, two densities.
--check: fail if one bound does not hold. Times of `many` mean something only on a machine that does nothing else.
"""
import argparse
import itertools
import json
import math
import os
import random
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "checks"))
import scene_tools  # noqa: E402

GRAVITY, DENSITY = 9.81, 1000.0


def section(name, content):
    return f"subsection {name}\n{content}\nend\n"


def keys(**values):
    return "".join(f"set {key.replace('_', ' ')} = {value}\n" for key, value in values.items())


def triple(values):
    return ", ".join(f"{value:.12g}" for value in values)


def ball(centre, radius, density, modulus, more=""):
    return (keys(Shape="ball", Centre=triple(centre), Radius=f"{radius:.12g}", Density=density) +
            f"set Young's modulus = {modulus}\nset Poisson's ratio = 0.3\n" + more)


def scene(size, spacing, end, frame, region=None, bodies=(), sides="", more=""):
    """Text of a scene in a box from the origin; `bodies`: sections as ball() makes them."""
    dim = len(size)
    fluid = keys(Density=DENSITY) + (f"set Region = {region}\n" if region else "")
    text = keys(Dimension=dim, Scheme="particle")
    text += section("Time", keys(End=end, Step=frame))
    text += section("Particles", keys(Spacing=f"{spacing:.12g}") + more)
    text += section("Domain", keys(Lower_corner=triple([0] * dim), Upper_corner=triple(size)) +
                    (f"set Open sides = {sides}\n" if sides else ""))
    text += section("Fluid", fluid)
    if bodies:
        text += section("Bodies", "".join(section(f"b{k}", body) for k, body in enumerate(bodies)))
    text += section("Effects", section("gravity", keys(Acceleration=triple([0] * (dim - 1) + [-GRAVITY]))) +
                    section("viscosity", "set Dynamic viscosity = 1e-3\n"))
    return text + section("Output", "set Interval = 0\nset Parts = statistics\n")


class Run:
    """Columns of `statistics` of a scene."""

    def __init__(self, text, arguments):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.prm")
            with open(path, "w") as file:
                file.write(text)
            begin = time.monotonic()
            scene_tools.run(arguments.program, [path, "--output", os.path.join(folder, "out"),
                                                "--set", f"Particles/Executor={arguments.executor}"])
            self.seconds = time.monotonic() - begin
            with open(os.path.join(folder, "out", "summary.json")) as file:
                self.n_particles = json.load(file)["unknowns"]["particles"]
            self.names, _, self.rows = scene_tools.parse(scene_tools.statistics(os.path.join(folder, "out")))

    def column(self, name):
        number = self.names.index(name)
        return [row[number] for row in self.rows]

    def energies(self):
        parts = ["Kinetic energy of fluid", "Kinetic energy of bodies", "Potential energy", "Elastic energy"]
        return [sum(values) for values in zip(*(self.column(part) for part in parts))]


def rest(arguments):
    """(what, found, asked, holds)"""
    for size, precision in itertools.product([(20, 20), (10, 10, 10)], ["single", "double"]):
        if arguments.short and precision == "double":
            continue
        spacing = 0.01
        run = Run(scene([n * spacing for n in size], spacing, 2 if arguments.short else 10, 0.1,
                        more=f"set Precision = {precision}\n"), arguments)
        scale = math.sqrt(GRAVITY * size[-1] * spacing)
        speeds = [speed / scale for speed in run.column("Largest speed")]
        half = len(speeds) // 2
        early, late = max(speeds[:half]), max(speeds[half:])
        yield (f"rest, {len(size)}D, {precision}", f"{early:.1e}, then {late:.1e}", "5e-3, not growing",
               max(early, late) <= 5e-3 and late <= max(2 * early, 1e-5))


def added_mass(dim, share):
    """Of a ball in the middle of a closed cube, over the displaced mass: a dipole and its images; `share`: radius over width."""
    reach = 60 if dim == 2 else 20
    total = 0.0
    for k in itertools.product(range(-reach, reach + 1), repeat=dim):
        square = sum(index * index for index in k)
        if square > 0:
            # Walls that the axis hits turn the dipole around, and so does its image behind them: it keeps its direction
            # across them if their number is even.
            sign = 1 if k[-1] % 2 == 0 else -1
            total += sign * (dim * k[-1] ** 2 / square - 1) * share ** dim / ((dim - 1) * square ** (dim / 2))
    return (1 - dim * total / (1 + total)) / (dim - 1)


def sinking(arguments):
    width, radius = 0.4, 0.05
    for layers, ratio in itertools.product([3, 4] if arguments.short else [4, 5, 8], [2]):
        spacing = radius / layers
        count = 2 * round(width / spacing / 2)
        size = [count * spacing] * 2
        run = Run(scene(size, spacing, 0.3, 0.005,
                        bodies=[ball([size[0] / 2] * 2, radius, ratio * DENSITY, 1e6)]), arguments)
        centre = run.column("Centre of b0 y")
        times = run.column("Time")
        acceleration = (ratio - 1) / (ratio + added_mass(2, radius / size[0])) * GRAVITY
        row = next((k for k, y in enumerate(centre) if centre[0] - y >= radius / 2), len(centre) - 1)
        found = (centre[0] - centre[row]) / (acceleration * times[row] ** 2 / 2)
        yield (f"sinking, radius of {layers} spacings", f"{found:.3f}", "1 within 0.1", abs(found - 1) <= 0.1)


def bounded(name, modulus, density, speed, arguments, allowed, more=""):
    """A ball above or in water, by its speed at the start."""
    spacing, depth, radius = 0.01, 0.2, 0.05
    height = depth - radius if speed == 0 else depth + radius + 0.02
    applies = max(density, DENSITY) * speed**2 < modulus and max(density, DENSITY) * GRAVITY * depth < modulus
    what = f"{name}, {modulus:.0e} Pa, {density:.0f} kg/m^3, {speed} m/s"
    try:
        run = Run(scene([0.4, 0.5], spacing, 2 if arguments.short else 5, 0.02, f"{depth} - y",
                        [ball([0.2, height], radius, density, modulus, f"set Initial velocity = 0; {-speed}\n")],
                        "top", more), arguments)
    except RuntimeError:  # a frame that could not be computed
        return what, "the run stopped", "none (soft for its load)" if not applies else "the end", not applies
    energy = run.energies()
    scale = DENSITY * GRAVITY * depth * depth * 0.4 / 2 if allowed is None else abs(energy[0])
    excess = (max(energy) - energy[0]) / scale
    share = 1e-3 if allowed is None else allowed
    inside = max(run.column("Fluid particles in bodies"))
    lost = run.column("Fluid particles")[0] - run.column("Fluid particles")[-1]
    return (what,
            f"energy {excess:+.1e}, inside {inside:.0f}, lost {lost:.0f}",
            f"{share:.0e}, 0, 0" if applies else "none (soft for its load)",
            not applies or (excess <= share and inside == 0 and lost == 0))


def soft(arguments):
    densities = [100, 2000] if arguments.short else [100, 500, 1000, 2000]
    for modulus, density, speed in itertools.product([1e3, 1e4], densities, [0, 0.5, 2]):
        yield bounded("soft", modulus, density, speed, arguments, None)


def stiff(arguments):
    for density, speed in itertools.product([500] if arguments.short else [100, 500, 2000], [0, 0.5, 2]):
        yield bounded("stiff", 1e9, density, speed, arguments, 5e-3,
                      section("Sub-steps", "set Implicit above = 20\n"))


def settling(count, arguments):
    """A run and its balls (radius)."""
    random.seed(1)
    spacing, columns = 0.01, 20
    pitch = 0.14
    radii, bodies = [], []
    for k in range(count):
        radius = spacing * random.choice([3, 4, 5, 6])
        radii.append(radius)
        bodies.append(ball([pitch * (k % columns + 0.5), 0.3 + pitch * (k // columns + 0.5)], radius,
                           random.choice([300, 800, 1500, 3000]), 1e6))
    rows = math.ceil(200 / columns)
    size = [pitch * columns, round((0.3 + pitch * rows) / spacing) * spacing]
    run = Run(scene(size, spacing, 0.5 if arguments.short else 3, 0.02, f"{0.3 + pitch * rows / 2} - y", bodies, "top"),
              arguments)
    return run, radii


def many(arguments):
    count = 20 if arguments.short else 200
    run, radii = settling(count, arguments)
    centres = [list(zip(run.column(f"Centre of b{k} x"), run.column(f"Centre of b{k} y"))) for k in range(count)]
    overlap = max(radii[i] + radii[j] - math.dist(centres[i][row], centres[j][row])
                  for row in range(0, len(run.rows), 5) for i in range(count) for j in range(i)) / 0.01
    yield (f"many, {count} balls", f"overlap {overlap:.2f} spacings", "0.3", overlap <= 0.3)
    one, _ = settling(1, arguments)
    cost = [r.seconds / sum(r.column("Sub-steps")) / r.n_particles for r in (run, one)]
    yield (f"many, {count} balls over one", f"{cost[0] / cost[1]:.2f} of the time", "1.3", cost[0] <= 1.3 * cost[1])


ROWS = {"rest": rest, "sinking": sinking, "soft": soft, "stiff": stiff, "many": many}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rows", nargs="+", choices=list(ROWS), default=list(ROWS))
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--program", default=os.path.join(ROOT, "build", "undine"))
    parser.add_argument("--executor", default="host")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    print("| run | found | allowed | holds |\n|---|---|---|---|")
    broken = []
    for name in arguments.rows:
        for what, found, allowed, holds in ROWS[name](arguments):
            print(f"| {what} | {found} | {allowed} | {'yes' if holds else 'NO'} |", flush=True)
            if not holds:
                broken.append(what)
    if arguments.check and broken:
        sys.exit("does not hold: " + "; ".join(broken))


if __name__ == "__main__":
    main()
