"""The options --target-error and --budget, and the options that replace them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

import click

from .console import notice
from .given_options import chosen_parameters
from .options import SHARE

Command = TypeVar("Command", bound=Callable[..., object])

#: Options that determine samples or subspace; with any of them nothing is chosen by a target error.
DECIDING = (
    "samples",
    "dimension",
    "energy_fraction",
    "sampling",
    "no_scramble",
    "solver",
    "lumped",
    "include_unconverged",
)
#: The same of `build` and of `interpolate`.
MOTIONS_DECIDING = (*DECIDING, "energy", "tets")
BLENDS_DECIDING = (*DECIDING, "extrapolation", "cubature_tets")


def option_word(name: str) -> str:
    """An option as it is written, such as --no-scramble for no_scramble."""
    return f"--{name.replace('_', '-')}"


def target_option(
    default: float, *, error: str, deciding: Sequence[str]
) -> Callable[[Command], Command]:
    """Adds --target-error and --budget; the help says which options replace them."""
    words = ", ".join(map(option_word, deciding))

    def add(command: Command) -> Command:
        command = click.option(
            "--budget",
            type=float,
            metavar="SECONDS",
            help="With --target-error: samples that would probably exceed it are not solved. The "
            "first 96 (44 for blends) always are. The model then depends on the machine's speed.",
        )(command)
        return click.option(
            "--target-error",
            type=SHARE,
            default=default,
            show_default=True,
            metavar="SHARE",
            help=f"{error}. It decides samples and dimension if none of {words} is given, except "
            "for stvk.",
        )(command)

    return add


def decided_by_hand(*, exact: bool = False, deciding: Sequence[str] = DECIDING) -> bool:
    """Whether an option or an exact energy, not the target error, determines samples and subspace.

    Parameters
    ----------
    exact : whether the material has an exact reduced energy
    deciding : names of the deciding options of the running command

    Raises
    ------
    ValueError
        If --target-error or --budget is given as well, which would have no effect.
    """
    given = {option.name: option.opts[0] for option in chosen_parameters()}
    decides = _given_words(deciding)
    chooses = next(
        (given[name] for name in ("target_error", "budget", "from_file") if name in given), None
    )
    if chooses and decides:
        raise ValueError(f"{chooses} chooses what {decides[0]} decides; leave one of them out")
    if chooses and exact:
        raise ValueError(
            f"{chooses} is for materials of one minimum, not for St.Venant-Kirchhoff; give "
            "--samples and --dimension"
        )
    return exact or bool(decides)


def notice_decided(deciding: Sequence[str]) -> None:
    """Prints which of the options, if any is given, replaces the target error."""
    words = _given_words(deciding)
    if words:
        verb = "decides" if len(words) == 1 else "decide"
        by_default = [] if "--samples" in words else ["--samples"]
        if not {"--dimension", "--energy-fraction"} & set(words):
            by_default.append("--dimension")
        sets = "sets" if len(by_default) == 1 else "set"
        size = f"; {' and '.join(by_default)} {sets} the size" if by_default else ""
        notice(
            f"notice: {', '.join(words)} {verb} in place of --target-error, which does not apply"
            f"{size}"
        )


def _given_words(deciding: Sequence[str]) -> list[str]:
    given = {option.name for option in chosen_parameters()}
    return [option_word(name) for name in deciding if name in given]
