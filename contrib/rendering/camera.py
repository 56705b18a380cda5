# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where a picture is looked at from: a plane from the front, space from a bit above, all of it in the picture."""
import math

DIRECTIONS = {"front": (0, 0, 1), "back": (0, 0, -1), "left": (-1, 0, 0), "right": (1, 0, 0),
              "top": (0, 1, 1e-3), "bottom": (0, -1, 1e-3), "oblique": (0.5, 0.42, 1)}
ANGLE = 22  # degrees, from the bottom of a picture to its top
FILLED = 0.95  # share of the picture
ROUNDS = 8  # of moving the camera until all is framed


def aim(camera, bounds, is_flat, options, aspect):
    """Fit the box into the middle of a view with this ratio of width to height."""
    view = options.camera or ("front" if is_flat else "oblique")
    direction = DIRECTIONS[view] if isinstance(view, str) else view
    length = math.sqrt(sum(d * d for d in direction))
    direction = [d / length for d in direction]
    centre = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 for axis in range(3)]
    size = sum(bounds[2 * axis + 1] - bounds[2 * axis] for axis in range(3))
    corners = [(bounds[i], bounds[2 + j], bounds[4 + k]) for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    camera.SetFocalPoint(centre)
    camera.SetPosition([c + 2 * size * d for c, d in zip(centre, direction)])
    camera.SetViewUp(*((0, 1, 0) if abs(direction[1]) < 0.999999 else (0, 0, -direction[1])))
    camera.OrthogonalizeViewUp()
    if is_flat:
        half = [max(abs(place[axis]) for place in seen(camera, corners)) for axis in (0, 1)]
        camera.ParallelProjectionOn()
        camera.SetParallelScale(max(half[1], half[0] / aspect) / FILLED / options.zoom)
        return
    camera.SetViewAngle(ANGLE)
    slope = math.tan(math.radians(ANGLE / 2)) * FILLED
    for _ in range(ROUNDS):
        step_towards(camera, seen(camera, corners), slope, aspect)
    camera.Zoom(options.zoom)


def seen(camera, corners):
    """Places to the right, upwards and towards the camera, from the camera."""
    transform = camera.GetViewTransformMatrix()
    return [transform.MultiplyPoint((*corner, 1))[:3] for corner in corners]


def step_towards(camera, places, slope, aspect):
    """Move the camera sideways so that the box is in the middle, and away from it until it fits."""
    right, up, near = zip(*places)
    ratios = [([r / -n for r, n in zip(right, near)], slope * aspect), ([u / -n for u, n in zip(up, near)], slope)]
    depth = sum(-n for n in near) / len(near)
    shift = [(max(share) + min(share)) / 2 * depth for share, _ in ratios]
    back = max((max(share) - min(share)) / 2 / limit for share, limit in ratios)
    matrix = camera.GetViewTransformMatrix()
    rows = [[matrix.GetElement(row, column) for column in range(3)] for row in range(3)]
    away = depth * (back - 1)
    move = [shift[0] * rows[0][k] + shift[1] * rows[1][k] for k in range(3)]
    camera.SetFocalPoint([c + m for c, m in zip(camera.GetFocalPoint(), move)])
    camera.SetPosition([c + m + away * rows[2][k] for k, (c, m) in enumerate(zip(camera.GetPosition(), move))])
