"""Pictures: what they show, what they leave alone, and what they refuse."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace.pictures import render, render_row
from snapspace.pictures.backdrop import backdrop, to_bytes, tone
from snapspace.pictures.row import _corner

SMALL = (64, 48)


def test_background_is_untouched_outside_the_silhouette(sphere):
    image = render(*sphere, size=SMALL, ground=False)
    paper = to_bytes(backdrop(*SMALL))
    y, x = np.mgrid[:48, :64] + 0.5
    away = np.hypot(x - 32, y - 24)
    outside = away > 24 * 0.9 + 1
    assert np.array_equal(image[outside], paper[outside])
    assert np.all((image[away < 20] != paper[away < 20]).any(axis=1))


def test_the_ground_only_darkens_and_only_near_the_shape(sphere):
    grounded = render(*sphere, size=SMALL, elevation=8.0).astype(int)
    paper = to_bytes(backdrop(*SMALL)).astype(int)
    y, x = np.mgrid[:48, :64] + 0.5
    outside = np.hypot(x - 32, y - 24) > 24 * 0.9 + 1
    assert np.all(grounded[outside] <= paper[outside])
    assert (paper - grounded)[outside].max() > 30
    sky = outside & (y < 12.0)
    assert np.array_equal(grounded[sky], paper[sky])


def test_the_same_input_gives_the_same_bytes(sphere):
    first, second = (render(*sphere, size=SMALL) for _ in range(2))
    assert np.array_equal(first, second)


def test_size_and_place_of_the_mesh_do_not_matter(sphere):
    vertices, faces = sphere
    one = render(vertices, faces, size=SMALL).astype(int)
    two = render(vertices * 2.0**12 + 2.0**14, faces, size=SMALL).astype(int)
    assert np.abs(one - two).max() <= 2


@pytest.mark.parametrize(("up", "order"), [("y", [1, 2, 0]), ("x", [2, 0, 1])])
def test_the_up_axis_is_a_change_of_names(box, up, order):
    vertices, faces = box[0] * (1.0, 2.0, 0.7), box[1]
    expected = render(vertices, faces, size=SMALL).astype(int)
    renamed = render(vertices[:, order], faces, size=SMALL, up=up).astype(int)
    # Shadow maps are laid out along other axes: only their texels differ.
    assert np.abs(expected - renamed).mean() < 1.0


def test_colours_are_those_given(sphere):
    vertices, faces = sphere
    colors = np.where(vertices[:, 2:] > 0.0, (0.8, 0.2, 0.2), (0.2, 0.2, 0.8))
    image = render(vertices, faces, size=SMALL, elevation=0.0, colors=colors, ground=False)
    upper, lower = image[12, 32].astype(int), image[36, 32].astype(int)
    assert upper[0] > upper[2] + 40
    assert lower[2] > lower[0] + 40
    one = render(vertices, faces, size=SMALL, colors=(0.2, 0.7, 0.2))
    assert np.argmax(one[24, 32]) == 1


def test_vertices_without_faces_are_ignored(box):
    vertices, faces = box
    stray = np.vstack([vertices, (np.nan, 0.0, 1e9), (50.0, 0.0, 0.0)])
    options = {"size": SMALL, "ground": False}
    assert np.array_equal(render(stray, faces, **options), render(vertices, faces, **options))


def test_a_flat_mesh_seen_on_edge_is_drawn_without_complaint():
    vertices = np.array([(0.0, 0, 0), (1, 0, 0), (0, 1, 0)])
    image = render(vertices, [(0, 1, 2)], size=SMALL, elevation=0.0, ground=False)
    assert np.array_equal(image, to_bytes(backdrop(*SMALL)))


def test_one_colour_as_background(box):
    image = render(*box, size=SMALL, background=(1.0, 1.0, 1.0), ground=False)
    assert np.all(image[0] == 255)


def test_tone_is_the_identity_for_shades_and_never_reaches_white():
    light = np.linspace(0, 4, 1000)
    assert np.array_equal(tone(light)[light < 0.7], light[light < 0.7])
    assert np.all(np.diff(tone(light)) > 0.0)
    assert tone(light).max() < 1.0


BAD_MESHES = [
    ({"vertices": np.zeros((3, 2))}, r"render: vertices has shape \(3, 2\); give positions"),
    ({"vertices": [["a", "b", "c"]]}, r"render: vertices are not numbers"),
    ({"vertices": [(0, 0, 0), (1, np.nan, 0), (0, 1, 0)]}, r"render: vertex 1 is \[1.0, nan"),
    ({"vertices": np.zeros((3, 3))}, r"render: the mesh has size 0.0; there is nothing to draw"),
    ({"faces": np.zeros((0, 3), int)}, r"render: the mesh has no faces"),
    ({"faces": [(0, 1, 3)]}, r"render: face 0 is \[0, 1, 3\], but vertices has 3 rows"),
    ({"faces": [(0, 1, 2), (-1, 0, 1)]}, r"render: face 1 is \[-1, 0, 1\], but vertices has"),
    ({"faces": [(0.0, 1.0, 2.0)]}, r"render: faces has type float64; give integer"),
    ({"faces": [(0, 1, 2, 0)]}, r"render: faces has shape \(1, 4\); give triangles"),
    ({"size": (0, 10)}, r"render: size is \(0, 10\); give \(width, height\)"),
    ({"size": (10.5, 10)}, r"render: size is \(10.5, 10\)"),
    ({"size": 10}, r"render: size is 10; give"),
    ({"colors": np.zeros((2, 3))}, r"render: colors has shape \(2, 3\); give one colour"),
    ({"colors": np.full((3, 3), 255)}, r"render: colour 0 is .*divide bytes by 255"),
    ({"colors": (0.1, np.nan, 0.1)}, r"render: colors is .*between 0 and 1"),
    ({"colors": "teal"}, r"render: colors are not numbers"),
    ({"background": "white"}, r"render: background is 'white'; give three sRGB values"),
    ({"background": (0.1, 0.1)}, r"render: background is .*three sRGB values"),
    ({"samples": 0}, r"render: samples is 0; give a whole number from 1 to 8"),
    ({"up": "up"}, r"Camera: up is 'up'"),
    ({"azimuth": float("nan")}, r"Camera: azimuth is nan"),
]


@pytest.mark.parametrize(("change", "message"), BAD_MESHES)
def test_bad_input_is_refused(change, message):
    good = {"vertices": [(0, 0, 0), (1, 0, 0), (0, 1, 0)], "faces": [(0, 1, 2)], "size": SMALL}
    with pytest.raises(ValueError, match=message):
        render(**{**good, **change})


def test_a_row_shows_all_shapes_at_one_scale(sphere):
    vertices, faces = sphere
    options = {"size": (60, 60), "ground": False, "background": (0.0, 0.0, 0.0), "samples": 2}
    sheet = render_row([vertices, 0.5 * vertices], faces, **options)
    assert sheet.shape == (60, 120, 3)
    big, small = (np.count_nonzero(sheet[:, s].any(axis=2)) for s in (slice(0, 60), slice(60, 120)))
    # Both silhouettes are circles; the smaller one is a little farther from the eye.
    assert small / big == pytest.approx(0.25, abs=0.03)
    assert np.array_equal(sheet[:, :60], render(vertices, faces, **options))


def test_a_row_has_its_captions_below_the_shapes_and_seamless_paper(box):
    vertices, faces = box
    options = {"size": (80, 60), "samples": 1, "ground": False}
    sheet = render_row([vertices] * 3, faces, labels=["rest", "", "bent"], columns=2, **options)
    strip = sheet.shape[0] // 2 - 60
    assert sheet.shape[1] == 160
    paper = to_bytes(backdrop(160, sheet.shape[0]))
    first, second = sheet[60 : 60 + strip, :80], sheet[60 : 60 + strip, 80:]
    assert first.min() < 90
    assert np.array_equal(second, paper[60 : 60 + strip, 80:])
    assert np.array_equal(sheet[0], paper[0])


def test_shadows_of_a_row_cross_the_cells_without_a_seam(sphere):
    vertices, faces = sphere
    sheet = render_row([vertices, vertices], faces, size=(48, 48), margin=0.3, samples=1)
    seam = sheet[:, 47:49].astype(int)
    assert np.abs(seam[:, 1] - seam[:, 0]).max() <= 6
    assert (to_bytes(backdrop(96, 48))[:, 47].astype(int) - seam[:, 0]).max() > 10


def test_a_last_row_that_is_not_full_is_centred():
    assert [_corner(i, 3, 5, 100, 50) for i in range(5)] == [
        (0, 0),
        (100, 0),
        (200, 0),
        (50, 50),
        (150, 50),
    ]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"shapes": []}, r"render_row: shapes is empty"),
        ({"labels": ["one"]}, r"render_row: 1 labels for 2 shapes"),
        ({"labels": "ab"}, r"render_row: 2 labels for 2 shapes; give a list"),
        ({"columns": 0}, r"render_row: columns is 0"),
        ({"font_size": 1}, r"render_row: font_size is 1"),
        ({"shapes": [np.eye(3), np.eye(4)[:, :3]]}, r"render_row: shape 1 has 4 vertices"),
        ({"shapes": [np.eye(3), np.full((3, 3), np.inf)]}, r"render_row: vertex 0 is \[inf"),
        ({"colors": [None, np.zeros((7, 3))]}, r"render_row: colors has shape \(7, 3\)"),
    ],
)
def test_a_bad_row_is_refused(change, message):
    good = {"shapes": [np.eye(3), np.eye(3)], "faces": [(0, 1, 2)], "size": SMALL}
    with pytest.raises(ValueError, match=message):
        render_row(**{**good, **change})
