"""ModelMaker: makes the models of a search."""

from __future__ import annotations

from ..interruptible import begin_abandonable
from ..mesh import EmbeddedSurface
from ..problem import InterpolationProblem, PosingProblem
from ..reduction import InterpolationModel, PosingModel, reduce
from ..snapshots import Snapshots
from ..subspace import AffineSubspace
from .early_parts import make_early_parts
from .largest_pca import largest_pca
from .search_options import Begins

Model = PosingModel | InterpolationModel


class ModelMaker:
    """Makes models of one problem.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
    surface, threads : as for `reduce`
    begins : callable
        Gets "subspace" or "energy", see `Begins`.
    """

    def __init__(
        self,
        problem: PosingProblem | InterpolationProblem,
        *,
        surface: EmbeddedSurface | None,
        threads: int | None,
        begins: Begins,
    ) -> None:
        self._problem, self._surface = problem, surface
        self._threads, self._begins = threads, begins
        self._finish_parts = begin_abandonable(lambda: make_early_parts(problem))

    def of_snapshots(
        self,
        snapshots: Snapshots,
        dimension: int,
        trained: Snapshots | None = None,
        *,
        tets: int | None = None,
        stiffness_from: Model | None = None,
    ) -> Model:
        """A model of at most a dimension; `trained` are the samples that train it, default all."""
        self._begins("subspace")
        self._finish_parts()
        basis = largest_pca(snapshots, dimension, threads=self._threads)
        return self.of_basis(basis, trained or snapshots, tets=tets, stiffness_from=stiffness_from)

    def of_basis(
        self,
        basis: AffineSubspace,
        trained: Snapshots,
        *,
        tets: int | None = None,
        stiffness_from: Model | None = None,
    ) -> Model:
        """A model in a subspace.

        stiffness_from : as for `reduce`; no effect if it has no cubature, or is a blend
        """
        self._begins("energy")
        known = stiffness_from if isinstance(stiffness_from, PosingModel) else None
        return reduce(
            self._problem,
            basis,
            snapshots=trained,
            tets=tets,
            stiffness_from=known if known and known.cubature else None,
            surface=self._surface,
            threads=self._threads,
        )
