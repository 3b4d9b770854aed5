"""ModelSearch: adds samples and dimensions until a model meets a target."""

from __future__ import annotations

import itertools
import time
from collections.abc import Callable, Iterator
from functools import partial

from ..arguments import check_target
from ..interruptible import begin_abandonable
from ..mesh import EmbeddedSurface
from ..problem import InterpolationProblem, PosingProblem
from ..reduction import InterpolationModel, PosingModel, reduce
from ..snapshots import Snapshots
from ..subspace import AffineSubspace
from .checks import check_budget, check_most
from .dimension_search import DimensionSearch
from .early_parts import make_early_parts
from .growing_samples import GrowingSamples
from .largest_pca import largest_pca, widened_pca
from .measured_ratio import measured_ratio
from .old_model import OldModel, check_start, judging_seed, usual_shapes
from .plan import is_large, plan_of, predicted_most_samples, usual_most_samples
from .predicting import MOST_DIMENSIONS, Predicting, predicting_stars
from .restricted_model import restricted_model, with_starts
from .search_options import SearchOptions
from .solving import Solving
from .step import Step
from .trial import Trial, recorded, trial_of

Model = PosingModel | InterpolationModel
#: Gets a line of text for the user.
Tell = Callable[[str], None]
#: Gets "snapshots", "subspace" or "energy" before each of these parts of the work.
Begins = Callable[[str], None]


class ModelSearch:
    """The search that `accurate_model` and `growing_models` share.

    Parameters
    ----------
    problem : PosingProblem or InterpolationProblem
    options, solving : SearchOptions, Solving
        Target and limits, and how samples are solved.
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
        self._begin = time.perf_counter()
        usual = plan_of(problem)
        self.target = usual.target if options.target_error is None else options.target_error
        most = options.most_samples
        self.most = usual_most_samples(problem) if most is None else most
        self._most_predicted = predicted_most_samples(problem) if most is None else most
        check_target(self.target)
        check_most(self.most)
        check_budget(options.budget)
        self._budget = options.budget
        self._plan = usual.fitting(self.most)
        self._restricted: PosingModel | None = None
        self._old: OldModel | None = None
        if start is not None:
            check_start(start, problem)
            assert isinstance(problem, PosingProblem)
            self._restricted = restricted_model(start, problem, surface)
            if self._restricted is None:
                wanted = max(self._plan.first, usual_shapes(start, problem))
                near = min(wanted, self.most - self._plan.held_out)
                self._old = OldModel(start, problem, most=near)
        self._first: Model | None = None  # made from the old one
        self._predicting = Predicting()
        self._solving, self._surface = solving, surface
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
        self._model_seconds = 0.0  # what the last model took; 0 before the first
        self._finish_parts = begin_abandonable(lambda: make_early_parts(problem))

    @property
    def seconds(self) -> float:
        """Time since the search began."""
        return time.perf_counter() - self._begin

    def solve_impression(self, known: Snapshots | None = None) -> Snapshots | None:
        """Solves the loose samples of a preliminary model, where later solves start; None if none.

        known : where they start, as for `solve_snapshots`; no effect with a model of other handles
        """
        if self._old is not None:
            return self._begin_with(self._old)
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

    def impression(self, loose: Snapshots) -> Model:
        """The preliminary model, or the one made from an old model."""
        if self._first is not None:
            return self._first
        return self._model(loose, min(self._plan.impression_dimension, len(loose) - 1))

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
        make = partial(self._model, tets=predicting_stars(self.samples.problem))
        model = self._predicting.model(self.samples.solved, make)
        self._begins("snapshots")
        return model

    def _begin_with(self, old: OldModel) -> Snapshots:
        """Returns shapes near solutions, and makes the first model of these and the old shapes."""
        self._begins("snapshots")
        near = old.near_solutions(self.samples.training_parameters, self._solving.threads)
        self.samples.begin_with(old.shapes, near)
        self._begins("subspace")
        self._finish_parts()
        basis = old.widened(near, self._plan.most_dimensions, self._solving.threads)
        self._first = self._reduced(basis, near)
        return near

    def _taken(self, trial: Trial) -> Trial:
        """Reports and records a trial, and returns it."""
        self._tell(str(trial.step))
        self.steps.append(trial.step)
        if self.best is None or trial.step.error < self.best.step.error:
            self.best = trial
        return trial

    def _try(self, count: int, dimension: int, tries: DimensionSearch) -> Trial:
        begin = time.perf_counter()
        model = self._model(self.samples.trained, dimension)
        trial = self._judged(count, model, tries.projection(dimension))
        self._model_seconds = time.perf_counter() - begin
        return trial

    def _widened(self, count: int) -> Iterator[Trial]:
        """Tries more dimensions than the last samples have, see `widened_pca`."""
        problem = self.samples.problem
        fits = isinstance(problem, PosingProblem) and not is_large(problem)
        late = self._budget is not None and self.seconds + self._model_seconds > self._budget
        if self._is_met or late or not fits:
            return
        self._tell("no more samples are allowed: parts of samples are combined")
        self._begins("subspace")
        trained = self.samples.trained
        most = min(self._plan.most_dimensions, 2 * len(trained))
        basis = widened_pca(trained, most, threads=self._solving.threads)
        yield self._taken(self._judged(count, self._reduced(basis, trained)))

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

    def _model(
        self,
        snapshots: Snapshots,
        dimension: int,
        trained: Snapshots | None = None,
        *,
        tets: int | None = None,
    ) -> Model:
        """A model of at most a dimension; `trained` are the samples that train it, default all."""
        self._begins("subspace")
        self._finish_parts()
        basis = largest_pca(snapshots, dimension, threads=self._solving.threads)
        return self._reduced(basis, trained or snapshots, tets)

    def _reduced(self, basis: AffineSubspace, trained: Snapshots, tets: int | None = None) -> Model:
        self._begins("energy")
        return reduce(
            self.samples.problem,
            basis,
            snapshots=trained,
            tets=tets,
            surface=self._surface,
            threads=self._solving.threads,
        )

    def _is_too_late(self, count: int, following: int) -> bool:
        """Whether the samples of the next stage and a model would exceed the budget."""
        if self._budget is None:
            return False
        # the first model takes up to as long as the samples that it is made of
        model = self._model_seconds or self.seconds
        wanted = self.samples.seconds_a_sample * (following - count) + model
        if self.seconds + wanted <= self._budget:
            return False
        self._tell(
            f"{following} samples would exceed the budget of {self._budget:g} s: {count} samples "
            "have to be enough"
        )
        return True
