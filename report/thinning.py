# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which rows of a long table a plot draws: few enough for a small page, with every extreme that the eye would see."""
import numpy

MOST_ROWS = 1000  # of a plot: more than it has pixels across
MOST_NUMBERS = 50_000  # of a page


def rows_to_draw(values, most=MOST_ROWS):
    """Indices of rows of `values` (rows, curves), in order: all, or the first, the last, and of every interval between
    equally many rows those in which a curve is least and largest."""
    n_rows, n_curves = values.shape
    if n_rows <= most:
        return numpy.arange(n_rows)
    n_intervals = max(2, most // (2 * n_curves))
    kept = {0, n_rows - 1}
    for begin, end in zip(*(lambda edges: (edges[:-1], edges[1:]))(numpy.linspace(0, n_rows, n_intervals + 1).astype(int))):
        part = values[begin:end]
        kept.update(begin + part.argmin(axis=0))
        kept.update(begin + part.argmax(axis=0))
    return numpy.array(sorted(kept))


def most_rows(n_columns):
    """Of each plot, so that a page with so many columns stays small."""
    return max(150, min(MOST_ROWS, MOST_NUMBERS // max(1, n_columns)))
