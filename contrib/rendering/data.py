# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reading what a run wrote for ParaView: solution.pvd and the files it names."""
import json
import sys
import xml.etree.ElementTree

from .part import Part, name_of, read
from .particle_part import particle_parts

SIDES_OF_GRIDS = ("left", "right", "top", "front")  # walls or not: a floor and a back wall show where things are


class Run:
    """The folder of a run: its times of output, and what it says of itself."""

    def __init__(self, results):
        self.results = results
        self.files = self.read_times()  # by time
        self.times = sorted(self.files)
        try:
            self.parameters = json.loads((results / "parameters.json").read_text())
        except (OSError, ValueError):
            self.parameters = {}
        bodies = self.parameters.get("Output", {}).get("vtu", {}).get("Bodies")
        self.moved = 1.0 if bodies == "deformed" else 0.0

    def read_times(self):
        pvd = self.results / "solution.pvd"
        if not pvd.is_file():
            sys.exit(f"render: '{pvd}' is not there: is '{self.results}' the folder of a run with "
                     "output 'vtu'?")
        files = {}
        for data_set in xml.etree.ElementTree.parse(pvd).iter("DataSet"):
            files.setdefault(float(data_set.get("timestep", "0")), []).append(
                self.results / data_set.get("file"))
        return files

    def domain(self):
        """Bounds of the domain as the scene says, if it is given in numbers."""
        section = self.parameters.get("Domain", {})
        try:
            low, high = ([float(word) for word in section[key].split(",")] for key in ("Lower corner", "Upper corner"))
        except (KeyError, ValueError, AttributeError):
            return None
        low, high = (corner + [0.0] * (3 - len(corner)) for corner in (low, high))
        return [end for pair in zip(low, high) for end in pair]

    def room(self):
        """(bounds, names of open sides) of a fluid's domain, if there is one. Only tanks of particles say which are open."""
        bounds = self.domain()
        if not bounds or "Fluid" not in self.parameters:
            return None
        section = self.parameters["Domain"]
        sides = section.get("Open sides", "") + "," + section.get("Periodic sides", "")
        return bounds, SIDES_OF_GRIDS if "Cells" in section else [side.strip() for side in sides.split(",")]

    def interval(self):
        return (self.times[-1] - self.times[0]) / max(1, len(self.times) - 1)

    def nearest(self, time):
        return min(self.times, key=lambda own: abs(own - time))

    def stopped(self, time):
        """Was the run over at this time, before the end that it should have reached?"""
        end = float(self.parameters.get("Time", {}).get("End", 0))
        return not self.has_ended() and time > self.times[-1] + 1e-9 and end > self.times[-1] + 1e-9

    def has_ended(self):
        """Has the run come to its end, which may be before 'Time/End' where it has become steady?"""
        try:
            return bool(json.loads((self.results / "summary.json").read_text()).get("ended"))
        except (OSError, ValueError, AttributeError):
            return False

    def label(self):
        name = self.results.resolve().name
        step = float(self.parameters.get("Time", {}).get("Step", 0))
        scheme = self.parameters.get("Scheme", "").replace("_", " ")
        return (f"{self.parameters.get('Title', '')}\n" +
                (f"{name}: {scheme}, h = {step:.3g} s" if scheme else name))

    def parts(self, time, options):
        """The parts at one of its times that exist, are not empty, and are drawn: obstacles are, but the pieces into which the
        grid cuts all surfaces only end the fluid and lines along its flow."""
        files = {name_of(file): file for file in self.files[time] if file.is_file()}
        surface = files.pop("surface", None)
        parts = []
        for name, file in files.items():
            if name == "particles":
                parts += particle_parts(file, float(self.parameters.get("Particles", {}).get("Spacing", 0)))
            else:
                parts.append(Part(file, self.moved))
        parts = [part for part in parts if not part.is_empty()]
        for part in parts:
            if part.is_fluid() and "velocity" in part.fields:
                if options.field == "vorticity":
                    part.derive_vorticity()
                part.surface = read(surface) if surface else None
        return parts


def film_times(runs):
    """Those of the run with the shorter interval, then what another has beyond its end."""
    lead = min(runs, key=Run.interval)
    later = {time for run in runs for time in run.times if time > lead.times[-1] + 1e-9}
    return lead.times + sorted(later)
