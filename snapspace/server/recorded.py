"""recorded: a model with the work of its page, for files and pages."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any, TypeVar

from ..reduction import PosingModel, ReducedModel
from ..timeline import timeline_of

ModelOf = TypeVar("ModelOf", bound=ReducedModel)


def recorded(model: ModelOf, *, up: str | None, timeline: str | None, **others: Any) -> ModelOf:
    """The model with more in its provenance.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
    up : "x", "y" or "z", or None
        Axis that points up; None: as before.
    timeline : str or None
        Content of a timeline file; None: none was made.
    others : entries of the provenance

    Raises
    ------
    ValueError
        For a timeline that is invalid, or of another kind than the model.
    """
    record = dict(others)
    if up is not None:
        record["up"] = up
    if timeline is not None:
        kind = "posing" if isinstance(model, PosingModel) else "interpolation"
        record["timeline"] = _checked_timeline(timeline, kind)
    return replace(model, provenance=model.provenance | record)


def _checked_timeline(text: str, kind: str) -> dict[str, Any]:
    """The content of a timeline file, parsed; ValueError unless it is a timeline of this kind."""
    try:
        content: dict[str, Any] = json.loads(text)
    except (ValueError, RecursionError):
        raise ValueError("the timeline is not JSON") from None
    own = timeline_of(content).kind
    if own != kind:
        raise ValueError(f"the timeline is of kind '{own}', but the model of '{kind}'")
    return content
