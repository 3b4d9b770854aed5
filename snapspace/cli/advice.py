"""The advice of `validate` and of a build for a model that could be better."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..accurate import plan_of
from ..reduction import InterpolationModel, PosingModel
from ..validation import PARTS, ErrorSplit, NextOption, Validation, next_option, split_errors
from .console import notice
from .next_build import next_build
from .outliers import CURE, OTHER_MINIMUM
from .progress import spinner
from .units import in_percent

#: Number of full solutions whose errors are split; advice needs only the largest part.
SPLIT = 5


@dataclass(frozen=True)
class Advice:
    """What to build next.

    split : ErrorSplit of some of the unseen samples
    option : the option that helps most
    command : words after `snapspace`; None if the model does not name its files
    """

    split: ErrorSplit
    option: NextOption
    command: list[str] | None

    def as_json(self) -> dict[str, Any]:
        """The entry "next" of `snapspace validate --json`."""
        command = None if self.command is None else shlex.join(["snapspace", *self.command])
        return {
            "part": self.option.part,
            "reason": self.option.reason,
            "command": command,
            "python": self.option.python,
        }

    def print_notices(self) -> None:
        """Prints the parts of the error, and the calls in Python if there is no command."""
        if self.split.largest == "minimum":
            notice(
                f"notice: most frames are not near the full solution, but {OTHER_MINIMUM}; {CURE}; "
                "in Python, `session.solve_anew()` looks for a lower one"
            )
        parts = ", ".join(
            f"{name} {in_percent(float(np.median(getattr(self.split, name))))}" for name in PARTS
        )
        notice(
            f"notice: {self.option.reason}; medians of the error's parts over "
            f"{len(self.split.error)} unseen samples: {parts}"
        )
        if self.command is None:
            notice(f"a better model, in Python: {self.option.python}")

    @property
    def suggestions(self) -> list[tuple[str, list[str | Path]]]:
        """For `print_next`: the command, if there is one."""
        if self.command is None:
            return []
        return [("a better model", [*self.command])]


def split_of_some(
    model: PosingModel | InterpolationModel,
    validation: Validation,
    *,
    threads: int | None,
    count: int = SPLIT,
) -> ErrorSplit | None:
    """Splits the errors at the first `count` full solutions of a validation.

    None, with a notice, if a reduced minimiser of all tets is not found.
    """
    reference = validation.reference
    some = reference.select(np.arange(len(reference)) < count)
    try:
        with spinner("parts of the error"):
            return split_errors(model, some, threads=threads)
    except ValueError as error:
        notice(f"notice: the parts of the error are not known: {error}")
        return None


def advice(
    model: PosingModel | InterpolationModel,
    validation: Validation,
    split: ErrorSplit,
    file: Path,
    *,
    folders: Sequence[Path] = (),
) -> Advice:
    """What to build next, for a model file."""
    option = next_option(model, split)
    error = plan_of(model.problem).typical(validation.error)
    return Advice(split, option, next_build(option, model, error, file, folders=folders))
