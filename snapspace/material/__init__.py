"""Materials: elastic densities and their moduli."""

from .arap import ARAP, BLEND_RADIUS, SURFACE_RADIUS
from .corotational import Corotational
from .material import Material
from .materials import (
    DEFAULT_MATERIAL,
    MATERIALS,
    checked_material,
    default_material,
    material_class,
)
from .mooney_rivlin import MooneyRivlin
from .shear_material import ShearMaterial
from .stable_neo_hookean import StableNeoHookean
from .stvk import StVK
from .symmetric_dirichlet import SymmetricDirichlet

__all__ = [
    "ARAP",
    "BLEND_RADIUS",
    "DEFAULT_MATERIAL",
    "MATERIALS",
    "SURFACE_RADIUS",
    "Corotational",
    "Material",
    "MooneyRivlin",
    "ShearMaterial",
    "StVK",
    "StableNeoHookean",
    "SymmetricDirichlet",
    "checked_material",
    "default_material",
    "material_class",
]
