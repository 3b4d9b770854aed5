"""EnergyChoice: requirements of the reduced energy, checked before samples are solved."""

from __future__ import annotations

from dataclasses import dataclass

from ..cubature import element_count
from ..problem import InterpolationProblem, PosingProblem
from ..reduction import Energy, chosen_energy, fewest_snapshots, training_tolerance


@dataclass(frozen=True, kw_only=True)
class EnergyChoice:
    """The energy that the user wants.

    energy, tets : as for `reduce`
    dimension : dimension of the subspace; None if an energy fraction decides
    """

    energy: Energy = "auto"
    tets: int | None = None
    dimension: int | None = None

    def check(self, problem: PosingProblem | InterpolationProblem, samples: int) -> None:
        """Raises the ValueErrors that `reduce` would raise after the samples are solved."""
        # a subspace has at most as many dimensions as there are samples
        dimensions = (1, samples) if self.dimension is None else (self.dimension,)
        for dimension in dimensions:
            fewest = fewest_snapshots(problem, dimension, self.energy)
            if samples < fewest:
                raise ValueError(
                    f"the energy is a cubature, which needs at least {fewest} samples, but there "
                    f"are {samples}; raise --samples"
                )
        self._check_tets(problem)
        kinds = {chosen_energy(problem, d, self.energy) for d in dimensions}
        if self.tets is not None and kinds == {"exact"}:
            raise ValueError(
                "--tets is for a cubature, but the energy is exact; add --energy cubature"
            )

    def _check_tets(self, problem: PosingProblem | InterpolationProblem) -> None:
        most = element_count(problem)
        if self.tets is not None and self.tets > most:
            word = "--tets" if isinstance(problem, PosingProblem) else "--cubature-tets"
            raise ValueError(f"{word} is {self.tets}, but the mesh has only {most}; give fewer")

    def tolerance(self, problem: PosingProblem) -> float | None:
        """As `training_tolerance`; for an unknown dimension, that of the smallest dimension."""
        return training_tolerance(problem, self.dimension or 1, self.energy)
