"""Timings in a model's record, separate from the parts that are equal in identical runs."""

from __future__ import annotations

import hashlib
import json
from typing import Any

#: Entries of a record that hold seconds, at any depth.
NAMES = ("seconds", "pose_seconds")
#: Entries in the header of a file: the timings with their places, and their checksum.
TIMINGS, CHECKSUM = "timings", "timings_checksum"


def split(record: Any) -> tuple[Any, list[list[Any]]]:
    """A record without its seconds, and the seconds as [place, value]; a place lists its keys."""
    if isinstance(record, list):
        parts = list(enumerate(record))
    elif isinstance(record, dict):
        parts = [(key, value) for key, value in record.items() if key not in NAMES]
    else:
        return record, []
    split_parts = [(key, split(value)) for key, value in parts]
    found = [
        [[key, *place], value] for key, (_, timings) in split_parts for place, value in timings
    ]
    rests = {key: rest for key, (rest, _) in split_parts}
    if isinstance(record, list):
        return list(rests.values()), found
    return rests, [[[name], record[name]] for name in NAMES if name in record] + found


def merged(record: dict[str, Any], timings: Any) -> dict[str, Any]:
    """Puts the seconds back into a record, in place, and returns it.

    Raises
    ------
    LookupError, TypeError, ValueError
        If a place is not in the record.
    """
    for (*parents, name), value in timings:
        if name not in NAMES:
            raise ValueError(f"'{name}' is not an entry with seconds")
        entry: Any = record
        for key in parents:
            entry = entry[key]
        entry[name] = value
    return record


def timing_header(timings: list[list[Any]]) -> dict[str, str]:
    """The entries of a file's header that hold the timings."""
    text = json.dumps({"entries": timings}, sort_keys=True)
    return {TIMINGS: text, CHECKSUM: _checksum(text)}


def is_unaltered(header: dict[str, str]) -> bool:
    """Whether the seconds in a header match their checksum; True if the header has neither."""
    if TIMINGS not in header:
        return CHECKSUM not in header
    return header.get(CHECKSUM) == _checksum(header[TIMINGS])


def _checksum(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:16]
