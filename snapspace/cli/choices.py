"""Choices of `build` and `interpolate`: samples, subspace and solver, as options."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import wraps
from typing import Any

import click

from ..sampling import METHODS, Domain, Method, sample
from ..snapshots import SOLVERS, SolverOptions
from ..snapshots.solver_options import Solver
from .console import notice
from .recipe import Recipe


@dataclass(frozen=True, kw_only=True)
class Choices:
    """What the user chose; None where the command's default holds."""

    samples: int
    dimension: int | None
    energy_fraction: float | None
    sampling: Method | None
    no_scramble: bool
    seed: int
    solver: Solver
    tolerance: float | None
    max_iterations: int
    clamp: float
    lumped: bool
    include_unconverged: bool

    def solver_options(self) -> SolverOptions:
        """The solver's options; ValueError if one is out of range."""
        return SolverOptions(
            solver=self.solver,
            tolerance=self.tolerance,
            max_iterations=self.max_iterations,
            clamp=self.clamp,
        )

    def recipe(
        self, domain: Domain, *, dimension: int, threads: int | None, known: int = 0
    ) -> Recipe:
        """The recipe for a domain; `dimension` holds if neither size was given."""
        # in one dimension even spacing beats all other ways
        method = self.sampling or ("grid" if domain.dimension == 1 else "sobol")
        parameters = sample(
            domain,
            self.samples,
            method=method,
            seed=self.seed,
            scramble=not self.no_scramble,
        )
        neither = self.dimension is None and self.energy_fraction is None
        recipe = Recipe(
            parameters=parameters,
            sampling={
                "method": method,
                "samples": self.samples,
                "seed": self.seed,
                "scramble": not self.no_scramble,
            },
            solver=self.solver_options(),
            dimension=dimension if neither else self.dimension,
            energy_fraction=self.energy_fraction,
            lumped=self.lumped,
            include_unconverged=self.include_unconverged,
            threads=threads,
            known=known,
        )
        if len(parameters) < self.samples:
            notice(f"notice: the grid has {len(parameters)} samples, not {self.samples}")
        return recipe


def choice_options(
    *, samples: int, dimension: int, sampling: Method | None
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """The options of `Choices` with a command's defaults, passed on as the parameter `choices`."""

    def decorate(command: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(command)
        def collected(**values: Any) -> Any:
            chosen = {field.name: values.pop(field.name) for field in fields(Choices)}
            return command(**values, choices=Choices(**chosen))

        for option in reversed(_options(samples, dimension, sampling)):
            collected = option(collected)
        return collected

    return decorate


def _options(
    samples: int, dimension: int, sampling: Method | None
) -> list[Callable[[Callable[..., Any]], Callable[..., Any]]]:
    return [
        click.option(
            "--samples",
            type=click.IntRange(min=1),
            default=samples,
            show_default=True,
            help="Number of snapshots. A grid takes the most that fill its axes evenly.",
        ),
        click.option(
            "--dimension",
            type=click.IntRange(min=1),
            help=f"Modes of the subspace [default: {dimension}].",
        ),
        click.option(
            "--energy-fraction",
            type=float,
            help="Instead of --dimension: the fewest modes that hold this share, such as 0.9999.",
        ),
        click.option(
            "--sampling",
            type=click.Choice(METHODS),
            default=sampling,
            show_default=sampling or "grid for two poses, else sobol",
            help="Method.",
        ),
        click.option("--no-scramble", is_flag=True, help="The plain Sobol sequence."),
        click.option(
            "--seed",
            type=click.IntRange(min=0),
            default=0,
            show_default=True,
            help="Of random and of scrambled Sobol samples.",
        ),
        click.option(
            "--solver",
            type=click.Choice(SOLVERS),
            default="fast",
            show_default=True,
            help="fast: L-BFGS on one factor for all samples. newton: the paper's method, as a "
            "reference.",
        ),
        click.option(
            "--tolerance",
            type=float,
            help="Converged: the decrease still expected is below this share of the energy "
            "[default: 1e-5 for posing, 1e-9 for interpolation].",
        ),
        click.option(
            "--max-iterations",
            type=click.IntRange(min=1),
            default=SolverOptions.max_iterations,
            show_default=True,
            help="Per sample.",
        ),
        click.option(
            "--clamp",
            type=float,
            default=SolverOptions.clamp,
            show_default=True,
            help="Newton: least singular value in the Hessian, in (0, 1].",
        ),
        click.option("--lumped", is_flag=True, help="Diagonal mass matrix."),
        click.option(
            "--include-unconverged", is_flag=True, help="Also use samples that stopped early."
        ),
    ]
