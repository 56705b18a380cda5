# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the picture of a scene in the gallery shows, where the defaults of contrib/render do not say enough."""
import dataclasses


@dataclasses.dataclass
class Look:
    view: str = ""  # options of contrib/render
    at: float = 1.0  # share of the times that there are
    run: str = ""  # settings of the run


LOOKS = {
    "ball_in_stream": Look("--camera 0.5,0.35,1"),
    "cavity": Look("--streamlines"),
    "dam_break_impact_particles": Look(at=0.5),
    "dam_break_impact_particles_3d": Look("--surface"),
    "dam_break_particles": Look(at=0.4),
    "dfg_2d1": Look(run="Output/Interval=1/4"),
    "elastic_sphere": Look("--surface"),
    "elastic_plate_cross_flow": Look("--slice z=0 --field speed", run="Output/Interval=1/10"),
    "heated_cavity": Look("--streamlines"),
    "hydrostatic_particles": Look("--field pressure"),
    "jet_over_weir_particles": Look(run="Output/Walls=true"),
    "oscillating_cylinder": Look("--field vorticity"),
    "piston": Look("--field pressure", at=0.2),
    "pressure_pulse_tube": Look("--field pressure", at=0.5, run="Output/Interval=5e-4"),
    "taylor_green": Look("--field vorticity --streamlines", at=0),
    "turek_hron_cfd1": Look("--streamlines", run="Output/Interval=1/4"),
    "turek_hron_cfd2": Look(run="Output/Interval=1/4"),
    "turek_hron_cfd3": Look("--field vorticity", run="Output/Interval=1/20"),
    "turek_hron_fsi2": Look("--field vorticity"),
    "turek_hron_fsi3": Look("--field vorticity"),
    "two_balls_3d": Look(at=0.3),
    "wave_paddle_particles": Look(at=0.6),
}
