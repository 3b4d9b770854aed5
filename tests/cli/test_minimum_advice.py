"""Advice where frames are at other minima than full solutions."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from snapspace import ErrorSplit
from snapspace.cli.advice import Advice
from snapspace.validation import NextOption

SHARES = {name: np.full(5, 0.01) for name in ErrorSplit.__dataclass_fields__}
OPTION = NextOption("stiffness", 120, 40, None)


@pytest.mark.parametrize("part", ["minimum", "stiffness"])
def test_the_minimum_is_named_only_where_it_is_the_largest_part(
    part: str, capsys: pytest.CaptureFixture[str]
) -> None:
    split = replace(ErrorSplit(**SHARES), **{part: np.full(5, 0.4)})
    Advice(split, OPTION, ["build"]).print_notices()
    told = " ".join(capsys.readouterr().err.split())
    assert ("most frames are not near the full solution" in told) == (part == "minimum")
    assert f"{part} 40 %" in told
