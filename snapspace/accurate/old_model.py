"""OldModel: a model that is reused for other handles of the same mesh."""

from __future__ import annotations

import hashlib
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..interruptible import begin_abandonable
from ..problem import HandleBox, Handles, PosingProblem
from ..reduction import PosingModel, reduced_solutions, with_handles
from ..snapshots import (
    Predictions,
    Snapshots,
    SolverOptions,
    carry_over,
    lowest_start,
    solve_snapshots,
    unsolved_snapshots,
)
from ..subspace import AffineSubspace
from .largest_pca import widened_pca
from .plan import Plan
from .predicting import MOST_DIMENSIONS

FloatArray = NDArray[np.float64]

#: Tolerance of shapes near solutions. From a guess, it takes 12 to 27 evaluations and leaves errors
#: of 0.01; a full solve takes 60 to 100. A tolerance of 1e-4 takes half as many evaluations again.
#: More shapes of this tolerance are the better choice: in the same time, a Spot with a new tail has
#: an error of 0.017 instead of 0.020.
TOLERANCE = 1e-3
#: Limit on the iterations of each, however far off the guess is.
MOST_ITERATIONS = 100
#: Smallest number of shapes near solutions for each parameter, and their share of those of the old
#: model. With their parts they are as good as half as many again without
#: (docs/notes/other-handles.md).
SHAPES_A_PARAMETER, SHARE = 8, 0.5


class OldModel:
    """A model whose shapes, subspace and energy are reused for a problem with other handles.

    Parameters
    ----------
    model : PosingModel
        The model of the old handles.
    problem : PosingProblem
        The problem with the new handles.
    most : int
        How many shapes near solutions there are, and how many of the model's shapes are used: the
        first ones, since the first Sobol samples spread over the domain however many they are.
    """

    def __init__(self, model: PosingModel, problem: PosingProblem, *, most: int) -> None:
        self._model, self._problem, self.most = model, problem, most
        # with 209 dimensions the guesses of an Armadillo take three times as long, and its model is
        # no better
        self._guessing = model.leading(min(model.dimension, MOST_DIMENSIONS))
        places = problem.handles.places_in(model.problem.handles)
        kept = [h for h, place in enumerate(places) if place is not None]
        #: Indices of the problem's handles that the model has as well; the first one is fixed.
        self._kept = np.array(kept, np.intp)
        self._all_kept = len(kept) == len(model.problem.handles)
        #: Whether the model's frame and energy are the problem's.
        self._fits = places[0] == 0 and problem.material.key == model.problem.material.key

    @property
    def dimension(self) -> int:
        """Dimension of the old model."""
        return self._model.dimension

    @cached_property
    def shapes(self) -> Snapshots:
        """The shapes that the model was trained with, as snapshots of the problem.

        They are the projections of its samples: a saved model has nothing else.
        """
        model = self._model
        rows = model.subspace.shapes(model.training_coordinates[: self.most])
        parameters = model.training_parameters[: self.most]
        old = unsolved_snapshots(model.problem, parameters, rows - model.problem.base)
        return carry_over(old, self._problem)

    def near_solutions(self, parameters: FloatArray, threads: int | None) -> Snapshots:
        """Shapes near the solutions for the first `most` samples: solved loosely, from guesses."""
        problem, parameters = self._problem, parameters[: self.most]
        _ = problem.system  # before threads ask for it
        finish_modes = begin_abandonable(problem.solving.soft_modes)
        starts = self.guesses(parameters, threads=threads)
        finish_modes()
        loose = solve_snapshots(
            problem,
            parameters,
            options=SolverOptions(tolerance=TOLERANCE, max_iterations=MOST_ITERATIONS),
            threads=threads,
            predictions=Predictions(starts),
        )
        ends = np.array(list(loose.displacements))
        lost = ~np.isfinite(ends).all(axis=1)
        ends[lost] = starts[lost]
        return unsolved_snapshots(problem, parameters, ends)

    def widened(self, near: Snapshots, most: int, threads: int | None) -> AffineSubspace:
        """The subspace of shapes near solutions and the model's shapes, and of their parts.

        It has at most `most` dimensions, and at most one per shape near a solution more than the
        model.
        """
        shapes = near.joined(self.shapes)
        return widened_pca(shapes, min(most, self.dimension + len(near)), threads=threads)

    def guesses(self, parameters: FloatArray, *, threads: int | None) -> FloatArray:
        """Displacements (k, 3n) near the solutions for samples (k, p), without solving.

        There are two ways. The first solves in the subspace for the handles that both problems
        have, and then adds the difference of two linear responses, which moves the other handles to
        their targets. The second solves for all handles in the subspace, which can follow new ones
        only partly. The second is used if no handle is new, the first if none was removed, and
        otherwise the one with less energy. If another handle is fixed, or the material differs, the
        guess is the linear response to all handles.
        """
        problem, kept = self._problem, self._kept
        if not self._fits:
            return problem.guesses(parameters)
        everything = len(kept) == len(problem.handles)
        if self._all_kept and not everything:
            return self._solved_and_moved(parameters)
        within = reduced_solutions(self._with_handles(problem, slice(None)), parameters)
        if everything:
            return within
        some_kept = len(kept) > 1  # besides the fixed one
        beyond = self._solved_and_moved(parameters) if some_kept else problem.guesses(parameters)
        inputs = problem.inputs(parameters)
        return lowest_start(problem.system, inputs, [beyond, within], threads=threads or 0)

    def _solved_and_moved(self, parameters: FloatArray) -> FloatArray:
        """Reduced solutions for the kept handles, and the others moved by the linear response."""
        problem, every = self._problem, list(self._problem.handles)
        handles = [every[place] for place in self._kept]
        common = problem.with_handles(
            Handles([h.vertices for h in handles], names=[h.name for h in handles]),
            domain=HandleBox(translation=1.0, angle=1.0),  # nothing is sampled
        )
        columns = (6 * (self._kept[1:, None] - 1) + np.arange(6)).reshape(-1)
        wanted = np.ascontiguousarray(parameters[:, columns])
        solved = reduced_solutions(self._with_handles(common, columns), wanted)
        there = carry_over(unsolved_snapshots(common, wanted, solved), problem).parameters
        return solved + problem.guesses(parameters) - problem.guesses(there)

    def _with_handles(
        self, problem: PosingProblem, columns: NDArray[np.intp] | slice
    ) -> PosingModel:
        """The model's subspace and elastic energy with other handles.

        columns : which of the problem's parameters belong to these handles
        """
        return replace(
            with_handles(self._guessing, problem),
            training_coordinates=self._guessing.training_coordinates[: self.most],
            training_parameters=np.ascontiguousarray(self.shapes.parameters[:, columns]),
        )


def usual_shapes(model: PosingModel, problem: PosingProblem, plan: Plan, most: int) -> int:
    """Number of shapes near solutions for a first model.

    Eight for each parameter, and at least half as many as the old model has shapes, since some
    bodies need more than others, and as many as the first stage of a search. A search of at most
    `most` samples holds some of them out.
    """
    known = round(SHARE * len(model.training_parameters))
    wanted = max(SHAPES_A_PARAMETER * problem.parameter_count, known, plan.first)
    return min(wanted, most - plan.held_out)


def check_start(model: Any, problem: Any) -> None:
    """Raises ValueError unless `model` poses the problem's mesh and has training shapes."""
    for what, one, kind in (("start", model, PosingModel), ("the problem", problem, PosingProblem)):
        if not isinstance(one, kind):
            raise ValueError(
                f"accurate_model: {what} is of type {type(one).__name__}, but only handles of a "
                f"posing model can change; give a {kind.__name__}, or leave out start"
            )
    if model.problem.mesh.fingerprint != problem.mesh.fingerprint:
        raise ValueError(
            f"accurate_model: start is a model of {model.problem.mesh!r}, but the problem is on "
            f"another mesh, {problem.mesh!r}; make it with start.problem.with_handles, or leave "
            "out start"
        )
    if len(model.training_parameters) < 2:
        raise ValueError(
            "accurate_model: start was made without snapshots, so it has no shapes to begin with; "
            "give a model of reduce(..., snapshots=...), or leave out start"
        )


def judging_seed(model: PosingModel | None, seed: int) -> int | None:
    """A seed of held-out samples that depends on the samples that the old model was trained with.

    With the seed of the old model they would be at the places of its training samples in the unit
    cube. In a wider box their translations would differ by a factor only, and their angles not at
    all: the error of unseen motions was measured a quarter too small.
    """
    if model is None:
        return None
    trained = np.ascontiguousarray(model.training_parameters, "<f8").tobytes()
    digest = hashlib.sha256(f"{seed} ".encode() + trained).digest()
    return int.from_bytes(digest[:4], "little")
