"""Charts: points lie where their values put them."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from snapspace.pictures import Curve, chart

BLUE = np.array([31, 95, 168])


def drawn(*curves: Curve) -> NDArray[np.uint8]:
    return chart(curves, title="errors", x_name="d", y_name="error", size=(420, 320))


def dots(image: NDArray[np.uint8]) -> NDArray[np.float64]:
    """Pixels of the first colour outside the legend, (k, 2) as x and y."""
    y, x = np.nonzero((np.abs(image.astype(int) - BLUE) < 12).all(axis=2))
    inside = ~((y > 240) & (x < 120))
    return np.stack([x[inside], y[inside]], axis=1).astype(float)


def test_equal_ratios_are_equal_lengths() -> None:
    """A power law is a straight line in logarithms: the middle point is in the middle."""
    ends = dots(drawn(Curve("a", [1, 100], [1.0, 0.01])))
    middle = dots(drawn(Curve("a", [1, 10, 100], [1.0, 0.1, 0.01])))
    assert middle.mean(axis=0) == pytest.approx(ends.mean(axis=0), abs=2.0)
    low, high = ends[ends[:, 0].argmin()], ends[ends[:, 0].argmax()]
    assert high[1] > low[1], "small values are below large ones"


def test_the_same_curves_give_the_same_bytes() -> None:
    curves = [Curve("a", [1, 2], [3, 4], ["n", "m"]), Curve("b", [1, 2], [5, 6])]
    first, second = drawn(*curves), drawn(*curves)
    assert first.shape == (320, 420, 3) and first.dtype == np.uint8
    np.testing.assert_array_equal(first, second)
    assert (drawn(curves[0]) != first).any()


def test_ten_curves_have_their_names_beside_the_plot() -> None:
    curves = [Curve(f"curve {k}", [1, 10], [1.0 + k, 2.0 + k]) for k in range(10)]
    few, many = drawn(*curves[:4]), drawn(*curves)

    def frame_ends(image: NDArray[np.uint8]) -> int:
        dark = (image.astype(int).sum(axis=2) < 600).mean(axis=0)
        return int(np.flatnonzero(dark > 0.5).max())

    assert frame_ends(many) < frame_ends(few) - 40
    colors = {tuple(pixel) for pixel in many.reshape(-1, 3)}
    assert len(colors) > len({tuple(pixel) for pixel in few.reshape(-1, 3)})


def test_dashes_leave_half_of_the_line() -> None:
    whole = len(dots(drawn(Curve("a", [1, 100], [1.0, 0.01]))))
    dashed = len(dots(drawn(Curve("a", [1, 100], [1.0, 0.01], dashed=True))))
    assert 0.4 * whole < dashed < 0.8 * whole


def test_one_point_is_drawn() -> None:
    assert len(dots(drawn(Curve("a", [7], [0.1]))))


@pytest.mark.parametrize(
    ("curves", "message"),
    [
        ([], "got 0 curves"),
        ([Curve("a", [1], [1])] * 11, "got 11 curves, but it draws 1 to 10"),
        ([Curve("a", [1, 2], [1])], "'a' has 2 x and 1 y"),
        ([Curve("a", [], [])], "'a' has 0 x and 0 y"),
        ([Curve("a", [1, 0], [1, 1])], "'a' has a value that is not positive"),
        ([Curve("a", [1, 2], [1, np.nan])], "'a' has a value that is not positive"),
    ],
)
def test_curves_that_cannot_be_drawn_are_refused(curves: list[Curve], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        drawn(*curves)


def test_notes_stay_within_the_frame() -> None:
    """The note of the last point would cross it on the right."""
    ends = [1, 100], [1.0, 0.01]
    plain, noted = drawn(Curve("a", *ends)), drawn(Curve("a", *ends, ["d = 26", "d = 256"]))
    changed = (plain != noted).any(axis=(0, 2))
    dark = (plain.astype(int).sum(axis=2) < 600).mean(axis=0)
    assert 0 < np.flatnonzero(changed).max() < np.flatnonzero(dark > 0.5).max()
