"""A model's recorded errors, for `info` and the end of a build."""

from __future__ import annotations

from typing import Any

from .units import in_percent

Facts = list[tuple[str, str]]


def accuracy_facts(record: dict[str, Any]) -> Facts:
    """Errors of unseen motions or blends, and inverted tets of solids, as far as recorded."""
    unseen = record.get("unseen")
    facts = _target_facts(record)
    if not isinstance(unseen, dict) or not {"name", "samples", "ninth"} <= unseen.keys():
        return facts
    if not facts:
        facts = [("accuracy", f"{_errors(unseen)}; {unseen['samples']} unseen samples")]
    if isinstance(unseen.get("inverted_tets"), dict):  # a shell has no tets
        facts.append(("inverted tets", _inverted(unseen)))
    return facts


def _target_facts(record: dict[str, Any]) -> Facts:
    """The errors of a model that was built for a target error; empty for others."""
    accurate = record.get("accurate")
    if not isinstance(accurate, dict) or not isinstance(accurate.get("step"), dict):
        return []
    step = accurate["step"]
    if not {"unseen", "typical", "mean", "ninth"} <= step.keys():
        return []
    figures = {"name": step["unseen"], "ninth": step["ninth"], "mean": step["mean"]}
    asked = f"{in_percent(accurate['target_error'])} asked"
    if step["typical"] == "median":
        figures["median"] = step["error"]
    return [("accuracy", f"{_errors(figures, asked)}; {step['samples']} samples solved")]


def _errors(figures: dict[str, Any], asked: str = "") -> str:
    averages = [
        f"{in_percent(figures[name])} in the {name}"
        for name in ("median", "mean")
        if name in figures
    ]
    parts = ", ".join([*averages, asked] if asked else averages)
    return (
        f"unseen {figures['name']} are off by {parts}; nine of ten by less than "
        f"{in_percent(figures['ninth'])}"
    )


def _inverted(unseen: dict[str, Any]) -> str:
    """Numbers of shapes with inverted tets, and the largest number in one shape."""
    counts = unseen["inverted_tets"]
    return (
        f"in {_shapes(counts['samples'], 'samples')}; in "
        f"{_shapes(counts['frames'], 'frames of unseen ' + unseen['name'])}; in "
        f"{_shapes(counts['unseen'], 'full solutions of these')}"
    )


def _shapes(counts: dict[str, Any], name: str) -> str:
    most = f", at most {counts['max']}" if counts["max"] else ""
    return f"{counts['with_some']} of {counts['shapes']} {name}{most}"
