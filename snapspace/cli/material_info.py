"""Numbers about materials, for `info`."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..material import MATERIALS, Material

#: The model, and moduli by name: one number, or the smallest and the largest over all tets.
Figures = dict[str, Any]


def material_figures(material: Material) -> Figures:
    """The model, its moduli and settings, for JSON.

    Moduli that differ from tet to tet are {"min", "max"}.
    """
    figures: Figures = {"model": material.kind}
    for name in material.names():
        value = getattr(material, name)
        varies = np.ndim(value) > 0 and np.ptp(value) > 0
        figures[name] = (
            {"min": float(np.min(value)), "max": float(np.max(value))}
            if varies
            else float(np.min(value))
        )
    return figures | material.settings


def material_text(figures: Figures) -> str:
    """The same as text for the user."""
    moduli = [f"{name} {_text(value)}" for name, value in figures.items() if name != "model"]
    return ", ".join([MATERIALS[figures["model"]].title, *moduli])


def _text(value: float | dict[str, float]) -> str:
    if isinstance(value, dict):
        return f"varies from tet to tet: {value['min']:g} to {value['max']:g}"
    return f"{value:g}"
