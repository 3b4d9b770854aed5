"""mirror_handle: the counterpart of a handle, its vertices and its bounds."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import (
    HandleBox,
    Handles,
    MirrorPlane,
    PosingProblem,
    counterparts,
    mirror_handle,
    mirrored_region,
)
from snapspace.generators import bar

from .bodies import PLANE, body, left_ear, one_ear, twins


def test_the_counterpart_has_the_mirror_images_of_the_vertices() -> None:
    problem = mirror_handle(one_ear(), "left ear")
    assert problem.handles.names == ("feet", "left ear", "right ear")
    assert problem.handles["right ear"].vertices.tolist() == sorted(twins()[left_ear()])
    assert problem.domain.bounds.tolist() == [[0.2] * 3 + [0.6] * 3] * 2
    assert counterparts(problem, PLANE) == (0, 2, 1)


def test_mirroring_back_is_the_same_problem() -> None:
    problem = mirror_handle(one_ear(), "left ear", plane=PLANE)
    assert mirror_handle(problem, "right ear", plane=PLANE).fingerprint == problem.fingerprint


def test_a_handle_of_that_name_is_replaced_and_others_lose_what_is_covered() -> None:
    image = np.sort(twins()[left_ear()])
    handles = one_ear().handles.adding("right ear", image[:3]).adding("horn", image[3:])
    with pytest.raises(ValueError, match="the mirror image of 'left ear' covers 'horn'; remove"):
        mirror_handle(one_ear().with_handles(handles), "left ear", plane=PLANE)
    free = np.setdiff1d(np.arange(len(body().vertices)), np.r_[image, handles["feet"].vertices])
    spare = np.setdiff1d(free, left_ear())[:2]
    wider = handles.replacing("horn", np.r_[image[3:], spare])
    found = mirror_handle(one_ear().with_handles(wider), "left ear", plane=PLANE).handles
    assert found.names == ("feet", "left ear", "right ear", "horn")
    assert found["right ear"].vertices.tolist() == image.tolist()
    assert found["horn"].vertices.tolist() == spare.tolist()


def test_own_bounds_are_mirrored_and_a_held_handle_stays_held() -> None:
    box = bar(6, 6, 2, length=1, width=1, height=0.3)
    x, y, _ = box.vertices.T
    ends = [x + y > 1.8, (x < 0.2) & (y < 0.3), (x > 0.8) & (y < 0.3)]
    handles = Handles(ends, names=["foot", "arm.L", "arm.R"])
    domain = HandleBox(
        translation=[(1, 1, 1), (0.1, 0.2, 0.3)], angle=[(1, 1, 1), (0.4, 0.5, 0.6)], moving=2
    )
    problem = PosingProblem(box, handles, domain=domain)
    center = box.vertices.mean(axis=0)
    across = mirror_handle(problem, "arm.R", plane=MirrorPlane((1, 0, 0), center))
    assert across.handles.names == ("foot", "arm.L", "arm.R")
    assert across.domain.bounds[0] == pytest.approx(domain.bounds[1])
    # the plane x = y swaps these axes
    swapped = mirror_handle(problem, "arm.R", plane=MirrorPlane((1, -1, 0), center))
    assert swapped.domain.bounds[0] == pytest.approx([0.2, 0.1, 0.3, 0.5, 0.4, 0.6])
    held = mirror_handle(problem, "foot", plane=MirrorPlane((0, 1, 0), center))
    assert held.handles.names[-1] == "foot mirrored"
    assert not held.domain.bounds[-1].any()


def test_common_bounds_stay_common_across_an_oblique_plane() -> None:
    problem = mirror_handle(one_ear(), "left ear", plane=MirrorPlane((0.05, 1, 0)))
    assert problem.domain.bounds.tolist() == [[0.2] * 3 + [0.6] * 3] * 2


def test_regions_follow_the_surface_where_triangles_differ() -> None:
    """A fine bar beside a coarse one: half of each is mirrored onto the other."""
    mesh = bar(9, 4, 4, length=1, width=1, height=1)
    vertices = mesh.vertices.copy()
    vertices[:, 0] **= 1.5  # thin layers at one end
    region = np.flatnonzero(vertices[:, 0] < 0.3)
    image = mirrored_region(vertices, mesh.surface, region, MirrorPlane((1, 0, 0), (0.5, 0, 0)))
    assert vertices[image, 0].min() > 0.6
    ends = np.flatnonzero(vertices[:, 0] == 1.0)
    assert np.isin(ends, image).all()


def test_a_region_smaller_than_the_triangles_is_not_lost() -> None:
    mesh = bar(9, 2, 2, length=1, width=1, height=1)
    vertices = mesh.vertices.copy()
    vertices[:, 0] **= 3
    one = np.flatnonzero((vertices[:, 0] > 0) & (vertices[:, 0] < 0.002))[:1]
    image = mirrored_region(vertices, mesh.surface, one, MirrorPlane((1, 0, 0), (0.5, 0, 0)))
    assert len(image) == 1 and vertices[image[0], 0] == 1.0


@pytest.mark.parametrize(
    ("region", "message"),
    [
        ([], "needs at least one vertex index"),
        ([0.5], "needs at least one vertex index"),
        ([-1], "has vertex index -1, but there are 27 vertices"),
        ([3, 27], "has vertex index 27"),
    ],
)
def test_bad_regions_are_refused(region: list[float], message: str) -> None:
    mesh = bar(2, 2, 2, length=1, width=1, height=1)
    with pytest.raises(ValueError, match=f"mirrored_region: the region {message}"):
        mirrored_region(mesh.vertices, mesh.surface, region, PLANE)


def test_counterparts_need_the_same_place_and_are_mutual() -> None:
    problem = mirror_handle(one_ear(), "left ear", plane=PLANE)
    head = np.flatnonzero((body().vertices[:, 0] > 0.9) & (body().vertices[:, 2] > 1.2))
    taken = np.concatenate([handle.vertices for handle in problem.handles])
    more = problem.with_handles(problem.handles.adding("head", np.setdiff1d(head, taken)))
    assert counterparts(more, PLANE) == (0, 2, 1, 3)
    assert counterparts(one_ear(), PLANE) == (0, None)
    assert counterparts(problem, MirrorPlane((0, 1, 0), (0, 9, 0))) == (None, None, None)


def test_names_of_sides_make_counterparts_of_handles_of_different_size() -> None:
    tip = left_ear()[np.argmax(body().vertices[left_ear(), 2])]
    ears = mirror_handle(one_ear(), "left ear", plane=PLANE)

    def named(name: str) -> PosingProblem:
        regions = [*(handle.vertices for handle in ears.handles)]
        return ears.with_handles(Handles([*regions[:2], [twins()[tip]]], names=["feet", "L", name]))

    assert counterparts(named("horn"), PLANE) == (0, None, None)
    assert counterparts(named("R"), PLANE) == (0, 2, 1)
    # across this plane they are on the same side
    assert counterparts(named("R"), MirrorPlane((0, 0, 1))) == (0, None, None)


def test_what_cannot_be_mirrored_is_refused() -> None:
    with pytest.raises(ValueError, match="'feet' lies across the mirror plane and is its own"):
        mirror_handle(one_ear(), "feet", plane=PLANE)
    with pytest.raises(ValueError, match="there is no handle 'ear'; the handles are feet, left"):
        mirror_handle(one_ear(), "ear", plane=PLANE)
