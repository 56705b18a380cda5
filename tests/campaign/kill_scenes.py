# SPDX-License-Identifier: LGPL-2.1-or-later
"""Twelve small scenes of all methods, which a run can be stopped in: 20 to 60 steps in some seconds."""
import dataclasses
import os

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

# On other numbers of ranks sums are rounded differently; solvers must not stop at another iteration for that.
EXACT_BODIES = ("Solid numerics/Newton tolerance=1e-13",)
EXACT_COUPLING = EXACT_BODIES + ("Coupling/Linear tolerance=1e-12",)


@dataclasses.dataclass(frozen=True)
class Scene:
    """What is run: a file of the repository, and settings that make it small ("Section/Key=value")."""
    name: str
    file: str
    settings: tuple
    most_ranks: int = 3  # on which it can be resumed

    def arguments(self):
        """Of the command line: the scene's file and its settings."""
        result = [os.path.join(ROOT, self.file)]
        for setting in self.settings:
            result += ["--set", setting]
        return result


SCENES = (
    Scene("fluid alone, 2D", "prm/taylor_green.prm",
          ("Domain/Cells=48, 48", "Time/End=0.4")),
    Scene("fluid with smoke, 3D", "prm/plume.prm",
          ("Domain/Cells=12, 24, 12", "Time/End=4/3", "Output/Parts=xdmf, checkpoint")),
    Scene("body alone, 3D", "prm/cantilever.prm",
          ("Bodies/beam/Cells=8, 1, 2", "Time/End=0.3") + EXACT_BODIES),
    Scene("bodies in contact, 2D", "prm/two_balls.prm",
          ("Time/End=0.3", "Output/Interval=0.03") + EXACT_BODIES),
    Scene("moving obstacle, smoke, 2D", "tests/resume/paddle.prm",
          ("Time/End=4/3", "Output/Interval=0.1")),
    Scene("coupled, friction, 2D", "tests/resume/friction.prm",
          ("Time/End=0.4", "Output/Interval=0.04") + EXACT_COUPLING),
    Scene("coupled, steps by tolerance, 2D", "tests/resume/piston_by_tolerance.prm",
          ("Time/End=0.4", "Output/Interval=0.04", "Domain/Cells=16, 4")),
    Scene("coupled, sleeping bodies, 2D", "tests/resume/sleeping.prm",
          ("Time/End=0.8", "Output/Interval=0.08", "Output/Parts=vtu, checkpoint") + EXACT_COUPLING),
    Scene("coupled, void region, 2D", "prm/hydrostatic_plate.prm",
          ("Time/End=2/3",) + EXACT_COUPLING),
    Scene("coupled, 3D", "prm/sheet_in_cross_flow.prm",
          # Nodes of the sheet stay on its plane of symmetry. If that were a plane of the grid, rounding
          # would decide on which side of it they are.
          ("Domain/Cells=12, 6, 5", "Bodies/sheet/Cells=1, 4, 3", "Time/End=2/3",
           "Output/Interval=0.1") + EXACT_COUPLING),
    Scene("particles: floating block, 2D", "prm/floating_block.prm",
          ("Particles/Spacing=0.02", "Time/End=0.4"), 1),
    Scene("particles: jet and drain, 2D", "prm/jet_over_weir_particles.prm",
          ("Particles/Spacing=0.02", "Time/End=0.5", "Output/Interval=0.05"), 1),
)
