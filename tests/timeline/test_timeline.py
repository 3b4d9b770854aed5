"""Timelines: which keys, when, and what files may say."""

from __future__ import annotations

import codecs
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from snapspace import (
    InterpolationModel,
    Key,
    PosingModel,
    Timeline,
    read_timeline,
    write_animation,
    write_timeline,
)

NOD = ((0.0, 0.0, 0.4), (0.0, 0.1, 0.2))
WAVE = Timeline(
    "posing",
    (
        Key(0.5, {"head": NOD}, "linear"),
        Key(1.5, {"belly": ((0.2, 0.0, 0.0), (0.0, 0.0, 0.1))}, "hold"),
        Key(2.0, {"head": ((0.0,) * 3, (0.0,) * 3)}),
    ),
    loop=True,
)


@given(st.lists(st.floats(0.01, 5.0), min_size=1, max_size=6), st.integers(2, 40))
def test_shares_run_through_all_keys_in_order(gaps: list[float], frames: int) -> None:
    times = np.cumsum([0.0, *gaps])
    timeline = Timeline("posing", tuple(Key(float(t), {}, "linear") for t in times))
    shares = list(timeline.shares(frames))
    assert shares[0] == (0, 0.0) and shares[-1] == (len(gaps), 0.0)
    reached = [key + share for key, share in shares]
    assert reached == sorted(reached)
    for frame, (key, share) in enumerate(shares[:-1]):
        at = times[key] + share * (times[key + 1] - times[key])
        assert at == pytest.approx(times[-1] * frame / (frames - 1), abs=1e-9)


def test_easings_hold_run_and_glide() -> None:
    def halfway(easing: str) -> float:
        keys = (Key(0.0, {}, easing), Key(1.0, {}))
        return list(Timeline("posing", keys).shares(5))[1][1]

    assert halfway("hold") == 0.0
    assert halfway("linear") == pytest.approx(0.25)
    assert halfway("smooth") == pytest.approx(3 * 0.25**2 - 2 * 0.25**3)


def test_a_session_is_at_each_key_at_its_time(posing_model: PosingModel) -> None:
    """A handle begins at rest, and stays where the previous key had it."""
    session, other = posing_model.session(), posing_model.session()
    session.move("belly", translation=(0.1, 0.0, 0.0))  # forgotten: a timeline begins with its key
    frames = [session.vertices for _ in session.animate(WAVE, frames=7)]  # every quarter second
    belly = WAVE.keys[1].state["belly"]
    expected = {
        0: {"head": NOD},
        4: {"head": NOD, "belly": belly},
        5: {"head": NOD, "belly": belly},
    }
    expected[6] = {"belly": belly}
    for frame, motions in expected.items():
        other.reset()
        other.move_all(motions)
        np.testing.assert_allclose(frames[frame], other.vertices, atol=1e-5)
    assert len(list(session.animate(WAVE))) == 46, "30 a second, both ends included"


def test_weights_are_named(blending_model: InterpolationModel) -> None:
    names = blending_model.problem.poses.names
    keys = (Key(0.0, {names[1]: 1.0}), Key(1.0, {names[0]: 0.25, names[2]: 0.75}))
    session = blending_model.session()
    frames = [session.vertices for _ in session.animate(Timeline("interpolation", keys), frames=3)]
    for frame, weights in ((0, [0.0, 1.0, 0.0]), (1, [0.125, 0.5, 0.375]), (2, [0.25, 0.0, 0.75])):
        session.blend(weights)
        np.testing.assert_allclose(frames[frame], session.vertices, atol=1e-5)
    wrong = Timeline("interpolation", (Key(0.0, {"nobody": 1.0}),))
    with pytest.raises(ValueError, match=r"animate: unknown pose 'nobody'; known are"):
        session.animate(wrong)
    with pytest.raises(ValueError, match=r"kind 'posing', but the model of 'interpolation'"):
        session.animate(WAVE)


def test_a_file_gives_the_timeline_back(tmp_path: Path) -> None:
    path = write_timeline(tmp_path / "wave.json", WAVE)
    path.write_bytes(codecs.BOM_UTF8 + path.read_bytes())  # as editors on Windows do
    again = read_timeline(path)
    assert (again.kind, again.loop, len(again.keys)) == ("posing", True, 3)
    for key, known in zip(again.keys, WAVE.keys, strict=True):
        assert (key.time, key.easing) == (known.time, known.easing)
        for name, motion in known.state.items():
            np.testing.assert_allclose(key.state[name], motion, atol=1e-15)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"format": "other"}, "not a timeline: its format must be 'snapspace-timeline'"),
        ({"version": 2}, "has version 2, but this Snapspace reads 1"),
        ({"kind": "film", "keys": [{"time": 0, "weights": {}}]}, "unknown kind 'film'; known are"),
        ({"loop": 1}, "loop must be true or false"),
        ({"keys": []}, "there are no keys"),
        ({"keys": [{"time": -1, "handles": {}}]}, "key 0 is at -1.0 s, but times are 0 or more"),
        ({"keys": [{"time": 1, "handles": {}}] * 2}, "key 1 is at 1.0 s, not after the one before"),
        ({"keys": [{"time": 0, "handles": {}, "easing": "soft"}]}, "has the easing 'soft'; known"),
        ({"keys": [{"time": 0, "weights": {}}]}, r"unknown entry 'weights'"),
        ({"keys": [{"time": "0", "handles": {}}]}, r"keys\[0\].time must be a number"),
        (
            {"keys": [{"time": 0, "handles": {"a": {"degrees": [1, 2]}}}]},
            r"keys\[0\].handles\['a'\].degrees must be \[x, y, z\]",
        ),
        ({"more": 0}, "unknown entry 'more'"),
    ],
)
def test_other_content_is_refused_by_its_place(
    tmp_path: Path, change: dict[str, Any], message: str
) -> None:
    content = {"format": "snapspace-timeline", "version": 1, "kind": "posing"}
    content |= {"keys": [{"time": 0, "handles": {}}], **change}
    path = tmp_path / "wrong.json"
    path.write_text(json.dumps(content))
    with pytest.raises(ValueError, match=message) as caught:
        read_timeline(path)
    assert str(path) in str(caught.value)


def test_what_is_no_json_is_refused(tmp_path: Path) -> None:
    for content in (b"{", b"\xff\xfe", b"[" * 100_000):
        (tmp_path / "a.json").write_bytes(content)
        with pytest.raises(ValueError, match=r"a\.json: this is not JSON"):
            read_timeline(tmp_path / "a.json")
    with pytest.raises(ValueError, match="there is no such file"):
        read_timeline(tmp_path / "b.json")


def test_frames_for_paraview_have_their_times(posing_model: PosingModel, tmp_path: Path) -> None:
    shapes = [posing_model.problem.mesh.vertices] * 3
    files = write_animation(
        tmp_path / "out", posing_model, shapes, kind="vtu", frames_per_second=4.0
    )
    series = json.loads((tmp_path / "out" / "frames.vtu.series").read_text())
    assert [entry["time"] for entry in series["files"]] == [0.0, 0.25, 0.5]
    assert [entry["name"] for entry in series["files"]] == [file.name for file in files]
