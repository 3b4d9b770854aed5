"""The materials by name: the only place in Python that lists them."""

from __future__ import annotations

from typing import Any

from ..arguments import shown
from .arap import ARAP, BLEND_RADIUS, SURFACE_RADIUS
from .corotational import Corotational
from .material import Material
from .mooney_rivlin import MooneyRivlin
from .stable_neo_hookean import StableNeoHookean
from .stvk import StVK
from .symmetric_dirichlet import SymmetricDirichlet

#: By `Material.kind`; each is a density of core/material/materials.h.
MATERIALS: dict[str, type[Material]] = {
    material.kind: material
    for material in (StableNeoHookean, Corotational, ARAP, StVK, SymmetricDirichlet, MooneyRivlin)
}

#: The material of a solid if the user names none.
DEFAULT_MATERIAL = StableNeoHookean


def material_class(kind: str) -> type[Material]:
    """The class of a kind; ValueError, which lists the known kinds, for any other name."""
    if kind not in MATERIALS:
        raise ValueError(f"unknown material '{kind}'; known are {', '.join(sorted(MATERIALS))}")
    return MATERIALS[kind]


def default_material(*, surface: bool, blended: bool = False) -> Material:
    """The material of a posed or blended body if the user names none."""
    if not surface:
        return DEFAULT_MATERIAL()
    return ARAP(radius=BLEND_RADIUS if blended else SURFACE_RADIUS)


def checked_material(material: Any, count: int, who: str) -> Material:
    """The material; ValueError of `who` unless it is one of `MATERIALS` for `count` tets.

    A subclass with its own density is refused: the core would use the density of its `kind`.
    """
    if isinstance(material, type) and issubclass(material, Material):
        raise ValueError(
            f"{who}: material is the class {material.__name__}; give an instance, such as "
            f"{material.__name__}.from_lame(lam=1, mu=1)"
        )
    if type(material) not in MATERIALS.values():
        known = ", ".join(one.__name__ for one in MATERIALS.values())
        raise ValueError(
            f"{who}: material is {shown(material)[:60]} of type {type(material).__name__}, but it "
            f"must be one of {known}"
        )
    checked: Material = material
    checked.check_tets(count, who)
    return checked
