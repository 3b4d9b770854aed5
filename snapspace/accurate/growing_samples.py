"""GrowingSamples: samples that are solved in stages, some held out."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..displacements import SnapshotGram
from ..greedy import batch_checkpoint
from ..interruptible import begin_abandonable
from ..problem import InterpolationProblem, PosingProblem, solutions_beyond_tau
from ..reduction import InterpolationModel, PosingModel, fewest_snapshots, reduced_solutions
from ..sampling import Method, sample
from ..session import predicted_solutions
from ..snapshots import Snapshots, solve_snapshots, unsolved_snapshots
from ..subspace import AffineSubspace
from .solving import Solving

FloatArray = NDArray[np.float64]
Model = PosingModel | InterpolationModel

#: Held-out samples nearer to tau than this share of the median distance do not judge models.
_NEAR = 0.05


class GrowingSamples:
    """Samples of one sequence, solved in stages; the held-out ones stay the same.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
    most : int
        Length of the sequence.
    method, seed : as for `sample`
    first, held_out : int
        The `first` samples train, the next `held_out` are held out, and all others train again.
    pilot : int, default 0
        Number of the first training samples that are solved before others are predicted.
    slow : float, default 0
        Others are predicted only if the pilot takes more evaluations per sample than this.
    judges_too : bool, default False
        Whether held-out samples are predicted as well. Where there may be several minima, held-out
        samples must not depend on a model. Where there is only one, a model's Hessians lead closer
        to it.
    judging_seed : int, optional
        Seed of the held-out samples. Default: they are a part of the sequence.
    """

    def __init__(
        self,
        problem: PosingProblem | InterpolationProblem,
        most: int,
        *,
        method: Method,
        seed: int,
        first: int,
        held_out: int,
        pilot: int = 0,
        slow: float = 0.0,
        judges_too: bool = False,
        judging_seed: int | None = None,
    ) -> None:
        self.problem = problem
        # SciPy's module of Sobol points takes a second to import; meanwhile the problem is prepared
        self._judges = range(first, first + held_out)

        def sampled() -> FloatArray:
            parameters = sample(problem.domain, most, method=method, seed=seed)
            if judging_seed is not None:
                judging = sample(problem.domain, held_out, method=method, seed=judging_seed)
                parameters[self._judges.start : self._judges.stop] = judging
            return parameters

        self._sampled = begin_abandonable(sampled)
        self._slow, self._judges_too = slow, judges_too
        self._pilot = pilot if pilot <= first else pilot + held_out  # where its samples end
        self._snapshots: Snapshots | None = None
        self._first_known: Snapshots | None = None  # where the first solves start
        self._given: Snapshots | None = None  # shapes that count for a basis
        self._gram = SnapshotGram.of(problem)
        self.seconds_a_sample = 0.0  # of the last ones

    @cached_property
    def parameters(self) -> FloatArray:
        """Parameters of the whole sequence, (most, p)."""
        _ = self.problem.system, self.problem.tau  # what every solve needs, beside the sampling
        return self._sampled()

    @property
    def training_parameters(self) -> FloatArray:
        """Parameters of the sequence without those of the held-out samples."""
        return np.delete(self.parameters, self._judges, axis=0)

    @property
    def are_predicted(self) -> bool:
        """Whether a model of the pilot predicts others: the pilot has been solved, and was slow."""
        if not self._pilot or self._snapshots is None or len(self._snapshots) < self._pilot:
            return False
        evaluations = np.array([report.evaluations for report in self._snapshots.reports])
        return float(evaluations[: self._pilot][~self.held_out[: self._pilot]].mean()) > self._slow

    @property
    def snapshots(self) -> Snapshots:
        """All samples that are solved; there must be some."""
        assert self._snapshots is not None
        return self._snapshots

    @property
    def held_out(self) -> NDArray[np.bool_]:
        """Which samples are held out, (k,)."""
        judges = np.zeros(len(self.snapshots), bool)
        judges[self._judges.start : self._judges.stop] = True
        return judges

    @property
    def solved(self) -> Snapshots | None:
        """The usable samples that are not held out, as `trained`; None if there are none."""
        if self._snapshots is None or not (which := self._snapshots.usable & ~self.held_out).any():
            return None
        return replace(self._snapshots.select(which), gram=self._gram.select(which))

    @property
    def trained(self) -> Snapshots:
        """The usable samples that are not held out, with their Gram matrix."""
        which = self._training()
        solved = self.snapshots.select(which)
        if self._given is not None:
            return solved.joined(self._given)
        return replace(solved, gram=self._gram.select(which))

    @property
    def unseen(self) -> Snapshots:
        """The usable samples that are held out."""
        return self.snapshots.select(self._judging())

    @property
    def trained_solutions(self) -> int:
        """Number of solutions that a basis comes from, including those known without solving."""
        given = 0 if self._given is None else len(self._given)
        return int(self._training().sum()) + len(self._known()) + given

    def begin_with(self, given: Snapshots, near: Snapshots) -> None:
        """Adds shapes that count for a basis, and others near which the first solves start.

        Shapes at the parameters of held-out samples, such as the first Sobol point of fewer
        handles, are left out: a model must not be trained there.
        """
        self._given = given.select(self.unjudged(given.parameters))
        self._first_known = near

    def unjudged(self, parameters: FloatArray) -> NDArray[np.bool_]:
        """Which parameters are not those of held-out samples, (k,)."""
        judges = {w.tobytes() for w in self.parameters[self._judges.start : self._judges.stop]}
        return np.array([w.tobytes() not in judges for w in parameters], bool)

    def begin_near(self, model: PosingModel, count: int) -> Snapshots:
        """Adds a model's solutions for the first training samples; solves start near them."""
        parameters = self.training_parameters[:count]
        solved = reduced_solutions(model, parameters)
        self._first_known = unsolved_snapshots(self.problem, parameters, solved)
        return self._first_known

    def solve_loosely(self, count: int, solving: Solving, *, known: Snapshots | None) -> Snapshots:
        """Solves the first samples loosely for a preliminary model; later solves start from them.

        known : where these solves start, as for `solve_snapshots`
        """
        loose = solve_snapshots(
            self.problem,
            self.parameters[:count],
            options=solving.loose(self.problem),
            threads=solving.threads,
            progress=solving.progress,
            executor=solving.executor,
            known=known,
        )
        self._first_known = loose if known is None else loose.joined(known)
        return loose

    def solve_up_to(
        self, count: int, solving: Solving, *, predict: Callable[[], Model | None]
    ) -> None:
        """Solves the samples before `count` that are not solved yet.

        predict : returns the model that predicts the next samples, see `predicted_solutions`
        """
        for end in sorted((self._pilot, self._judges.start, self._judges.stop, count)):
            before = 0 if self._snapshots is None else len(self._snapshots)
            if end <= before or end > count:
                continue
            wanted = self.parameters[before:end]
            judging, predicted = before in self._judges, self.are_predicted
            chosen = solving.chosen(self.problem, judging=judging, predicted=predicted)
            independent = predicted and judging and not self._judges_too
            model = None if independent else predict()
            begin, start = time.perf_counter(), None
            if model is not None:
                hessians = None if predicted else False
                start = predicted_solutions(model, wanted, hessians=hessians)
            solved = solve_snapshots(
                self.problem,
                wanted,
                options=chosen,
                threads=solving.threads,
                progress=solving.counting(before, count),
                checkpoint=batch_checkpoint(
                    solving.checkpoint, before, self.problem, wanted, chosen
                ),
                executor=solving.executor,
                known=self._known_before(end),
                predictions=start,
            )
            if not judging or not self.seconds_a_sample:  # held-out samples take longer
                self.seconds_a_sample = (time.perf_counter() - begin) / len(wanted)
            self._snapshots = solved if before == 0 else self.snapshots.joined(solved)
            self._gram.add(list(solved.displacements), threads=solving.threads or 0)

    def _known_before(self, end: int) -> Snapshots | None:
        """Where solves of the samples before `end` start."""
        near, solved = self._first_known, self._snapshots
        if solved is None:
            return near
        if near is None:
            return solved
        return solved.joined(near) if end <= self._judges.start else solved

    def projection_errors(self) -> FloatArray:
        """Errors of projections onto bases of the others, see `SnapshotGram.held_out_errors`."""
        gram, trained, unseen = self._gram.copy(), self._training(), self._judging()
        gram.add(list(self._known()))
        if self._given is not None:
            gram.add(list(self._given.displacements))
        known = np.arange(len(trained), len(gram))
        return gram.held_out_errors(
            np.append(np.flatnonzero(trained), known), np.flatnonzero(unseen)
        )

    def projection_errors_onto(self, subspace: AffineSubspace) -> FloatArray:
        """Errors of projections of the held-out samples onto another basis, (k,)."""
        squares = np.diag(self._gram.matrix)[self._judging()]
        rows = self.unseen.displacements.shifted(self.problem.base - subspace.tau)
        held = (subspace.row_coordinates(rows) ** 2).sum(axis=1)
        errors: FloatArray = np.sqrt(np.maximum(squares - held, 0.0) / squares)
        return errors

    def _known(self) -> FloatArray:
        """Displacements (k, 3n) of the solutions that are known without solving, except tau."""
        shapes: FloatArray = solutions_beyond_tau(self.problem)[1] - self.problem.base
        return shapes

    def _training(self) -> NDArray[np.bool_]:
        """Mask (k,) of the usable samples that train; none are needed beside given shapes."""
        fewest = max(fewest_snapshots(self.problem, 1), 1) if self._given is None else 0
        return self._usable(~self.held_out, fewest)

    def _judging(self) -> NDArray[np.bool_]:
        """Mask (k,) of the usable samples that are held out, without those next to tau.

        Errors are relative to the distance from tau. For two poses, one sample is close to the mean
        shape: it looks right, but its relative error may be 40 %, which would dominate the mean.
        """
        judging = self._usable(self.held_out, fewest=1)
        distances = np.sqrt(np.diag(self._gram.matrix)[: len(judging)])
        near: NDArray[np.bool_] = distances < _NEAR * np.median(distances[judging])
        return judging & ~near

    def _usable(self, which: NDArray[np.bool_], fewest: int) -> NDArray[np.bool_]:
        usable = self.snapshots.usable & which
        if usable.sum() < fewest:
            failed = {r.status for r, w in zip(self.snapshots.reports, which, strict=True) if w}
            cure = "allow more iterations, or make the motions smaller"
            if "max_iterations" not in failed:
                cure = "make the motions smaller, since their energies are too large for the solver"
            raise ValueError(
                f"accurate_model: {int(usable.sum())} of {int(which.sum())} samples converged, but "
                f"at least {fewest} are needed; {cure}"
            )
        return usable
