"""Timeline files: JSON, with angles in degrees about the fixed axes x, y, z."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..arguments import as_path, wrong_type
from ..disk import atomic_file
from ..mesh.input_path import existing_file
from ..problem.json_entries import as_list, as_number, as_object, as_text, within
from .timeline import Key, Timeline

FORMAT, VERSION = "snapspace-timeline", 1
#: The largest file that is read, in bytes.
LARGEST = 64 * 2**20


def read_timeline(path: str | os.PathLike[str]) -> Timeline:
    """Reads a timeline, as the page or `write_timeline` writes it.

    The file has {"format": "snapspace-timeline", "version": 1, "kind": "posing" or "interpolation",
    "loop": false, "keys": [...]}. A key is {"time": seconds, "easing": "smooth", "linear" or
    "hold", ...} with "handles": {name: {"degrees": [x, y, z], "translation": [x, y, z]}}, or with
    "weights": {pose: weight}. Motions are from rest.

    Raises
    ------
    ValueError
        For a file that is missing, too large or not a timeline; the message names the entry.
    """
    file = existing_file(as_path("read_timeline", path), known=(".json",))
    with within(file):
        if file.stat().st_size > LARGEST:
            raise ValueError(f"a timeline has at most {LARGEST // 2**20} MB")
        try:
            content = json.loads(file.read_text(encoding="utf-8-sig"))
        except (json.JSONDecodeError, UnicodeDecodeError, RecursionError) as error:
            raise ValueError(f"this is not JSON: {error}") from None
        return timeline_of(content)


def write_timeline(path: str | os.PathLike[str], timeline: Timeline) -> Path:
    """Writes a timeline as JSON.

    Raises
    ------
    ValueError
        For something other than a timeline, rotations that are not Euler angles, or a file that
        cannot be written.
    """
    if not isinstance(timeline, Timeline):
        cure = "give path, timeline, such as Timeline('posing', keys)"
        raise wrong_type("write_timeline", "timeline", timeline, cure)
    keys = []
    for key in timeline.keys:
        entry: dict[str, Any] = {"time": key.time, "easing": key.easing}
        if timeline.kind == "posing":
            entry["handles"] = {name: _written(motion) for name, motion in key.state.items()}
        else:
            entry["weights"] = {name: float(weight) for name, weight in key.state.items()}
        keys.append(entry)
    content = {
        "format": FORMAT,
        "version": VERSION,
        "kind": timeline.kind,
        "loop": timeline.loop,
        "keys": keys,
    }
    target = as_path("write_timeline", path)
    with atomic_file(target) as temporary:
        temporary.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
    return target


def timeline_of(content: Any) -> Timeline:
    """The timeline of parsed JSON; ValueError as for `read_timeline`, without the file's name."""
    entries = as_object(content, "a timeline", known={"format", "version", "kind", "loop", "keys"})
    if entries.get("format") != FORMAT:
        raise ValueError(f"this is not a timeline: its format must be '{FORMAT}'")
    if entries.get("version") != VERSION:
        raise ValueError(
            f"the timeline has version {entries.get('version')}, but this Snapspace reads {VERSION}"
        )
    kind = as_text(entries.get("kind"), "kind")
    loop = entries.get("loop", False)
    if not isinstance(loop, bool):
        raise ValueError("loop must be true or false")
    found = as_list(entries.get("keys"), "keys")
    keys = tuple(_key(entry, f"keys[{number}]", kind) for number, entry in enumerate(found))
    return Timeline(kind, keys, loop)


def _key(entry: Any, place: str, kind: str) -> Key:
    states = "handles" if kind == "posing" else "weights"
    entries = as_object(entry, place, known={"time", "easing", states})
    given = as_object(entries.get(states), f"{place}.{states}")
    state: dict[str, Any] = {}
    for name, value in given.items():
        where = f"{place}.{states}['{name}']"
        state[name] = _motion(value, where) if kind == "posing" else as_number(value, where)
    time = as_number(entries.get("time"), f"{place}.time")
    return Key(time, state, as_text(entries.get("easing", "smooth"), f"{place}.easing"))


def _motion(value: Any, place: str) -> tuple[list[float], list[float]]:
    """Euler angles in radians and a translation."""
    entries = as_object(value, place, known={"degrees", "translation"})
    vectors = []
    for name in ("degrees", "translation"):
        what = f"{place}.{name}"
        items = as_list(entries.get(name, [0.0] * 3), what, items=("x", "y", "z"))
        vectors.append([as_number(item, what) for item in items])
    return np.deg2rad(vectors[0]).tolist(), vectors[1]


def _written(motion: Any) -> Mapping[str, list[float]]:
    euler, translation = (np.asarray(part, np.float64) for part in motion)
    if euler.shape != (3,) or translation.shape != (3,):
        raise ValueError("write_timeline: motions must be Euler angles and a translation")
    return {"degrees": np.rad2deg(euler).tolist(), "translation": translation.tolist()}
