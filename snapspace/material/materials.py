"""The materials by name: the one place in Python that knows them."""

from __future__ import annotations

from .arap import ARAP
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

#: What a body is made of where the user names no material.
DEFAULT_MATERIAL = StableNeoHookean


def material_class(kind: str) -> type[Material]:
    """The class of a kind; ValueError, with the known ones, for another name."""
    if kind not in MATERIALS:
        raise ValueError(f"unknown material '{kind}'; known are {', '.join(sorted(MATERIALS))}")
    return MATERIALS[kind]
