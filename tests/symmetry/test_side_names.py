"""mirrored_name: left becomes right, and back."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from snapspace import mirrored_name


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("left ear", "right ear"),
        ("ear_left", "ear_right"),
        ("LeftEar", "RightEar"),
        ("earLeft", "earRight"),
        ("LEFT-EAR", "RIGHT-EAR"),
        ("front left leg", "front right leg"),
        ("ear.L", "ear.R"),
        ("ear.l", "ear.r"),
        ("ear_l", "ear_r"),
        ("ear-L", "ear-R"),
        ("ear L", "ear R"),
        ("L_ear", "R_ear"),
        ("l.ear", "r.ear"),
        ("ear.L.001", "ear.R.001"),
        ("L", "R"),
        ("tail", "tail mirrored"),
        ("bright", "bright mirrored"),
        ("leftover", "leftover mirrored"),
        ("reel", "reel mirrored"),
    ],
)
def test_names_of_sides(left: str, right: str) -> None:
    assert mirrored_name(left) == right
    assert mirrored_name(right) == left


WORDS = st.sampled_from(
    ["left", "Right", "LEFT", "l", "R", "ear", "bright", "mirrored", " ", "_", ".", "-", "001", "ß"]
)


@given(st.lists(WORDS, min_size=1, max_size=6).map("".join).filter(str.strip))
def test_mirroring_twice_gives_the_name_itself(name: str) -> None:
    assert mirrored_name(name) != name
    assert mirrored_name(mirrored_name(name)) == name
