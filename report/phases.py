# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where the seconds of a run went: the tree in its file `timing`."""
from dataclasses import dataclass, field

from study import columns


@dataclass
class Phase:
    """`seconds` with those of the phases inside; `share` of the whole run's."""
    name: str
    seconds: float
    share: float = 0.0
    inner: list = field(default_factory=list)

    def rest(self):
        """Seconds that no inner phase accounts for."""
        return self.seconds - sum(each.seconds for each in self.inner)


def tree(path):
    """The outermost phases; none without the file."""
    top, found = [], {}
    for name, seconds in columns.phases(path).items():
        above, _, own = name.rpartition(" / ")
        found[name] = Phase(own, seconds)
        (found[above].inner if above in found else top).append(found[name])
    whole = sum(phase.seconds for phase in top)
    for phase in found.values():
        phase.share = phase.seconds / whole if whole > 0 else 0.0
    return top
