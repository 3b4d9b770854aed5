"""Materials: those that a page offers, and the one that it chooses."""

from __future__ import annotations

import numpy as np

from ..energy.shell_material import SHELLS
from ..material import (
    ARAP,
    DEFAULT_MATERIAL,
    MATERIALS,
    SURFACE_RADIUS,
    Material,
    default_material,
    material_class,
)
from ..mesh import Body, ShellMesh
from .messages import MaterialChoice

#: Beyond this ratio linear tets lock.
MOST_POISSON = 0.49


def material_choices() -> tuple[MaterialChoice, ...]:
    """All materials that a page can compute with."""
    return tuple(
        MaterialChoice(
            kind=kind,
            title=material.title,
            has_poisson=bool(material.from_lame(lam=1.0, mu=1.0).lam > 0),
            makes_shells=issubclass(material, SHELLS),
        )
        for kind, material in MATERIALS.items()
    )


def chosen_material(
    given: Material | None, mesh: Body, *, kind: str | None, poisson: float | None
) -> Material:
    """The material that a message chooses.

    Parameters
    ----------
    given : Material or None
        The material of the problem file; None: it has none.
    mesh : TetMesh or ShellMesh
        The body.
    kind : str or None
        The kind of another material with the same Lame parameters; None: the kind of `given`, or
        the usual one of the body.
    poisson : float or None
        Poisson's ratio, from 0 to 0.49, with the shear modulus of `given`; None: that of `given`.

    Raises
    ------
    ValueError
        For an unknown kind, or a ratio out of range.
    """
    if poisson is not None and not 0.0 <= poisson <= MOST_POISSON:
        raise ValueError(
            f"Poisson's ratio is {poisson:g}, but it must be from 0 to {MOST_POISSON}, since tets "
            "lock beyond that"
        )
    own = fitted_material(given, mesh)
    made = type(own) if kind is None else material_class(kind)
    if poisson is None and made is type(own):
        return own
    moduli = DEFAULT_MATERIAL() if given is None else own
    lam = (
        moduli.lam if poisson is None else 2.0 * np.asarray(moduli.mu) * poisson / (1 - 2 * poisson)
    )
    if made is ARAP and isinstance(mesh, ShellMesh):
        return ARAP(mu=moduli.mu, radius=own.radius if isinstance(own, ARAP) else SURFACE_RADIUS)
    return made.from_lame(lam=lam, mu=moduli.mu)


def usual_kind(given: Material | None, *, shell: bool) -> str:
    """Kind of the initial material of a solid or a shell."""
    usual = default_material(surface=shell) if given is None else given
    return usual.kind if not shell or isinstance(usual, SHELLS) else DEFAULT_MATERIAL.kind


def fitted_material(material: Material | None, mesh: Body) -> Material:
    """The material for a body; the usual one if none is given.

    A shell gets a material with a form for shells. Moduli that were given for other cells are
    replaced by their means.
    """
    if material is None:
        return default_material(surface=isinstance(mesh, ShellMesh))
    if isinstance(mesh, ShellMesh) and not isinstance(material, SHELLS):
        material = DEFAULT_MATERIAL.from_lame(lam=material.lam, mu=material.mu)
    moduli = {name: getattr(material, name) for name in material.names()}
    if all(np.size(value) in (1, len(mesh.cells)) for value in moduli.values()):
        return material
    return material.with_moduli({name: float(np.mean(value)) for name, value in moduli.items()})


def shown_poisson(material: Material) -> float | None:
    """Poisson's ratio of all tets; None if they differ, or if it is above 0.49."""
    ratios = np.atleast_1d(material.lam / (2.0 * (np.asarray(material.lam) + material.mu)))
    if np.ptp(ratios) > 1e-12 or ratios[0] > MOST_POISSON:
        return None
    return float(ratios[0])
