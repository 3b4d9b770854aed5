"""Checks of the names of handles and poses."""

from __future__ import annotations

from collections.abc import Sequence

from ..arguments import wrong_type


def check_names(names: Sequence[str], count: int, *, who: str, what: str) -> None:
    """ValueError unless there are `count` names, none is empty and none is used twice.

    `who` begins the message, and `what` says what is named, with the number: "2 handles".
    """
    if isinstance(names, str):
        raise ValueError(f"{who}: names is the string '{names}', but must be a list of names")
    if not isinstance(names, Sequence):
        raise wrong_type(who, "names", names, "give a list of names")
    if len(names) != count:
        raise ValueError(f"{who}: got {len(names)} names for {what}")
    for name in names:
        if not isinstance(name, str) or not name.strip():
            raise ValueError(f"{who}: a name must be a non-empty string, got {name!r}")
        if list(names).count(name) > 1:
            raise ValueError(f"{who}: the name '{name}' is used twice")
