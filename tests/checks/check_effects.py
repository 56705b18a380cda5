#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A scene pays for the effects that it calls for and for nothing else, and a run shows it.

usage: check_effects.py PROGRAM FOLDER_OF_SCENES
"""
import json
import math
import os
import re
import sys
import tempfile

import scene_tools

# A plate in a channel: stands in the stream, too stiff to move.
STIFF_PLATE = """
set Dimension = 2
subsection Time
  set End = 0.1
  set Step = 0.02
end
subsection Domain
  set Upper corner = 2, 1
  set Cells = 24, 12
end
subsection Fluid
  set Density = 1
  set Initial velocity = 1; 0
  subsection Boundaries
    subsection in
      set Sides = left
      set Kind = inflow
      set Velocity = 1; 0
    end
    subsection out
      set Sides = right
      set Kind = outflow
    end
  end
end
subsection Bodies
  subsection plate
    set Shape = box
    set Lower corner = 0.8, -0.1
    set Upper corner = 0.9, 0.5
    set Cells = 1, 6
    set Density = 2
    set Material = neo-Hookean
    set Young's modulus = 1e9
    set Poisson's ratio = 0.3
    subsection Boundaries
      subsection foot
        set Sides = bottom
        set Kind = clamp
      end
    end
  end
end
"""


def run(program, scene, *settings, ranks=1):
    """What a run of a few steps leaves: effects by name, the whole of effects.json, log and phases."""
    with tempfile.TemporaryDirectory() as folder:
        if "\n" in scene:
            path = os.path.join(folder, "scene.prm")
            with open(path, "w") as file:
                file.write(scene)
            scene = path
        arguments = [scene, "--output", os.path.join(folder, "out")]
        for setting in ("Time/Maximum steps=3", "Output/Parts=", *settings):
            arguments += ["--set", setting]
        scene_tools.run(program, arguments, ranks)
        read = {}
        for name in ("effects.json", "log.txt", "timing"):
            with open(os.path.join(folder, "out", name)) as file:
                read[name] = file.read()
    whole = json.loads(read["effects.json"])
    phases = {line.split("  ")[0].strip() if not line.startswith(" ") else
              re.split(r"\s{2,}", line.strip())[0] for line in read["timing"].splitlines()[1:]}
    return {effect["name"]: effect for effect in whole["effects"]}, whole, read["log.txt"], phases


def expect(what, holds, shown=""):
    if not holds:
        sys.exit(f"{what}\n{shown}")


def check_rows(effects, log):
    for name, effect in effects.items():
        expect(f"'{name}' must say why", effect["why"] and effect["rule"], effect)
        state = "on" if effect["on"] else "off"
        expect(f"the log must list '{name}' as {state}",
               re.search(rf"^{re.escape(name)} +{state} ", log, re.MULTILINE), log)
        if not effect["on"]:
            cost = [effect[key] for key in ("calls", "seconds", "bytes at start", "peak bytes")]
            expect(f"'{name}' is off and must cost nothing", cost == [0, 0, 0, 0], effect)


def check_obstacles(program, folder):
    effects, _, log, phases = run(program, os.path.join(folder, "obstacle_flow.prm"))
    check_rows(effects, log)
    on = {name for name, effect in effects.items() if effect["on"]}
    expect("a fixed obstacle in a stream that carries smoke calls for just that",
           on == {"convection", "scalar transport", "surfaces in the fluid"}, on)
    solid = phases & {"solid", "couple", "assemble forces", "assemble tangent",
                      "solve linear system"}
    expect("a rigid obstacle costs no solid solve", not solid, phases)
    cells = 128 * 64 * 8  # bytes of a number in each
    for name in ("convection", "scalar transport"):
        expect(f"'{name}' must have calls and memory", effects[name]["calls"] > 0 and
               effects[name]["peak bytes"] >= cells, effects[name])
    smoke = effects["scalar transport"]
    expect("the smoke is a field of the state from the start, and needs another while advected",
           cells <= smoke["bytes at start"] < 2 * cells <= smoke["peak bytes"] < 5 * cells, smoke)

    moving, _, _, _ = run(program, os.path.join(folder, "moving_paddle.prm"))
    expect("a paddle moves", moving["motion of obstacles"]["on"] and
           not moving["deformable bodies"]["on"], moving)


def check_still_fluid(program):
    scene = ("set Dimension = 2\nsubsection Time\nset End = 1\nset Step = 0.1\nend\n"
             "subsection Domain\nset Cells = 8, 8\nend\nsubsection Fluid\nset Density = 1\nend\n"
             "subsection Effects\nsubsection gravity\nset Acceleration = 0, -9.81\nend\nend\n")
    effects, whole, log, phases = run(program, scene)
    check_rows(effects, log)
    expect("a still fluid without convection has no convection pass",
           "convection" not in phases and not effects["convection"]["on"], phases)
    expect("a fluid at rest gives no advice", whole["advice"] == [], whole["advice"])


def check_solid(program, folder):
    scene = os.path.join(folder, "cantilever.prm")
    one, _, log, _ = run(program, scene)
    check_rows(one, log)
    for name in ("gravity", "damping", "deformable bodies", "finite strain"):
        expect(f"'{name}' must be called", one[name]["calls"] > 0, one[name])
    three, whole, _, _ = run(program, scene, ranks=3)
    ratio = three["deformable bodies"]["peak bytes"] / one["deformable bodies"]["peak bytes"]
    expect("memory is that of all ranks", whole["ranks"] == 3 and 0.9 < ratio < 1.6, ratio)
    linear, _, _, _ = run(program, scene, "Bodies/beam/Material=linear elastic")
    expect("a linear law is no finite strain", not linear["finite strain"]["on"], linear)


def advice_of(program, scene, *settings):
    _, whole, log, _ = run(program, scene, *settings)
    for remark in whole["advice"]:
        expect("the log must have the advice", f"advice: '{remark['effect']}'" in log, log)
        expect("advice needs a number and a rule", remark["number"] and remark["rule"] and
               math.isfinite(remark["value"]), remark)
    return {(remark["effect"], remark["on"]) for remark in whole["advice"]}


def check_advice(program, folder):
    beam = os.path.join(folder, "cantilever.prm")
    expect("a beam that hardly bends needs no finite strain",
           ("finite strain", True) in advice_of(program, beam,
                                                "Effects/gravity/Acceleration=0, -1e-4, 0"))
    expect("a beam that bends a lot does",
           ("finite strain", False) in advice_of(program, beam,
                                                 "Bodies/beam/Material=linear elastic",
                                                 "Effects/gravity/Acceleration=0, -1e5, 0"))
    stiff = advice_of(program, STIFF_PLATE)
    expect("a fluid without friction that moves advects its velocity",
           ("convection", False) in stiff, stiff)
    expect("a plate that stands still does not need to push",
           ("two-way coupling", True) in stiff, stiff)
    soft = advice_of(program, STIFF_PLATE, "Bodies/plate/Young's modulus=20",
                     "Coupling/Direction=fluid to body", "Effects/convection/Method=cubic")
    expect("a plate that bends in the stream should",
           ("two-way coupling", False) in soft, soft)
    crawling = os.path.join(folder, "cavity.prm")
    expect("in creeping flow inertia does not count", ("convection", True) in advice_of(
        program, crawling, "Effects/viscosity/Dynamic viscosity=1e4"))


def main():
    program, folder = sys.argv[1:3]
    check_obstacles(program, folder)
    check_still_fluid(program)
    check_solid(program, folder)
    check_advice(program, folder)
    print("effects cost what they do, and the run shows it")


main()
