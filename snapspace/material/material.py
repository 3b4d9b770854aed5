"""Material: what a body is made of, one set of moduli or one per tet."""

from __future__ import annotations

import hashlib
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import fields
from functools import cached_property
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from ..arguments import require_type
from .moduli import checked_modulus, lame_of_young

FloatArray = NDArray[np.float64]
#: A number that holds in all tets, or one number per tet, (m,).
Modulus = float | FloatArray
Own = TypeVar("Own", bound="Material")
#: Metadata of a field that is not a modulus: one number for the whole body.
SETTING = {"setting": True}


class Material(ABC):
    """An isotropic hyperelastic density with its moduli.

    A subclass is a frozen dataclass. Its fields are the moduli, in the same order as in
    core/material; each is a number, or an array (m,) with one number per tet. Moduli are energies
    per rest volume, and the density is linear in them. Fields with the metadata `SETTING` are
    numbers that the density does not depend on.

    Attributes
    ----------
    kind : name in files, on the command line and in the core
    title : name for people
    exact_degree : degree of the density as a polynomial of F, if it is one; else None
    barrier : whether inverted tets have infinite energy, so that solves must start without inverted
        tets
    collapses : whether blends of poses collapse to nine numbers per tet, as the core's `Blend` does
    lam, mu : Lame parameters of small strains; every material has them, as fields or properties
    """

    kind: ClassVar[str]
    title: ClassVar[str]
    exact_degree: ClassVar[int | None] = None
    barrier: ClassVar[bool] = False
    collapses: ClassVar[bool] = False
    lam: Any
    mu: Any

    def __post_init__(self) -> None:
        sizes = set()
        for name in self.names():
            value = checked_modulus(getattr(self, name), type(self).__name__, name)
            object.__setattr__(self, name, value)
            sizes |= {value.size} if isinstance(value, np.ndarray) else set()
        if len(sizes) > 1:
            raise ValueError(
                f"{type(self).__name__}: moduli of {' and '.join(map(str, sorted(sizes)))} tets do "
                "not match; give one number, or one per tet of the mesh"
            )

    @classmethod
    def names(cls) -> tuple[str, ...]:
        """Names of the moduli, in the core's order."""
        own = fields(cls)  # type: ignore[arg-type]  # a dataclass
        return tuple(field.name for field in own if not field.metadata)

    @classmethod
    def setting_names(cls) -> tuple[str, ...]:
        """Names of the fields that are not moduli."""
        own = fields(cls)  # type: ignore[arg-type]  # a dataclass
        return tuple(field.name for field in own if field.metadata)

    @property
    def settings(self) -> dict[str, float]:
        """The fields that are not moduli, by name, if they differ from the default."""
        given = {name: getattr(self, name) for name in self.setting_names()}
        return {name: x for name, x in given.items() if x != getattr(type(self), name)}

    def with_moduli(self: Own, moduli: Mapping[str, Any]) -> Own:
        """The material with other moduli, by name, and the same settings."""
        cure = "give a mapping from names to numbers, such as {'lam': 2.0, 'mu': 0.8}"
        require_type(type(self).__name__, "moduli", moduli, Mapping, cure)
        return type(self)(**moduli, **self.settings)

    @classmethod
    @abstractmethod
    def from_lame(cls: type[Own], *, lam: ArrayLike, mu: ArrayLike) -> Own:
        """The material that has these Lame parameters at small strains.

        A density without a volume term ignores `lam`.
        """

    @classmethod
    def from_young(cls: type[Own], *, youngs_modulus: ArrayLike, poisson_ratio: ArrayLike) -> Own:
        """The material with a Young's modulus > 0 and a Poisson ratio in [0, 0.5).

        Both are numbers, or arrays (m,) with one number per tet. Linear tets lock beyond 0.49.

        Raises
        ------
        ValueError
            For values out of range.
        """
        lam, mu = lame_of_young(youngs_modulus, poisson_ratio, cls.__name__)
        return cls.from_lame(lam=lam, mu=mu)

    @property
    def stiffness(self) -> Modulus:
        """2 mu + lam, the largest stiffness of small strains."""
        stiffness: Modulus = 2.0 * self.mu + self.lam
        return stiffness

    @cached_property
    def moduli(self) -> FloatArray:
        """All moduli, (1, k) where they are the same in all tets, else (m, k)."""
        columns = np.broadcast_arrays(*(np.atleast_1d(getattr(self, n)) for n in self.names()))
        return np.ascontiguousarray(np.stack(columns, axis=1))

    @property
    def uniform(self) -> bool:
        """Whether the moduli are the same in all tets."""
        return len(self.moduli) == 1

    @cached_property
    def core(self) -> _core.Material:
        """This material in the compiled core."""
        return _core.Material(self.kind, self.moduli)

    @cached_property
    def key(self) -> list[str]:
        """Everything that solutions depend on: the kind, a hash of the moduli, and the settings."""
        moduli = hashlib.sha256(self.moduli.astype("<f8").tobytes()).hexdigest()
        return [self.kind, moduli, *(f"{name} {x!r}" for name, x in self.settings.items())]

    def check_tets(self, count: int, who: str) -> None:
        """ValueError unless the moduli are the same in all tets, or one per tet of `count`."""
        if not self.uniform and len(self.moduli) != count:
            raise ValueError(
                f"{who}: the material has moduli for {len(self.moduli)} tets, but the mesh has "
                f"{count}; give one number, or one per tet"
            )

    def of_tets(self: Own, tets: NDArray[np.integer[Any]]) -> Own:
        """The material of some tets (r,), in their order."""
        if self.uniform:
            return self
        return self.with_moduli({name: self._per_tet(name)[tets] for name in self.names()})

    def _per_tet(self, name: str) -> FloatArray:
        values: FloatArray = np.broadcast_to(getattr(self, name), len(self.moduli))
        return values

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Material)
            and self.kind == other.kind
            and np.array_equal(self.moduli, other.moduli)
            and self.settings == other.settings
        )

    def __hash__(self) -> int:
        return hash(tuple(self.key))

    def __reduce__(self) -> tuple[Any, ...]:
        # cached properties are left out: the compiled material cannot be pickled
        moduli = {name: getattr(self, name) for name in self.names()}
        return _restore, (type(self), moduli | self.settings)


def _restore(kind: type[Own], arguments: dict[str, Any]) -> Own:
    return kind(**arguments)
