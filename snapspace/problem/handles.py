"""Handles: the parts of a mesh that the user moves."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import require_type, shown, wrong_type
from .names import check_names

IndexArray = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Handle:
    """A named set of vertices that follows one motion.

    name : str
    vertices : (k,) int32, sorted and unique
    mask_length : number of entries of the boolean mask that it was given as, None for indices
    """

    name: str
    vertices: IndexArray
    mask_length: int | None = field(default=None, repr=False)

    def __post_init__(self) -> None:
        require_type("Handle", "name", self.name, str, "give a name")
        cure = "give an array of vertex indices; Handles takes lists and masks"
        require_type("Handle", "vertices", self.vertices, np.ndarray, cure)

    def __repr__(self) -> str:
        return f"Handle({self.name}: {len(self.vertices)} vertices)"

    def check_in(self, count: int, *, what: str = "mesh") -> None:
        """ValueError unless the handle fits a mesh, or the named object, of `count` vertices."""
        if self.mask_length not in (None, count):
            raise ValueError(
                f"handle '{self.name}': the mask has {self.mask_length} entries, but the {what} "
                f"has {count} vertices"
            )
        if self.vertices[-1] >= count:
            raise ValueError(
                f"handle '{self.name}' has vertex index {self.vertices[-1]}, but the {what} has "
                f"{count} vertices"
            )


class Handles:
    """Two or more disjoint handles; the first one is fixed while sampling.

    Parameters
    ----------
    vertices : sequence of array_like
        For each handle, vertex indices or a boolean mask over all vertices of the mesh. The length
        of a mask is checked when handles and mesh are combined, as in `PosingProblem`.
    names : sequence of str, optional
        One per handle, unique. Default: handle_0, handle_1, ...

    Raises
    ------
    ValueError
        For fewer than two handles, an empty or overlapping handle, a negative or non-integer index,
        a mask of integers, or names that do not match. The message names the handle.

    Examples
    --------
    >>> handles = Handles([[0, 1], [7, 8]], names=["foot", "head"])
    >>> handles["head"].vertices
    array([7, 8], dtype=int32)
    >>> handles.adding("tail", [3, 4]).without("head")
    Handles(foot: 2, tail: 2)
    """

    def __init__(
        self, vertices: Sequence[ArrayLike], *, names: Sequence[str] | None = None
    ) -> None:
        if isinstance(vertices, Mapping):
            cure = "give list(parts.values()), names=list(parts), the fixed one first"
            raise wrong_type("Handles", "vertices", vertices, cure)
        if not hasattr(vertices, "__len__"):
            cure = "give a list with the vertices of each handle, the fixed one first"
            raise wrong_type("Handles", "vertices", vertices, cure)
        if names is None:
            names = [f"handle_{i}" for i in range(len(vertices))]
        check_names(names, len(vertices), who="Handles", what=f"{len(vertices)} handles")
        self._handles = tuple(map(_handle, names, vertices))
        if len(self._handles) < 2:
            raise ValueError(
                f"Handles: got {len(self._handles)}, but posing needs a fixed handle and "
                "at least one to move"
            )
        self._check_disjoint()

    @property
    def names(self) -> tuple[str, ...]:
        """Names in order; the first one is fixed while sampling."""
        return tuple(handle.name for handle in self._handles)

    def index(self, name: str) -> int:
        """Position of the handle with this name; ValueError lists the names if there is none."""
        if not isinstance(name, str) or name not in self.names:
            given = name if isinstance(name, str) else shown(name)
            raise ValueError(
                f"there is no handle '{given}'; the handles are {', '.join(self.names)}"
            )
        return self.names.index(name)

    def places_in(self, others: Handles) -> tuple[int | None, ...]:
        """For each handle, the index among others of the one with the same vertices, or None."""
        require_type("Handles.places_in", "others", others, Handles, "give Handles")
        places = {handle.vertices.tobytes(): place for place, handle in enumerate(others)}
        return tuple(places.get(handle.vertices.tobytes()) for handle in self)

    def adding(self, name: str, vertices: ArrayLike) -> Handles:
        """These handles and, after them, one more; ValueError as for the constructor."""
        return _handles([*self, _handle(name, vertices)])

    def replacing(self, name: str, vertices: ArrayLike) -> Handles:
        """These handles with other vertices for one; ValueError if there is no such handle."""
        chosen = list(self)
        chosen[self.index(name)] = _handle(name, vertices)
        return _handles(chosen)

    def without(self, name: str) -> Handles:
        """All handles except one; ValueError if there is no such one, or one would be left.

        If it is the first, the next one is fixed while sampling.
        """
        self.index(name)
        return _handles([handle for handle in self if handle.name != name])

    def fixing(self, name: str) -> Handles:
        """These handles with one of them moved to the front, where it is fixed while sampling.

        ValueError if there is no such handle.
        """
        return _handles(
            [self[self.index(name)], *(handle for handle in self if handle.name != name)]
        )

    def __len__(self) -> int:
        return len(self._handles)

    def __iter__(self) -> Iterator[Handle]:
        return iter(self._handles)

    def __getitem__(self, key: int | str) -> Handle:
        return self._handles[self.index(key) if isinstance(key, str) else key]

    def __repr__(self) -> str:
        sizes = ", ".join(f"{handle.name}: {len(handle.vertices)}" for handle in self)
        return f"Handles({sizes})"

    def __reduce__(self) -> tuple[Callable[[Sequence[Handle]], Handles], tuple[tuple[Handle, ...]]]:
        # unpickling checks the handles and makes their arrays read-only
        return _handles, (self._handles,)

    def _check_disjoint(self) -> None:
        for i, a in enumerate(self._handles):
            for b in self._handles[i + 1 :]:
                common = np.intersect1d(a.vertices, b.vertices)
                if common.size:
                    raise ValueError(
                        f"Handles: '{a.name}' and '{b.name}' overlap in {common.size} vertices, "
                        f"the first is {common[0]}; a vertex can follow one handle only"
                    )


def _handles(chosen: Sequence[Handle]) -> Handles:
    handles = Handles([h.vertices for h in chosen], names=[h.name for h in chosen])
    pairs = zip(handles, chosen, strict=True)
    handles._handles = tuple(replace(h, mask_length=old.mask_length) for h, old in pairs)
    return handles


def _handle(name: str, which: ArrayLike) -> Handle:
    try:
        array = np.asarray(which)
    except ValueError:  # rows of different lengths
        cure = "give a list of vertex indices or a boolean mask"
        raise wrong_type(f"Handles: '{name}'", "vertices", which, cure) from None
    if array.dtype == bool and array.ndim == 1:
        return Handle(name, _as_indices(name, np.flatnonzero(array)), mask_length=len(array))
    return Handle(name, _as_indices(name, array))


def _as_indices(name: str, array: NDArray[Any]) -> IndexArray:
    if array.size == 0:
        raise ValueError(
            f"Handles: '{name}' has no vertices; widen its boxes or spheres, or list vertices"
        )
    if array.ndim != 1 or not np.issubdtype(array.dtype, np.integer):
        raise ValueError(
            f"Handles: '{name}' must be a list of vertex indices or a boolean mask, got "
            f"{array.dtype} of shape {array.shape}"
        )
    if array.size > 2 and ((array == 0) | (array == 1)).all():
        raise ValueError(
            f"Handles: '{name}' has {array.size} entries that are all 0 or 1; give a mask as "
            "booleans, mask.astype(bool), or each vertex index once"
        )
    if array.min() < 0:
        raise ValueError(f"Handles: '{name}' has the negative vertex index {array.min()}")
    if array.max() > np.iinfo(np.int32).max:
        raise ValueError(f"Handles: '{name}' has the vertex index {array.max()}, beyond 32 bits")
    indices = np.unique(array).astype(np.int32)
    indices.setflags(write=False)
    return indices
