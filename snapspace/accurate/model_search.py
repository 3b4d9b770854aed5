"""ModelSearch: adds samples and dimensions until a model meets a target."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from functools import partial

from ..mesh import EmbeddedSurface
from ..problem import InterpolationProblem, PosingProblem
from ..reduction import PosingModel
from ..snapshots import Snapshots
from .dimension_search import DimensionSearch
from .growing_samples import GrowingSamples
from .largest_pca import widened_pca
from .measured_ratio import measured_ratio
from .model_maker import Model, ModelMaker
from .old_model import OldModel, check_start, judging_seed, usual_shapes
from .plan import is_large, plan_of, predicted_most_samples, usual_most_samples
from .predicting import MOST_DIMENSIONS, Predicting, predicting_stars
from .restricted_model import restricted_model, with_starts
from .search_options import Begins, SearchOptions, Tell
from .search_time import SearchTime
from .solving import Solving
from .step import Step
from .trial import Trial, recorded, trial_of

#: Smallest dimension of the last model, relative to that of the next one, whose cubature gets the
#: stiffness of its tets; with half as many, errors of soft bodies grow by up to a quarter
#: (docs/notes/reduced-stiffness.md).
SIMILAR = 0.6


class ModelSearch:
    """The search that `accurate_model` and `growing_models` share.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
    options, solving : SearchOptions, Solving
        Target and limits, checked by `check_search`, and how samples are solved.
    start : PosingModel, optional
        A model of other handles, see `accurate_model`.
    surface, tell, begins : as for `reduce`, `accurate_model` and `growing_models`

    Raises
    ------
    ValueError
        As for `accurate_model`.
    """

    def __init__(
        self,
        problem: PosingProblem | InterpolationProblem,
        options: SearchOptions,
        solving: Solving,
        *,
        start: PosingModel | None = None,
        surface: EmbeddedSurface | None = None,
        tell: Tell | None = None,
        begins: Begins | None = None,
    ) -> None:
        self.time = SearchTime(options.budget)
        usual = plan_of(problem)
        self.target = usual.target if options.target_error is None else options.target_error
        most = options.most_samples
        self.most = usual_most_samples(problem) if most is None else most
        self._most_predicted = predicted_most_samples(problem) if most is None else most
        self._plan = usual.fitting(self.most)
        self._restricted: PosingModel | None = None
        self._old: OldModel | None = None
        if start is not None:
            check_start(start, problem)
            assert isinstance(problem, PosingProblem)
            self._restricted = restricted_model(start, problem, surface)
            if self._restricted is None:
                near = usual_shapes(start, problem, self._plan, self.most)
                self._old = OldModel(start, problem, most=near)
        self._first: Model | None = None  # made from the old one
        self._predicting = Predicting()
        self._solving = solving
        self._tell = tell or (lambda line: None)
        self._begins = begins or (lambda part: None)
        self.samples = GrowingSamples(
            problem,
            self._most_predicted,
            method=self._plan.sampling,
            seed=options.seed,
            first=0 if start else self._plan.first,  # a model to judge is there already
            pilot=0 if self._old else self._plan.pilot,
            slow=self._plan.slow,
            judges_too=self._plan.trusts_predictions,
            held_out=self._plan.held_out,
            judging_seed=judging_seed(start, options.seed),
        )
        self.steps: list[Step] = []
        self.best: Trial | None = None
        self._tried: Model | None = None  # the last model that was tried
        self._maker = ModelMaker(
            problem, surface=surface, threads=solving.threads, begins=self._begins
        )

    def begin(self) -> None:
        """Does the work before `trials`: all that `preliminary_models` leaves for later solves."""
        loose = self.solve_impression()
        if self._old is not None and loose is not None:
            list(self._from_old(self._old, loose))

    def solve_impression(self, known: Snapshots | None = None) -> Snapshots | None:
        """Solves the loose samples of a preliminary model, where later solves start; None if none.

        known : where they start, as for `solve_snapshots`; no effect with a model of other handles
        """
        if self._old is not None:
            self._begins("snapshots")
            near = self._old.near_solutions(self.samples.training_parameters, self._solving.threads)
            self.samples.begin_with(self._old.shapes, near)
            return near
        count = min(self._plan.impression, self._plan.first)
        if not count:
            return None
        self._begins("snapshots")
        if (whole := self._restricted) is not None:
            leading = whole.leading(min(whole.dimension, MOST_DIMENSIONS))
            near = self.samples.begin_near(leading, count)
            unjudged = self.samples.unjudged(whole.training_parameters)
            self._first = with_starts(whole, near, unjudged)
            return near
        return self.samples.solve_loosely(count, self._solving, known=known)

    def preliminary_models(self, loose: Snapshots) -> Iterator[tuple[Model, bool]]:
        """Yields models before any is judged, and whether they are impressions of loose samples."""
        if self._first is not None:
            yield self._first, False
        elif self._old is None:
            dimension = min(self._plan.impression_dimension, len(loose) - 1)
            yield self._maker.of_snapshots(loose, dimension), True
        else:
            yield from self._from_old(self._old, loose)

    @property
    def chosen(self) -> Trial:
        """The best trial of all, with a record of the search; see `recorded`."""
        assert self.best is not None  # the last stage tries at least one
        return recorded(self.best, self.target, self.steps)

    def trials(self, *, one_a_stage: bool = False) -> Iterator[Trial]:
        """Yields the models that are tried; at the end `best` is the one to use.

        one_a_stage : also yield a model of a stage that cannot meet the target, to show progress.
            It does not count otherwise.
        """
        judged = [] if self._first is None else [self._plan.held_out]
        stages = judged + self._plan.stages(self.most)
        for stage in itertools.count():
            count = stages[stage]
            self._begins("snapshots")
            self.samples.solve_up_to(count, self._solving, predict=self._predict)
            if self.samples.are_predicted:
                self.most = self._most_predicted
                stages = self._plan.stages(self.most)
            last = count == self.most or self._is_too_late(count, stages[stage + 1])
            if self._first is not None and stage == 0:
                yield self._taken(self._judged(count, self._first))
            if count > self._plan.held_out and not self._is_met:
                tries = DimensionSearch(self.samples, self._plan, self.target, self._ratio())
                for dimension in tries.dimensions(last=last):
                    trial = self._taken(self._try(count, dimension, tries))
                    self._predicting.take(trial.model, self.samples.trained)
                    self._tried = trial.model
                    tries.add(trial.step)
                    yield trial
                if one_a_stage and not tries.steps and not last:
                    yield self._try(count, tries.most, tries)
                if last and tries.most < self._plan.most_dimensions:
                    yield from self._widened(count)
            if last or self._is_met:
                break
            target = f"{100 * self.target:.2g} %"
            self._tell(f"no dimension of {count} samples meets {target}: solving more samples")

    @property
    def _is_met(self) -> bool:
        """Whether the best model meets the target."""
        return self.best is not None and self.best.step.error <= self.target

    def _ratio(self) -> float:
        """Ratio of errors of reduced solutions to those of projections, as known so far.

        The smallest ratio of the steps, without that of a restricted model: it grows where more
        dimensions do not help. Before the first step, that of the last predicting model, if any.
        """
        steps = self.steps if self._restricted is None else self.steps[1:]
        if steps:
            return min(step.ratio for step in steps)
        model = self._predicting.latest
        if model is None or not self._plan.trusts_predictions:
            return self._plan.first_ratio
        return measured_ratio(model, self.samples.unseen, self._plan)

    def _predict(self) -> Model | None:
        """The model that predicts the next samples, if there is one."""
        if not self.samples.are_predicted:
            return self.best.model if self.best else self._first
        make = partial(self._maker.of_snapshots, tets=predicting_stars(self.samples.problem))
        model = self._predicting.model(self.samples.solved, make)
        self._begins("snapshots")
        return model

    def _from_old(self, old: OldModel, near: Snapshots) -> Iterator[tuple[Model, bool]]:
        """Yields a small model of shapes near solutions, then one of these and the old shapes."""
        impression = self._maker.of_snapshots(near, MOST_DIMENSIONS)
        yield impression, True
        self._begins("subspace")
        basis = old.widened(near, self._plan.most_dimensions, self._solving.threads)
        self._first = self._maker.of_basis(basis, near, stiffness_from=impression)
        yield self._first, False

    def _taken(self, trial: Trial) -> Trial:
        """Reports and records a trial, and returns it."""
        self._tell(str(trial.step))
        self.steps.append(trial.step)
        if self.best is None or trial.step.error < self.best.step.error:
            self.best = trial
        return trial

    def _try(self, count: int, dimension: int, tries: DimensionSearch) -> Trial:
        begin, last = self.time.spent, self._tried
        known = last if last and last.dimension >= SIMILAR * dimension else None
        model = self._maker.of_snapshots(self.samples.trained, dimension, stiffness_from=known)
        trial = self._judged(count, model, tries.projection(dimension))
        self.time.model = self.time.spent - begin
        return trial

    def _widened(self, count: int) -> Iterator[Trial]:
        """Tries more dimensions than the last samples have, see `widened_pca`."""
        problem = self.samples.problem
        fits = isinstance(problem, PosingProblem) and not is_large(problem)
        if self._is_met or not fits or not self.time.allows_model():
            return
        self._tell("no more samples are allowed: parts of samples are combined")
        self._begins("subspace")
        trained = self.samples.trained
        most = min(self._plan.most_dimensions, 2 * len(trained))
        basis = widened_pca(trained, most, threads=self._solving.threads)
        yield self._taken(self._judged(count, self._maker.of_basis(basis, trained)))

    def _judged(self, count: int, model: Model, projection: float | None = None) -> Trial:
        if projection is None:
            projection = self._plan.typical(self.samples.projection_errors_onto(model.subspace))
        return trial_of(
            model,
            self.samples.unseen,
            self._plan,
            samples=count,
            projection=projection,
            threads=self._solving.threads,
        )

    def _is_too_late(self, count: int, following: int) -> bool:
        """Whether the samples of the next stage and a model would exceed the budget."""
        if self.time.allows_model(self.samples.seconds_a_sample * (following - count)):
            return False
        self._tell(
            f"{following} samples would exceed the budget of {self.time.budget:g} s: {count} "
            "samples have to be enough"
        )
        return True
