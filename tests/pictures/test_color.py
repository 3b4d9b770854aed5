"""Colour spaces, colour maps and tinted regions."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.pictures import colormap, tint
from snapspace.pictures.color import from_oklab, to_linear, to_oklab, to_srgb
from snapspace.pictures.colormap import ACCENTS, CLAY


def test_srgb_follows_its_standard():
    known = [(0.0, 0.0), (0.04045, 0.0031308), (0.5, 0.21404114), (1.0, 1.0)]
    for encoded, linear in known:
        assert to_linear(encoded) == pytest.approx(linear, abs=1e-7)
    value = np.linspace(0, 1, 101)
    np.testing.assert_allclose(to_srgb(to_linear(value)), value, atol=1e-7)


def test_oklab_of_grey_has_no_chroma_and_from_oklab_is_the_inverse():
    grey = to_oklab([(0.5, 0.5, 0.5), (1.0, 1.0, 1.0)])
    np.testing.assert_allclose(grey[:, 1:], 0.0, atol=1e-4)
    assert grey[1, 0] == pytest.approx(1.0, abs=1e-4)
    colors = np.random.default_rng(0).uniform(size=(50, 3))
    np.testing.assert_allclose(from_oklab(to_oklab(colors)), colors, atol=1e-6)


@pytest.mark.parametrize("palette", ["terracotta", "teal"])
def test_lightness_falls_strictly_with_the_value(palette):
    lightness = to_oklab(colormap(np.linspace(-3, 8, 400), palette=palette))[:, 0]
    assert np.all(np.diff(lightness) < 0.0)


def test_diverging_is_lightest_at_zero_and_darkens_to_both_sides():
    lightness = to_oklab(colormap(np.linspace(-2, 2, 401), palette="diverging"))[:, 0]
    assert np.argmax(lightness) == 200
    assert np.all(np.diff(lightness[:201]) > 0.0)
    assert np.all(np.diff(lightness[200:]) < 0.0)


@pytest.mark.parametrize("palette", ["terracotta", "teal", "diverging"])
def test_equal_steps_of_value_are_about_equal_steps_to_the_eye(palette):
    lab = to_oklab(colormap(np.linspace(0, 1, 201), palette=palette, limits=(0.0, 1.0)))
    step = np.linalg.norm(np.diff(lab, axis=0), axis=1)
    assert step.max() < 2.0 * step.min()


def test_values_beyond_the_limits_keep_the_end_colours():
    ends = colormap([0.0, 1.0], limits=(0.0, 1.0))
    np.testing.assert_array_equal(colormap([-5.0, 9.0], limits=(0.0, 1.0)), ends)


def test_a_constant_field_has_one_colour_and_an_empty_one_none():
    assert len(np.unique(colormap([3.0, 3.0, 3.0]), axis=0)) == 1
    assert colormap([]).shape == (0, 3)


@pytest.mark.parametrize(
    ("values", "options", "message"),
    [
        ([0.0, np.nan], {}, r"colormap: value 1 is nan; every value must be finite"),
        ([[1.0]], {}, r"colormap: values has shape \(1, 1\); give one scalar per vertex"),
        ([1.0], {"palette": "jet"}, r"no palette 'jet'; choose one of terracotta, teal"),
        ([1.0], {"limits": (1.0, 1.0)}, r"limits are \(1.0, 1.0\); give \(low, high\)"),
    ],
)
def test_colormap_refuses(values, options, message):
    with pytest.raises(ValueError, match=message):
        colormap(values, **options)


def test_tint_colours_regions_and_leaves_the_rest():
    colors = tint(6, [[0, 1], np.array([4])])
    np.testing.assert_array_equal(colors[[0, 1]], [ACCENTS[0]] * 2)
    np.testing.assert_array_equal(colors[4], ACCENTS[1])
    np.testing.assert_array_equal(colors[[2, 3, 5]], [CLAY] * 3)


def test_tint_repeats_its_accents():
    colors = tint(3, [[0], [1], [2]], accents=[(1, 0, 0), (0, 1, 0)])
    np.testing.assert_array_equal(colors[2], (1, 0, 0))


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        ((3, [[3]]), {}, r"tint: region 0 has vertex index 3, but there are 3 vertices"),
        ((3, [[0], [-1]]), {}, r"tint: region 1 has vertex index -1"),
        ((3, [[0]]), {"base": (2.0, 0, 0)}, r"tint: base is .*between 0 and 1"),
        ((3, [[0]]), {"accents": []}, r"tint: accents is empty"),
    ],
)
def test_tint_refuses(arguments, options, message):
    with pytest.raises(ValueError, match=message):
        tint(*arguments, **options)
