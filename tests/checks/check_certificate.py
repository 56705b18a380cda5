#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The certificate of runs that are known to be stable, to grow and to fail, in the plane and in space; it changes no number,
and a run that was taken up again is judged by its own steps.

usage: check_certificate.py PROGRAM SCENES
"""
import json
import os
import sys
import tempfile

import scene_tools

SHEETS = ("first", "second")
# doc/splitting.md, case B: stiff light sheets, in turns with the fluid.
LIGHT = ["Time/Maximum cuts=0", "Time/Theta=0.505", "Time/Step=1/30", "Effects/damping/Stiffness coefficient=1e-3",
         "Effects/convection/Method=semi-Lagrangian", "Solid numerics/Newton iterations=4",
         "Fluid/Boundaries/jet/Velocity=2*min(t/0.3,1); 0"]
for sheet, x in zip(SHEETS, (0.713, 1.213)):
    LIGHT += [f"Bodies/{sheet}/Density=24.1", f"Bodies/{sheet}/Young's modulus=7.7e7", f"Bodies/{sheet}/Cells=1, 6",
              f"Bodies/{sheet}/Lower corner={x}, -0.05", f"Bodies/{sheet}/Upper corner={x + 0.02}, 0.6"]
# In space: a sheet of eight and a half times the density of water, in steps that are too long for turns.
SPACE = ["Domain/Cells=16, 8, 8", "Bodies/sheet/Cells=1, 4, 2", "Time/Step=1/30", "Time/Energy monitor=warn", "Time/Maximum cuts=0",
         "Bodies/sheet/Density=8500", "Bodies/sheet/Young's modulus=3e9"]
# An integrator that is not stable with a heavy fluid (doc/time_integration.md); nothing goes in or out.
UNSTABLE = ["Time/Integrator=generalised_alpha", "Time/Spectral radius=0.5", "Time/Step=1/32", "Time/Energy monitor=warn"]
# A box whose lid moves, with an outflow; and a tube of one row of cells, at rest under a pressure until it falls.
LID = """
set Title = A lid and an outflow
set Dimension = 2
subsection Time
  set End  = 1
  set Step = 0.05
end
subsection Domain
  set Cells = 16, 16
end
subsection Fluid
  set Density = 1
  subsection Boundaries
    subsection walls
      set Sides = left, bottom
      set Kind  = no-slip wall
    end
    subsection outlet
      set Sides = right
      set Kind  = outflow
    end
    subsection lid
      set Sides    = top
      set Kind     = moving wall
      set Velocity = 1; 0
    end
  end
end
subsection Effects
  subsection convection
  end
  subsection viscosity
    set Dynamic viscosity = 0.01
  end
end
"""
TUBE = """
set Title = A tube of one row
set Dimension = 2
subsection Time
  set End  = 0.5
  set Step = 0.05
end
subsection Domain
  set Cells = 16, 1
end
subsection Fluid
  set Density = 1
  subsection Boundaries
    subsection end
      set Sides    = left
      set Kind     = pressure
      set Pressure = if(t<0.22,1,0)
    end
  end
end
subsection Effects
  subsection convection
  end
end
"""
IN_TURNS = ["Scheme=time_splitting"]
TOGETHER = ["Scheme=simultaneous"]


class Runs:
    def __init__(self, program, scenes, folder):
        self.program, self.scenes, self.folder, self.n = program, scenes, folder, 0

    def __call__(self, scene, settings, exit_code=0):
        """Certificate, output and folder of a run that ends with this exit code."""
        self.n += 1
        folder = os.path.join(self.folder, str(self.n))
        words = [word for setting in settings + ["Output/Parts=statistics, checkpoint"] for word in ("--set", setting)]
        code, said, errors = scene_tools.ended(self.program, [os.path.join(self.scenes, scene), "--output", folder] + words)
        require(code == exit_code, f"{scene} {settings}: exit code {code}\n{said[-2000:]}\n{errors}")
        return certificate(folder), said, folder


def require(condition, what):
    if not condition:
        sys.exit(f"check_certificate.py: {what}")


def certificate(folder):
    with open(os.path.join(folder, "summary.json")) as file:
        return json.load(file)["certificate"]


def columns(folder):
    names, _, rows = scene_tools.parse(scene_tools.statistics(folder))
    return dict(zip(names, zip(*rows)))


def check_stable(run):
    for scene, settings in (("jet_two_sheets_split_2d.prm", LIGHT + TOGETHER + ["Time/End=1.2"]),
                            ("sheet_in_cross_flow.prm", SPACE + TOGETHER + ["Time/End=0.8"])):
        found, said, folder = run(scene, settings)
        require(found["verdict"] == "stable" and found["text"] == "stable" and "verdict: stable" in said, f"{scene}: {found}")
        require("since [s]" not in found, f"{scene}: what does not grow does so since {found}")
        laws = {law["law"]: law for law in found["margins"]}
        require({"energy", "volume of the fluid"} < set(laws) and all(0 < law["margin"] <= 1 for law in laws.values()),
                f"{scene}: margins {laws}")
        for law in laws.values():
            require(abs(1 - law["value"] / law["bound"] - law["margin"]) < 1e-5, f"{scene}: {law}")
    return folder


def check_growing(run):
    found, said, _ = run("jet_two_sheets_split_2d.prm", LIGHT + IN_TURNS + ["Time/End=1.1"])
    require(found["verdict"] == "growing" and found["grows"] == "amplitude" and found["where"] in ("body first", "body second") and
            found["mode"] == "swings from step to step" and found["since [s]"] < 0.5 and 1.1 < found["factor per step"] < 1.6,
            f"sheets in turns: {found}")
    require("WARNING: growing since" in said, f"sheets in turns: not loud enough\n{said[-2000:]}")
    found, said, _ = run("piston.prm", UNSTABLE + ["Time/End=1.5"])
    require(found["verdict"] == "growing" and found["grows"] == "energy" and found["where"] == "body bar" and
            found["factor per step"] > 1.01, f"piston: {found}")
    found, said, _ = run("sheet_in_cross_flow.prm", SPACE + IN_TURNS + ["Time/End=1.2"])
    require(found["verdict"] == "growing" and "WARNING: growing since" in said, f"sheet in space: {found}")


def check_failed(run):
    for scene, settings in (("jet_two_sheets_split_2d.prm", ["Time/Step=1/480", "Time/End=0.05", "Time/Maximum cuts=0"]),
                            ("sheet_in_cross_flow.prm", SPACE + IN_TURNS + ["Bodies/sheet/Density=1100", "Time/End=1",
                                                                            "Bodies/sheet/Young's modulus=3e7"])):
        found, _, folder = run(scene, settings, 3)
        last = columns(folder)["Time"][-1]
        require(found["verdict"] == "failed" and found["text"].startswith(f"failed at t = {last:.6g} s: ") and
                "ry" in found["text"], f"{scene}: {found}")


def check_redone(run):
    found, _, _ = run("piston.prm", ["Time/Integrator=generalised_alpha", "Time/Spectral radius=0", "Time/Step=1/64", "Time/End=0.2"])
    require(found["steps redone"] > 0.01 * found["steps"] and
            f"{found['steps redone']} of {found['steps']} steps were redone" in found["text"], f"redone: {found}")


def check_resumption(run, folder):
    before = certificate(folder)["steps"]
    scene_tools.run(run.program, ["resume", folder, "--set", "Time/End=0.9"])
    found = certificate(folder)
    require(before == 24 and found["steps"] == 3 and found["verdict"] == "stable", f"resumed after {before} steps: {found}")


def check_account(run):
    """Its columns add up to what was created, and others are the same without them."""
    settings = UNSTABLE + ["Time/End=0.3"]
    _, _, plain = run("piston.prm", settings)
    _, _, folder = run("piston.prm", settings + ["Output/Energy account=true"])
    with_account = columns(folder)
    for name, values in columns(plain).items():
        require(values == with_account[name], f"the account has changed '{name}'")
    created = 0
    for n in range(1, len(with_account["energy"])):
        gain = with_account["energy"][n] - with_account["energy"][n - 1]
        created = max(0, created + gain - with_account["energy put in"][n])
        require(abs(created - with_account["energy created"][n]) < 1e-8, f"step {n}: {created} J were created")
    require(created > 0.01, f"an unstable run has created {created} J only")
    run_without = ["Output/Energy account=true", "Time/Energy monitor=off"]
    code, _, errors = scene_tools.ended(run.program, [os.path.join(run.scenes, "piston.prm"), "--validate"] + [
        word for setting in run_without for word in ("--set", setting)])
    require(code == 2 and "Energy account" in errors, f"an account without a monitor: exit code {code}\n{errors}")


def check_chamber(run):
    """(V11) is looked at."""
    found, _, _ = run("hard/thin_membrane.prm", ["Time/Step=1/30", "Time/Maximum steps=5"])
    law = [each for each in found["margins"] if each["law"] == "volume of inside"]
    require(len(law) == 1 and 0 <= law[0]["value"] < 1e-3, f"chamber: {found}")


def check_fluid_alone(run, folder):
    """No step is redone for energy that leaves through an opening, and rest is no lack of divergence."""
    for text, steps in ((LID, 20), (TUBE, 10)):
        file = os.path.join(folder, "fluid.prm")
        with open(file, "w") as scene:
            scene.write(text)
        found, _, results = run(file, [])
        require(found["text"] == "stable" and found["steps"] == steps and found["steps redone"] == 0, f"{text}: {found}")
        require(max(columns(results)["Fluid divergence"]) < 1e-5, f"{text}: {columns(results)['Fluid divergence']}")


def main():
    with tempfile.TemporaryDirectory() as folder:
        run = Runs(*sys.argv[1:3], folder)
        check_resumption(run, check_stable(run))
        check_growing(run)
        check_failed(run)
        check_redone(run)
        check_account(run)
        check_chamber(run)
        check_fluid_alone(run, folder)


if __name__ == "__main__":
    main()
