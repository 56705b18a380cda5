# SPDX-License-Identifier: LGPL-2.1-or-later
"""The cases of a study: which values of its variations meet."""
import itertools
from dataclasses import dataclass

AS_IS = "as is"  # a value of a variation that leaves its key to the other ones
RANKS, QUANTITIES = "Ranks", "Quantities/"  # keys of the study itself, which may be varied, too


@dataclass(frozen=True)
class Case:
    """One run: the position of its value in each variation."""
    index: tuple

    def settings(self, study):
        """{"Section/Key": value}; an empty value: the scene has no such key. Later variations override earlier ones."""
        result = dict(study.settings)
        for variation, position in zip(study.variations, self.index):
            result.update({key: value for key, value in variation.settings[position].items() if value != AS_IS})
        return result

    def name(self, study):
        return ", ".join(f"{variation.name} {variation.names[position]}"
                         for variation, position in zip(study.variations, self.index))

    def with_value(self, axis, position):
        """The same case but for one variation."""
        return Case(self.index[:axis] + (position,) + self.index[axis + 1:])


def of_scene(settings):
    """Without the keys of the study itself."""
    return {key: value for key, value in settings.items() if key != RANKS and not key.startswith(QUANTITIES)}


def ranks(study, case):
    return int(case.settings(study).get(RANKS, study.ranks))


def make_cases(study):
    """All cases, coarse ones first."""
    sizes = [len(variation.names) for variation in study.variations]
    refinements = study.refinements()
    cases = []
    for index in itertools.product(*map(range, sizes)):
        refined = [axis for axis in refinements if index[axis] > 0]
        if study.combine == "all" or len(refined) <= 1:
            cases.append(Case(index))
    return sorted(cases, key=lambda case: (sum(case.index[axis] for axis in refinements), case.index))


def variant(study, case):
    """The positions of its values in the variations that are no refinements."""
    return tuple(position for variation, position in zip(study.variations, case.index)
                 if not variation.is_refinement())


def called(variation, position):
    """The name of a value; a number alone says nothing."""
    name = variation.names[position]
    return f"{variation.name} {name}" if name[:1].isdigit() else name


def variant_name(study, key):
    names = [called(variation, position) for variation, position in zip(
        (each for each in study.variations if not each.is_refinement()), key)]
    return ", ".join(names) or "the scene"
