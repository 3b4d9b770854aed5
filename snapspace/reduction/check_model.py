"""check_model: refuses anything that is not a model."""

from __future__ import annotations

from ..arguments import wrong_type
from .reduced_model import ReducedModel


def check_model(model: ReducedModel, who: str, cure: str = "give that of reduce or load") -> None:
    """Raises a ValueError in the name of `who` for anything but a model, such as a session."""
    if not isinstance(model, ReducedModel):
        is_session = hasattr(model, "model")
        raise wrong_type(who, "model", model, "give session.model" if is_session else cure)
