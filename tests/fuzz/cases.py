# SPDX-License-Identifier: LGPL-2.1-or-later
"""Case k of a seed of random numbers: always the same, whoever asks."""
import random

import command_mutations
import equivalents
import file_mutations
import mild_mutations
import scene_mutations

EQUIVALENT = 0.08  # share of cases with nothing but edits that change nothing
MILD = 0.35  # share of those with nothing but mutations that leave most scenes valid
MALFORMED = 0.2  # share of cases that start from a malformed scene
LAST = "scene is something else"  # afterwards there may be no scene to be mutated


class Cases:
    def __init__(self, all_seeds, key_types, seed):
        self.good = [one for one in all_seeds if "/malformed/" not in one.seed]
        self.bad = [one for one in all_seeds if "/malformed/" in one.seed]
        self.key_types = key_types
        self.seed = seed
        self.stock = scene_mutations.make_stock(self.good, key_types)
        self.mild_stock = mild_mutations.make_stock(self.good, key_types)
        self.mutations = {**scene_mutations.MUTATIONS, **file_mutations.MUTATIONS, **command_mutations.MUTATIONS}

    def make(self, number):
        rng = random.Random(f"{self.seed}/{number}")
        kind = rng.random()
        equivalent, mild = kind < EQUIVALENT, kind < EQUIVALENT + MILD
        bad = self.bad and not mild and rng.random() < MALFORMED
        case = rng.choice(self.bad if bad else self.good).copy()
        case.equivalent = equivalent
        if equivalent:
            names = rng.sample(sorted(equivalents.EDITS), rng.choice((1, 2, 3)))
            for name in sorted(names, key=lambda name: name == equivalents.LAST):
                equivalents.EDITS[name](rng, case, self.key_types)
                case.mutations.append(name)
        elif mild:
            for name in self.some(rng, mild_mutations.MUTATIONS, (1, 1, 2, 3)):
                self.mutate_lines(rng, case, name, mild_mutations.MUTATIONS[name][0], self.mild_stock)
        else:
            names = self.some(rng, self.mutations, (1, 1, 1, 2, 2, 3, 5))
            for name in [name for name in names if name != LAST] + [LAST] * (LAST in names):
                self.mutate(rng, case, name)
        case.assignments = [text.replace("\x00", "") for text in case.assignments]
        return case

    def some(self, rng, mutations, numbers):
        return rng.choices(list(mutations), [weight for _, weight in mutations.values()], k=rng.choice(numbers))

    def mutate(self, rng, case, name):
        function, _ = self.mutations[name]
        if name in scene_mutations.MUTATIONS:
            self.mutate_lines(rng, case, name, function, self.stock)
            return
        case.mutations.append(name)
        if name in file_mutations.MUTATIONS:
            function(rng, case)
        else:
            function(rng, case, self.stock)

    def mutate_lines(self, rng, case, name, function, stock):
        case.mutations.append(name)
        file = file_mutations.text_file(rng, case)
        lines = case.text(file).split("\n")
        try:
            function(rng, lines, stock)
        except (IndexError, StopIteration):  # the file has nothing of what is mutated
            scene_mutations.nonsense(rng, lines, self.stock)
        case.set_text(file, "\n".join(lines))
