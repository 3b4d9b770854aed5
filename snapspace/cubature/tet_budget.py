"""TetBudget: how many tets a cubature takes, and how much work goes into their choice."""

from __future__ import annotations

from dataclasses import dataclass, replace

from .nonnegative_fit import BATCH, MISSING
from .tets_by_force import PILOTS

#: Tets per dimension by default. On the Dragon, d = 120, solutions are then as far from the full
#: ones as those of the exact energy.
TETS_PER_DIMENSION = 8
#: The same for blends.
TETS_PER_BLENDED_DIMENSION = 15
#: But no more than this: an evaluation takes time in proportion.
MOST_TETS = 1000
#: Rows of forces per wanted tet.
ROWS = 3
#: Snapshots that are held out at the most.
HELD_OUT = 20
#: Motions that are trained on at the most, and candidates per wanted tet. Errors on Dragon, Spot,
#: Elephant, Armadillo, dog head and hand are those of 200 motions and twice as many candidates,
#: which take twice as long.
TRAINED, CANDIDATES = 60, 10
#: The same for blends. Errors of Lion, Dog, Centaur, ten Lions, 11 and 20 poses are the same with
#: 20 blends and with 200, which take four times as long; half as many candidates leave the Lion a
#: third more.
TRAINED_BLENDS, BLEND_CANDIDATES = 40, 20
#: One snapshot in so many is held out, which takes as many at least.
FEWEST_SNAPSHOTS = 10
#: Fewest blends that a cubature is trained on: one, and one to judge by.
FEWEST_BLENDS = 2
#: Of a quick one: states, pilots, candidates and rows per wanted tet, share of the tets that joins
#: at a time, and that may be missing. On the Dragon and the creature it takes half the time, and
#: errors grow by a twentieth.
QUICK_TRAINED, QUICK_PILOTS, QUICK_CANDIDATES, QUICK_ROWS = 24, 6, 6, 2
QUICK_BATCH, QUICK_MISSING = 0.25, 0.25


def default_tets(dimension: int) -> int:
    """How many tets a cubature has by default: 8 d, but at most 1000, where the mesh has them."""
    return min(TETS_PER_DIMENSION * dimension, MOST_TETS)


def default_blended_tets(dimension: int) -> int:
    """How many tets a blended cubature has by default: 15 d, but at most 1000.

    Nothing holds blends as handles do, and they take more than posing. On Lion, Dog and Centaur
    (d = 30, 20 and 50) errors are those of twice as many tets; with 10 d the Dog's and the Lion's
    are larger by half.
    """
    return min(TETS_PER_BLENDED_DIMENSION * dimension, MOST_TETS)


@dataclass(frozen=True, kw_only=True)
class TetBudget:
    """How many tets the user wants, or else are usual, and what they are chosen from.

    fewest_states : that a cubature needs
    most_trained : states
    candidates : tets for each wanted one
    rows : of forces, for each wanted tet
    batch : share of the wanted tets that joins before weights are found anew
    missing : share of them that may be missing
    pilots : states whose forces say which tets are candidates
    """

    wanted: int | None
    usual: int
    fewest_states: int
    most_trained: int
    candidates: int
    rows: int = ROWS
    batch: float = BATCH
    missing: float = MISSING
    pilots: int = PILOTS

    @property
    def quick(self) -> TetBudget:
        """With less work."""
        return replace(
            self,
            most_trained=QUICK_TRAINED,
            candidates=QUICK_CANDIDATES,
            rows=QUICK_ROWS,
            batch=QUICK_BATCH,
            missing=QUICK_MISSING,
            pilots=QUICK_PILOTS,
        )

    def count(self, available: int) -> int:
        """How many tets of a mesh with so many; ValueError if the user wants more, or none."""
        count = min(self.usual, available) if self.wanted is None else self.wanted
        if not 1 <= count <= available:
            raise ValueError(
                f"reduce: tets is {count}, but must be between 1 and the mesh's {available}"
            )
        return count
