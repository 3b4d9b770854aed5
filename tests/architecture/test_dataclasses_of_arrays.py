"""Exported dataclasses that hold arrays are compared by identity, and can be keys."""

from __future__ import annotations

import dataclasses

import pytest

import snapspace as ss


def holds_arrays(each: object) -> bool:
    """Whether it is a dataclass with a field that is an array, or a matrix of SciPy."""
    fields = dataclasses.fields(each) if dataclasses.is_dataclass(each) else ()
    return any("Array" in str(field.type) or "csr_array" in str(field.type) for field in fields)


NAMES = [name for name in ss.__all__ if holds_arrays(getattr(ss, name))]


@pytest.mark.parametrize("name", NAMES)
def test_dataclasses_of_arrays_are_compared_by_identity(name: str) -> None:
    """NumPy's == gives arrays, whose truth is an error, and arrays have no hash."""
    each = getattr(ss, name)
    assert each.__eq__ is object.__eq__, f"{name} needs @dataclass(eq=False)"
    assert each.__hash__ is object.__hash__
