"""Snapshots: full-space solutions of sampled parameters."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import require_type, wrong_type
from ..displacements import DisplacementRows, SnapshotGram, chosen_rows
from ..mesh import TetMesh, shape_rows
from ..problem import PosingProblem, Problem, require_problem
from ..thread_count import checked_threads

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class SampleReport:
    """How the full-space solve of one sample ended.

    status is one of converged, max_iterations, line_search_failed, not_finite; value is the
    objective F at the shape, gradient_norm the Euclidean norm of its gradient, decrement twice the
    decrease that the solver's model still predicted, seconds the wall time, inverted_tets the
    number of tets with det F <= 0.

    The status "carried" marks a shape that was not solved for these parameters, see `carry_over`.
    Then all numbers are zero.
    """

    status: str
    iterations: int
    evaluations: int
    value: float
    gradient_norm: float
    decrement: float
    seconds: float
    inverted_tets: int

    @property
    def converged(self) -> bool:
        """Whether the solver's test was met."""
        return self.status == "converged"

    @property
    def carried(self) -> bool:
        """Whether the shape is a solution of a problem with other handles."""
        return self.status == "carried"


@dataclass(frozen=True, eq=False)
class Snapshots:
    """Solutions of a problem at sampled parameters, or shapes that are as good for a basis.

    problem : Problem
    parameters : (k, p), one sample per row
    displacements : DisplacementRows (k, 3n) from problem.base, in memory or mapped from files
    reports : one SampleReport per sample
    gram : SnapshotGram of the displacements, if it is known, as after a run with `progress`. It
        saves most of the work of `snapshot_pca`

    Raises ValueError unless there is a row of problem.base's size and a report for each sample.
    """

    problem: Problem
    parameters: FloatArray
    displacements: DisplacementRows
    reports: Sequence[SampleReport]
    gram: SnapshotGram | None = None

    def __post_init__(self) -> None:
        require_problem(self.problem, "Snapshots")
        if not isinstance(self.displacements, DisplacementRows):
            raise ValueError(
                f"Snapshots: displacements are a {type(self.displacements).__name__}, but must be "
                "DisplacementRows; Snapshots.from_shapes takes an array of shapes (k, 3n)"
            )
        if self.displacements.size != self.problem.base.size:
            raise ValueError(
                f"Snapshots: displacements have {self.displacements.size} coordinates, but the "
                f"problem's shapes have {self.problem.base.size}"
            )
        cure = "give an array (k, p), one row per sample"
        require_type("Snapshots", "parameters", self.parameters, np.ndarray, cure)
        require_type("Snapshots", "reports", self.reports, Sequence, "give a list of SampleReport")
        require_type("Snapshots", "gram", self.gram, SnapshotGram | None, "leave it out")
        counts = len(self.parameters), len(self.displacements), len(self.reports)
        if len(set(counts)) > 1:
            raise ValueError(
                f"Snapshots: got {counts[0]} parameter vectors, {counts[1]} displacements and "
                f"{counts[2]} reports, but each sample needs one of each"
            )

    @classmethod
    def from_shapes(
        cls,
        problem: Problem,
        parameters: FloatArray,
        shapes: ArrayLike,
        reports: Sequence[SampleReport],
    ) -> Snapshots:
        """Makes snapshots in memory from an array of shapes (k, 3n), one per row.

        Raises ValueError for shapes in another layout, and as `Snapshots`.
        """
        require_problem(problem, "Snapshots.from_shapes")
        size = problem.base.size
        rows = shape_rows(shapes, size, who="Snapshots.from_shapes")
        displacements = np.subtract(rows, problem.base, order="C")
        return cls(problem, parameters, DisplacementRows(displacements, size), reports)

    def __len__(self) -> int:
        return len(self.reports)

    def __repr__(self) -> str:
        useless = len(self) - int(self.usable.sum())
        note = f", {useless} of them not converged" if useless else ""
        return f"Snapshots({len(self)} samples{note}, {self.problem!r})"

    @property
    def shapes(self) -> FloatArray:
        """All shapes, (k, 3n), one per row, positions x0 y0 z0 x1 ...

        Each call makes a new array of 24 k n bytes. `displacements` gives single rows, or blocks of
        columns, without this memory.
        """
        shapes = self.displacements.array()
        shapes += self.problem.base
        return shapes

    @property
    def converged(self) -> NDArray[np.bool_]:
        """Mask (k,) of the samples that met the solver's test."""
        return np.array([report.converged for report in self.reports], dtype=bool)

    @property
    def usable(self) -> NDArray[np.bool_]:
        """Mask (k,) of the samples for a basis and for starts: converged and carried ones."""
        return np.array([r.converged or r.carried for r in self.reports], dtype=bool)

    def with_gram(self, *, threads: int | None = None) -> Snapshots:
        """The same with `gram`, which is computed if it is not known; `threads`: default all."""
        if self.gram is not None:
            return self
        gram = SnapshotGram.of(self.problem)
        gram.add(self.displacements, threads=checked_threads(threads, "Snapshots.with_gram"))
        return replace(self, gram=gram)

    def select(self, which: ArrayLike) -> Snapshots:
        """Some of the samples; displacements are shared, not copied, and `gram` is left out.

        Parameters
        ----------
        which : array_like
            A boolean mask (k,), or numbers of samples (c,) in the wanted order.

        Raises
        ------
        ValueError
            For a mask of another length, a number that is not between 0 and k - 1, or any other
            type.

        Examples
        --------
        >>> snapshots.select(snapshots.converged)
        >>> snapshots.select([0, 1, 2])
        """
        chosen = chosen_rows(which, len(self), who="Snapshots.select")
        reports = [self.reports[sample] for sample in chosen]
        rows = self.displacements.select(chosen)
        return Snapshots(self.problem, self.parameters[chosen], rows, reports)

    def joined(self, others: Snapshots) -> Snapshots:
        """These samples, followed by those of another run.

        Raises
        ------
        ValueError
            If the others are not snapshots, or of another problem.
        """
        check_snapshots(others, "Snapshots.joined", "others")
        if others.problem.fingerprint != self.problem.fingerprint:
            raise ValueError(
                f"Snapshots.joined: the others are of another problem, {others.problem!r} instead "
                f"of {self.problem!r}; `carry_over` brings them to the handles of this one"
            )
        return Snapshots(
            self.problem,
            np.vstack([self.parameters, others.parameters]),
            self.displacements.followed_by(others.displacements),
            [*self.reports, *others.reports],
        )

    def summary(self) -> str:
        """One line: how many converged, the status of others, iterations, inverted tets of solids.

        Carried samples are listed separately: they do not count for convergence and iterations.
        """
        solved = [report for report in self.reports if not report.carried]
        good = int(self.converged.sum())
        parts = [f"{good} of {len(solved)} samples converged"] if solved else []
        for status in sorted({r.status for r in self.reports if not r.converged}):
            parts.append(f"{sum(r.status == status for r in self.reports)} {status}")
        if solved:
            parts.append(f"{np.mean([r.iterations for r in solved]):.0f} iterations on average")
        if isinstance(self.problem.mesh, TetMesh):
            parts.append(f"at most {max(r.inverted_tets for r in self.reports)} inverted tets")
        return ", ".join(parts)


def check_snapshots(snapshots: object, who: str, name: str = "snapshots") -> None:
    """Raises a ValueError in the name of `who` for anything but snapshots, such as a file."""
    if not isinstance(snapshots, Snapshots):
        raise wrong_type(who, name, snapshots, "give those of solve_snapshots or load_snapshots")


def check_snapshots_of(problem: Problem, snapshots: Snapshots, who: str, name: str) -> None:
    """The same, and for snapshots of another problem."""
    check_snapshots(snapshots, who, name)
    if snapshots.problem.fingerprint != problem.fingerprint:
        cure = "solve samples of this one"
        if isinstance(problem, PosingProblem):
            cure = "`carry_over` makes them snapshots of this one"
        raise ValueError(f"{who}: the snapshots are of another problem; {cure}")
