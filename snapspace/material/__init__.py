"""Materials: elastic densities and their moduli."""

from .arap import ARAP
from .corotational import Corotational
from .material import Material
from .materials import DEFAULT_MATERIAL, MATERIALS, checked_material, material_class
from .mooney_rivlin import MooneyRivlin
from .stable_neo_hookean import StableNeoHookean
from .stvk import StVK
from .symmetric_dirichlet import SymmetricDirichlet

__all__ = [
    "ARAP",
    "DEFAULT_MATERIAL",
    "MATERIALS",
    "Corotational",
    "Material",
    "MooneyRivlin",
    "StVK",
    "StableNeoHookean",
    "SymmetricDirichlet",
    "checked_material",
    "material_class",
]
