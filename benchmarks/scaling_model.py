# SPDX-License-Identifier: LGPL-2.1-or-later
"""Seconds over ranks as T(P) = a + b / P + c log2 P with a, b, c not negative: what stays, what is shared out, and what grows
as sums over ranks do."""
import itertools
import math

FAR = 10000  # ranks
LEAST_RANKS = 3  # as many as there are coefficients


def terms(ranks):
    return 1.0, 1.0 / ranks, math.log2(ranks)


def seconds(model, ranks):
    return sum(coefficient * term for coefficient, term in zip(model, terms(ranks)))


def solution(matrix, right):
    """Of a small symmetric system; None if it is singular."""
    n = len(right)
    rows = [[*line, value] for line, value in zip(matrix, right)]
    for column in range(n):
        pivot = max(range(column, n), key=lambda k: abs(rows[k][column]))
        if abs(rows[pivot][column]) < 1e-13 * max(map(abs, itertools.chain(*matrix))):
            return None
        rows[column], rows[pivot] = rows[pivot], rows[column]
        for k in range(n):
            if k != column:
                factor = rows[k][column] / rows[column][column]
                rows[k] = [own - factor * other for own, other in zip(rows[k], rows[column])]
    return [rows[k][n] / rows[k][k] for k in range(n)]


def fit(points, least):
    """[a, b, c] for [(ranks, seconds)]: least squares of relative errors, of times above `least` [s]. Of all choices of terms
    that get no negative coefficient, the one of the least squares is the solution with that condition."""
    weights = [1 / max(value, least) for _, value in points]
    lines = [[weight * term for term in terms(ranks)] for weight, (ranks, _) in zip(weights, points)]
    wanted = [weight * value for weight, (_, value) in zip(weights, points)]
    best, least_squares = [0.0] * 3, sum(value**2 for value in wanted)
    for count in (1, 2, 3):
        for chosen in itertools.combinations(range(3), count):
            found = solution([[sum(line[i] * line[j] for line in lines) for j in chosen] for i in chosen],
                             [sum(line[i] * value for line, value in zip(lines, wanted)) for i in chosen])
            if found is None or min(found) < 0:
                continue
            model = [0.0] * 3
            for place, value in zip(chosen, found):
                model[place] = value
            squares = sum((sum(m * entry for m, entry in zip(model, line)) - value)**2 for line, value in zip(lines, wanted))
            if squares < least_squares - 1e-15:
                best, least_squares = model, squares
    return best


def models(measured):
    """{part: [a, b, c]} of {ranks: {part: seconds}}."""
    steps = {ranks: sum(each.values()) for ranks, each in measured.items()}
    names = dict.fromkeys(name for each in measured.values() for name in each)
    return {name: fit([(ranks, each.get(name, 0.0)) for ranks, each in sorted(measured.items())], 1e-3 * max(steps.values()))
            for name in names}
