# SPDX-License-Identifier: LGPL-2.1-or-later
"""Surfaces of bodies as the fluid meets them, flat facets between nodes that probes follow: what volume a body takes, and
where."""
import dataclasses
import itertools
import math

import law_scenes


@dataclasses.dataclass(frozen=True)
class Outline:
    """Of a body: its nodes at rest, and facets of dim nodes each, counted in these: segments with the body on their left,
    triangles that run counter-clockwise seen from outside."""
    body: str
    nodes: tuple  # of places [m]
    facets: tuple

    def probe(self, number):
        return f"{self.body}_{number}"

    def settings(self):
        """Probes that follow the nodes."""
        result = {}
        for number, node in enumerate(self.nodes):
            result[f"Probes/{self.probe(number)}"] = {
                "Kind": "body point", "Body": self.body, "Point": law_scenes.point(node)}
        return result

    def places(self, run):
        """Of every row of `statistics`: where the nodes are."""
        motions = [[run.column(f"{self.probe(number)} displacement {axis}") for axis in "xyz"[:len(node)]]
                   for number, node in enumerate(self.nodes)]
        return [[tuple(x + of_axis[row] for x, of_axis in zip(node, motion)) for node, motion in zip(self.nodes, motions)]
                for row in range(len(run.times()))]

    def volume(self, places):
        """Volume [m^dim] with the nodes at `places`, by the simplices between facets and the origin."""
        dim = len(places[0])
        return sum(determinant([places[node] for node in facet]) for facet in self.facets) / math.factorial(dim)

    def depth(self, places, surface):
        """The integral of surface - y over what is below the height `surface` [m^(dim+1)]: by the divergence theorem that of
        -(surface - y)^2 / 2 over the facets, times the normal's y."""
        result = 0.0
        for facet in self.facets:
            for corners in below([places[node] for node in facet], surface):
                heights, n = [surface - corner[1] for corner in corners], len(corners)
                squares = sum(a * b for k, a in enumerate(heights) for b in heights[:k + 1])
                result -= area_along_y(corners) * squares / (n * (n + 1))
        return result


def area_along_y(corners):
    """The y of a facet's area times its normal."""
    if len(corners) == 2:
        return corners[0][0] - corners[1][0]
    (ax, _, az), (bx, _, bz), (cx, _, cz) = corners
    return ((bz - az) * (cx - ax) - (bx - ax) * (cz - az)) / 2


def below(corners, surface):
    """The parts of a facet below the height `surface`, as facets."""
    cut = []
    for one, other in zip(corners, corners[1:] + corners[:1]):
        if one[1] < surface:
            cut.append(one)
        if (one[1] < surface) != (other[1] < surface):
            share = (surface - one[1]) / (other[1] - one[1])
            cut.append(tuple(a + share * (b - a) for a, b in zip(one, other)))
    if len(corners) == 2:  # the way back has met the same place
        return [cut[:2]] if cut else []
    return [[cut[0], *pair] for pair in zip(cut[1:], cut[2:])]


def determinant(rows):
    if len(rows) == 2:
        (a, b), (c, d) = rows
        return a * d - b * c
    (a, b, c), (d, e, f), (g, h, i) = rows
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def closed_line(nodes):
    """The facets of a line through `nodes`, counter-clockwise, in the plane."""
    numbers = range(len(nodes))
    return tuple(zip(numbers, [*numbers[1:], 0]))


def with_middles(corners):
    """Nodes of a closed line through `corners`, straight between them at rest."""
    result = []
    for one, other in zip(corners, corners[1:] + corners[:1]):
        result += [one, tuple((a + b) / 2 for a, b in zip(one, other))]
    return tuple(result)


def planes(lower, upper, cells):
    """The coordinates of a box's nodes along each axis."""
    return [[low + (high - low) * k / n for k in range(n + 1)] for low, high, n in zip(lower, upper, cells)]


def of_box(body, lower, upper, cells, position=lambda x, y: (x, y)):
    """Of a box in the plane whose corners of cells rest at `position`, a function of where the box has them."""
    xs, ys = planes(lower, upper, cells)
    rim = [(x, ys[0]) for x in xs[:-1]] + [(xs[-1], y) for y in ys[:-1]]
    rim += [(x, ys[-1]) for x in xs[:0:-1]] + [(xs[0], y) for y in ys[:0:-1]]
    nodes = with_middles([position(x, y) for x, y in rim])
    return Outline(body, nodes, closed_line(nodes))


def of_ball(body, centre, radius, refinements):
    """Of a ball in the plane, whose rim is four curved edges that are split; their middles lie on the circle, too."""
    number = 8 * 2 ** refinements
    angles = [math.pi / 4 + 2 * math.pi * k / number for k in range(number)]
    nodes = tuple((centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)) for angle in angles)
    return Outline(body, nodes, closed_line(nodes))


def in_space(body, centre, squares):
    """Of the squares on the surface of linear elements around `centre`, four places each: the diagonal leads from the
    first to the last one."""
    numbers, facets = {}, []
    for square in squares:
        a, b, c, d = (numbers.setdefault(place, len(numbers)) for place in square)
        outwards = determinant([[x - y for x, y in zip(place, centre)] for place in (square[0], square[1], square[3])]) > 0
        facets += [(a, b, d), (a, d, c)] if outwards else [(b, a, d), (d, a, c)]
    return Outline(body, tuple(numbers), tuple(facets))


def of_box_in_space(body, lower, upper, cells, position=lambda *place: place):
    """Of a box of linear elements whose corners rest at `position`, a function of where the box has them."""
    lines, squares = planes(lower, upper, cells), []
    for axis in range(3):
        one, other = (a for a in range(3) if a != axis)
        for end, i, j in itertools.product((0, -1), range(cells[one]), range(cells[other])):
            square = []
            for step_other, step_one in itertools.product((0, 1), repeat=2):
                place = [0.0] * 3
                place[axis], place[one], place[other] = lines[axis][end], lines[one][i + step_one], lines[other][j + step_other]
                square.append(tuple(position(*place)))
            squares.append(square)
    return in_space(body, position(*((a + b) / 2 for a, b in zip(lower, upper))), squares)
