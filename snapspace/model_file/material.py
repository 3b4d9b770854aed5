"""The material in model files: its name and numbers as JSON, moduli per tet as an array."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..material import MATERIALS, Material
from .container import Arrays, check_shapes

#: Moduli of all tets, (m, k) in the order of the material's names; only if they differ.
MODULI = "material_moduli"


class UnknownMaterialError(ValueError):
    """A material that is unknown to this version."""


def material_arrays(material: Material) -> Arrays:
    """The array of moduli, if they differ from tet to tet."""
    return {} if material.uniform else {MODULI: material.moduli}


def material_content(material: Material) -> dict[str, Any]:
    """Name, moduli and settings as JSON: numbers, or null where moduli differ from tet to tet."""
    moduli = {name: getattr(material, name) for name in material.names()}
    numbers = {name: None if np.ndim(value) else value for name, value in moduli.items()}
    return {"model": material.kind, **numbers, **material.settings}


def dtypes(arrays: Arrays) -> dict[str, type]:
    """Type of the array, if there is one."""
    return {MODULI: np.float64} if MODULI in arrays else {}


def material(arrays: Arrays, content: dict[str, Any], tets: int) -> Material:
    """The material of a body with this number of tets.

    `content` is the entry that `material_content` makes.

    Raises
    ------
    UnknownMaterialError
        For a model that this version does not know.
    KeyError, TypeError, ValueError
        If array and entry do not match, or a modulus is out of range.
    """
    if content["model"] not in MATERIALS:
        raise UnknownMaterialError(
            f"the material is '{content['model']}', but this snapspace knows "
            f"{', '.join(sorted(MATERIALS))}"
        )
    kind = MATERIALS[content["model"]]
    moduli = {name: content[name] for name in kind.names()}
    if MODULI in arrays:
        check_shapes(arrays, {MODULI: (tets, len(moduli))})
    for column, (name, value) in enumerate(moduli.items()):
        if value is None:
            moduli[name] = arrays[MODULI][:, column]
    settings = {name: content[name] for name in kind.setting_names() if name in content}
    return kind(**moduli, **settings)
