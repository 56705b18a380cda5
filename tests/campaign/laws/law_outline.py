# SPDX-License-Identifier: LGPL-2.1-or-later
"""Outlines of plane bodies, followed by a probe at every node: what area a body takes, and where."""
import dataclasses
import math

import law_scenes


@dataclasses.dataclass(frozen=True)
class Outline:
    """Of a body: its nodes at rest, counter-clockwise, corners of cells and middles of their edges in turn."""
    body: str
    nodes: tuple  # of pairs [m]

    def probe(self, number):
        return f"{self.body}_{number}"

    def settings(self):
        """Probes that follow the nodes."""
        result = {}
        for number, node in enumerate(self.nodes):
            result[f"Probes/{self.probe(number)}"] = {
                "Kind": "body point", "Body": self.body, "Point": law_scenes.point(node)}
        return result

    def polygons(self, run):
        """Of every row of `statistics`: where the nodes are."""
        motions = [[run.column(f"{self.probe(number)} displacement {axis}") for axis in "xy"]
                   for number in range(len(self.nodes))]
        return [[(x + xs[row], y + ys[row]) for (x, y), (xs, ys) in zip(self.nodes, motions)]
                for row in range(len(run.times()))]


def with_middles(corners):
    """Nodes of a closed line through `corners`, straight between them at rest."""
    result = []
    for one, other in zip(corners, corners[1:] + corners[:1]):
        result += [one, tuple((a + b) / 2 for a, b in zip(one, other))]
    return tuple(result)


def of_box(body, lower, upper, cells, position=lambda x, y: (x, y)):
    """Of a box whose corners of cells rest at `position`, a function of where the box has them."""
    xs, ys = ([low + (high - low) * k / n for k in range(n + 1)] for low, high, n in zip(lower, upper, cells))
    rim = [(x, ys[0]) for x in xs[:-1]] + [(xs[-1], y) for y in ys[:-1]]
    rim += [(x, ys[-1]) for x in xs[:0:-1]] + [(xs[0], y) for y in ys[:0:-1]]
    return Outline(body, with_middles([position(x, y) for x, y in rim]))


def of_ball(body, centre, radius, refinements):
    """Of a ball in the plane, whose rim is four curved edges that are split; their middles lie on the circle, too."""
    nodes = 8 * 2 ** refinements
    angles = [math.pi / 4 + 2 * math.pi * k / nodes for k in range(nodes)]
    return Outline(body, tuple((centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle))
                               for angle in angles))


def area_and_moment(polygon):
    """Area [m^2] and its integral of y [m^3], of the polygon that the fluid meets."""
    area = moment = 0.0
    for (x, y), (next_x, next_y) in zip(polygon, polygon[1:] + polygon[:1]):
        cross = x * next_y - next_x * y
        area += cross / 2
        moment += cross * (y + next_y) / 6
    return area, moment
