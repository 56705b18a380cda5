# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the picture of a scene in the gallery shows, where the defaults of contrib/render do not say enough."""
import dataclasses


@dataclasses.dataclass
class Look:
    view: str = ""  # options of contrib/render
    at: float = 1.0  # share of the times that there are
    run: str = ""  # settings of the run, with blanks between: other outputs, or a coarser run where the scene takes long


FIELDS = "Output/Parts=vtu"  # where the scene writes none

LOOKS = {
    "ball_in_stream": Look("--camera 0.5,0.35,1"),
    "balloon": Look("--slice z=0 --streamlines", at=0.65),
    "cavity": Look("--streamlines"),
    "dam_break_impact_particles": Look(at=0.5),
    "dam_break_impact_particles_3d": Look("--surface --field speed", at=0.6),
    "dam_break_particles": Look(at=0.4),
    "dfg_2d1": Look(run=f"{FIELDS} Output/Interval=1/4"),
    "elastic_sphere": Look("--surface", at=0.07),
    "elastic_plate_cross_flow": Look("--streamlines"),
    "hard/at_rest": Look(run=f"{FIELDS} Output/Interval=10"),
    "hard/body_drifts_through": Look(at=0.5),
    "hard/body_drifts_through_3d": Look(at=0.4),
    "heated_cavity": Look("--streamlines"),
    "hydrostatic_particles": Look("--field pressure"),
    "jet_over_weir_particles": Look(run="Output/Walls=true"),
    "oscillating_cylinder": Look("--field vorticity"),
    "piston": Look("--field pressure", at=0.2),
    "plume": Look("--range 0,0.6 --field smoke"),
    "pressure_pulse_tube": Look("--field pressure", run="Output/Interval=5e-4"),
    "sheet_in_cross_flow": Look("--streamlines"),
    "taylor_green": Look("--field vorticity --streamlines", at=0),
    "turek_hron_cfd1": Look("--streamlines", run=f"{FIELDS} Output/Interval=1/4"),
    "turek_hron_cfd2": Look(run=f"{FIELDS} Output/Interval=1/4"),
    "turek_hron_cfd3": Look("--field vorticity", run=f"{FIELDS} Output/Interval=1/20"),
    "turek_hron_fsi2": Look("--field vorticity"),
    "turek_hron_fsi3": Look("--field vorticity"),
    "two_balls": Look(at=0.12),
    "two_balls_3d": Look(at=0.3),
    "wave_paddle_particles": Look(at=0.6),
}
