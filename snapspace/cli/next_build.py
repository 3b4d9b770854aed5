"""next_build: the command that builds a better model."""

from __future__ import annotations

import json
from collections.abc import Sequence
from math import floor, log10
from pathlib import Path
from typing import Any

from ..accurate import plan_of
from ..problem import is_quartic
from ..reduction import InterpolationModel, PosingModel
from ..validation import NextOption
from .given_options import as_words
from .target_error import MOTIONS_DECIDING, option_word

Model = PosingModel | InterpolationModel

#: The target error, relative to the current one.
BETTER = 0.5
_DECIDING = set(map(option_word, MOTIONS_DECIDING))


def next_build(
    option: NextOption, model: Model, error: float, file: Path, *, folders: Sequence[Path] = ()
) -> list[str] | None:
    """The words after `snapspace` for an option; None if the model does not name its files.

    Parameters
    ----------
    option : NextOption
        The option that improves the model most.
    model : PosingModel or InterpolationModel
        The model to improve.
    error : float
        Typical error at unseen parameters, the median of motions or the mean of blends.
    file : Path
        The model's file. The next model is written beside it, and its input is searched for there.
    folders : sequence of Path
        Further folders to search for the input, besides the file's folder and the current one.
    """
    record = model.provenance
    inputs = _inputs(record, [*folders, file.parent, Path()])
    given = record.get("options")
    if inputs is None or not isinstance(given, dict):
        return None
    options = _options(option, model, error, dict(given))
    output = file.with_name(f"{file.stem}-next{file.suffix}")
    first = [name for name in ("--samples", "--dimension") if name in options]
    ordered = {name: options[name] for name in dict.fromkeys([*first, *sorted(options)])}
    return [*inputs, *as_words(ordered), "-o", str(output)]


def _inputs(record: dict[str, Any], folders: Sequence[Path]) -> list[str] | None:
    """The command with its files; None if a file is not found."""
    if isinstance(record.get("problem"), str):
        problem = _found(record["problem"], folders)
        if problem is None:
            return None
        words = ["build", "--problem", str(problem)]
        content = json.loads(problem.read_text(encoding="utf-8-sig"))
        named = content.get("mesh", content.get("surface"))
        if isinstance(named, str) and Path(named).name == record.get("mesh"):
            return words
        mesh = _found(str(record.get("mesh")), folders)
        return None if mesh is None else [*words, str(mesh)]
    if not isinstance(record.get("poses"), list):
        return None
    tets = record.get("tets")
    names = [*record["poses"], *([] if tets is None else [tets])]
    files = [_found(str(name), folders) for name in names]
    if None in files or len(set(names)) < len(names):
        return None
    poses = [str(file) for file in files[: len(record["poses"])]]
    return ["interpolate", *poses, *([] if tets is None else ["--tets", str(files[-1])])]


def _found(name: str, folders: Sequence[Path]) -> Path | None:
    return next((folder / name for folder in folders if (folder / name).is_file()), None)


def _options(
    option: NextOption, model: Model, error: float, given: dict[str, Any]
) -> dict[str, Any]:
    """The model's options with the changes of the advice."""
    given.pop("--budget", None)
    blends = isinstance(model, InterpolationModel)
    tets = "--cubature-tets" if blends else "--tets"
    if option.part == "cubature":
        given.pop("--target-error", None)
        if not _DECIDING & given.keys():
            solved = model.provenance.get("snapshots", {}).get("solved", option.samples)
            given |= {"--samples": solved, "--dimension": option.dimension}
        return {**given, tets: option.tets}
    given.pop(tets, None)
    if _can_aim(model, given):
        kept = {name: value for name, value in given.items() if name not in _DECIDING}
        return {**kept, "--target-error": _target(model, error)}
    for name in ("--energy-fraction", "--target-error"):
        given.pop(name, None)
    if option.energy == "exact" and not blends:
        given["--energy"] = "exact"
    return {**given, "--samples": option.samples, "--dimension": option.dimension}


def _can_aim(model: Model, given: dict[str, Any]) -> bool:
    """Whether --target-error may help: not if it failed before, or is not available."""
    accurate = model.provenance.get("accurate")
    failed = isinstance(accurate, dict) and not accurate.get("reached", False)
    exact = is_quartic(model.problem)
    return not (failed or exact or "--extrapolation" in given)


def _target(model: Model, error: float) -> float:
    """Half of the error, in one digit, but at most the usual target."""
    wanted = min(BETTER * error, plan_of(model.problem).target)
    digit = 10.0 ** floor(log10(wanted))
    return float(f"{floor(wanted / digit + 1e-9) * digit:.1g}")
