"""Choices: the options of `build` and `interpolate` for samples, subspace and solver."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import wraps
from typing import Any, Literal

import click

from ..problem import Projection
from ..sampling import ANYWHERE, METHODS, BlendDomain, Domain, Method, sample
from ..snapshots import PROJECTIONS, SOLVERS, SolverOptions
from ..snapshots.solver_options import Solver
from .console import notice
from .given_options import chosen_parameters
from .options import ITERATION_COUNT, MODE_COUNT, SAMPLE_COUNT, SEED_NUMBER, SHARE_OR_NONE
from .recipe import Recipe
from .samples import ChosenSamples, GivenSamples, Samples, sampling_record

Sampling = Method | Literal["greedy"]
#: Sampling methods for handle motions, and for weights of poses.
MOTION_SAMPLINGS: tuple[Sampling, ...] = (*ANYWHERE, "greedy")
WEIGHT_SAMPLINGS: tuple[Sampling, ...] = (*METHODS, "greedy")
# From this many poses on, uniform blends cover blends of two poorly: docs/notes/sampling.md.
_MANY_POSES = 5


@dataclass(frozen=True, kw_only=True)
class Choices:
    """The user's choices; None for the command's default."""

    samples: int
    dimension: int | None
    energy_fraction: float | None
    sampling: Sampling | None
    no_scramble: bool
    seed: int
    solver: Solver
    tolerance: float | None
    settling: float | None
    max_iterations: int
    projection: Projection | None
    clamp: float
    lumped: bool
    include_unconverged: bool

    def solver_options(self, *, tolerance: float | None = None) -> SolverOptions:
        """The solver's options; ValueError if one is out of range or of the other solver.

        `tolerance` is used if the user gave neither it nor settling; None leaves it to the problem.
        """
        self._check_solver()
        neither = self.tolerance is None and self.settling is None
        return SolverOptions(
            solver=self.solver,
            tolerance=tolerance if neither else self.tolerance,
            settling=self.settling,
            max_iterations=self.max_iterations,
            projection=self.projection,
            clamp=self.clamp,
        )

    def _check_solver(self) -> None:
        """ValueError for an option that has no effect with the chosen solver."""
        given = {option.opts[0] for option in chosen_parameters()}
        idle = {"--settling"} if self.solver == "newton" else {"--projection", "--clamp"}
        for word in sorted(given & idle):
            solver = "fast" if word == "--settling" else "newton"
            raise ValueError(f"{word} is for --solver {solver}; leave it out, or change the solver")

    def check_clamp(self, usual: Projection) -> None:
        """ValueError for --clamp without its projection; `usual` is the default projection."""
        given = {option.opts[0] for option in chosen_parameters()}
        projection = self.projection or usual
        if "--clamp" in given and projection != "stretches":
            why = "" if self.projection else ", the default of this material"
            raise ValueError(
                f"--clamp is for --projection stretches, not {projection}{why}; leave it out"
            )

    def recipe(
        self,
        domain: Domain,
        *,
        dimension: int,
        threads: int | None,
        known: int = 0,
        tolerance: float | None = None,
    ) -> Recipe:
        """The recipe for a domain.

        `dimension` is used if the user gave no size, `tolerance` as for `solver_options`.
        """
        method = self.sampling or self._usual_sampling(domain)
        samples = self._samples(domain, method, dimension)
        neither = self.dimension is None and self.energy_fraction is None
        recipe = Recipe(
            samples=samples,
            sampling=sampling_record(
                samples,
                method,
                asked=self.samples,
                seed=self.seed,
                scramble=not self.no_scramble,
            ),
            solver=self.solver_options(tolerance=tolerance),
            dimension=dimension if neither else self.dimension,
            energy_fraction=self.energy_fraction,
            lumped=self.lumped,
            include_unconverged=self.include_unconverged,
            threads=threads,
            known=known,
        )
        if samples.count < self.samples:
            notice(f"notice: the grid has {samples.count} samples, not {self.samples}")
        return recipe

    def _usual_sampling(self, domain: Domain) -> Sampling:
        if domain.dimension == 1:
            return "grid"  # in one dimension even spacing is best
        many = isinstance(domain, BlendDomain) and domain.dimension + 1 >= _MANY_POSES
        return "blends" if many else "sobol"

    def _samples(self, domain: Domain, method: Sampling, dimension: int) -> Samples:
        if self.no_scramble and method not in ("sobol", "blends"):
            raise ValueError(f"--no-scramble is for Sobol samples, not for --sampling {method}")
        if method != "greedy":
            parameters = sample(
                domain,
                self.samples,
                method=method,
                seed=self.seed,
                scramble=not self.no_scramble,
            )
            return GivenSamples(parameters)
        return ChosenSamples(
            count=self.samples, seed=self.seed, dimension=self.dimension or dimension
        )


def choice_options(
    *,
    samples: int,
    dimension: int,
    sampling: Sampling | None,
    samplings: tuple[Sampling, ...],
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Decorator: adds the options of `Choices`, passed as the parameter `choices`."""

    def decorate(command: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(command)
        def collected(**values: Any) -> Any:
            chosen = {field.name: values.pop(field.name) for field in fields(Choices)}
            return command(**values, choices=Choices(**chosen))

        for option in reversed(_options(samples, dimension, sampling, samplings)):
            collected = option(collected)
        return collected

    return decorate


def _options(
    samples: int,
    dimension: int,
    sampling: Sampling | None,
    samplings: tuple[Sampling, ...],
) -> list[Callable[[Callable[..., Any]], Callable[..., Any]]]:
    return [
        click.option(
            "--samples",
            type=SAMPLE_COUNT,
            default=samples,
            show_default=f"--target-error decides; {samples} with other choices",
            help="Number of snapshots. A grid uses as many as fill its axes evenly.",
        ),
        click.option(
            "--dimension",
            type=MODE_COUNT,
            help="Modes of the subspace [default: --target-error decides; "
            f"{dimension} with other choices].",
        ),
        click.option(
            "--energy-fraction",
            type=float,
            help="Instead of --dimension: the fewest modes with this share of the energy, such as "
            "0.9999.",
        ),
        click.option(
            "--sampling",
            type=click.Choice(samplings),
            default=sampling,
            show_default=sampling or "grid for two poses, blends for five or more, otherwise sobol",
            help=_sampling_help(samplings),
        ),
        click.option("--no-scramble", is_flag=True, help="Use the plain Sobol sequence."),
        click.option(
            "--seed",
            type=SEED_NUMBER,
            default=0,
            show_default=True,
            help="Seed of the samples; a grid does not use it.",
        ),
        click.option(
            "--solver",
            type=click.Choice(SOLVERS),
            default="fast",
            show_default=True,
            help="fast: L-BFGS with one preconditioner for all samples. newton: the paper's "
            "method, as a reference.",
        ),
        click.option(
            "--tolerance",
            type=float,
            help="Converged if the expected decrease is below this share of the energy "
            "[default: 1e-9 for interpolation; for posing with a cubature 1e-7, less for Poisson "
            "ratios above 0.25, but 1e-5 with St.Venant-Kirchhoff and 1e-6 for shells; otherwise "
            "--settling decides].",
        ),
        click.option(
            "--settling",
            type=SHARE_OR_NONE,
            help="Converged if 8 steps as long as the last 4 directions would together be shorter "
            "than this share of the displacement [default: 0.01 for an exact energy of posing "
            "without --tolerance, else 0: never].",
        ),
        click.option(
            "--max-iterations",
            type=ITERATION_COUNT,
            default=SolverOptions.max_iterations,
            show_default=True,
            help="Limit per sample.",
        ),
        click.option(
            "--projection",
            type=click.Choice(PROJECTIONS),
            help="Newton: how Hessians of tets become positive semi-definite [default: stretches, "
            "as in the paper, with St.Venant-Kirchhoff, otherwise clamp].",
        ),
        click.option(
            "--clamp",
            type=float,
            default=SolverOptions.clamp,
            show_default=True,
            help="Newton with the projection stretches: smallest singular value, in (0, 1].",
        ),
        click.option("--lumped", is_flag=True, help="Use a diagonal mass matrix."),
        click.option(
            "--include-unconverged", is_flag=True, help="Also use samples that stopped early."
        ),
    ]


def _sampling_help(samplings: tuple[Sampling, ...]) -> str:
    text = "Sampling. greedy: where the current model is worst; fewer samples, more time each."
    if "blends" in samplings:
        text += " blends: two and three poses first; the others: all poses, uniformly."
    return text
