"""Meshes that are dropped on a page."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from snapspace.generators import bar
from snapspace.mesh import compact_surface, write_surface

from .running import Running

ORDER = {"target_error": 0.5, "most_samples": 24, "seed": 0, "stiffness": 1000.0}


@pytest.fixture(scope="module")
def empty() -> Iterator[Running]:
    server = Running("--upload-limit", "1")
    yield server
    server.kill()


def test_a_surface_is_dropped_filled_and_used(empty: Running, tmp_path: Path) -> None:
    thin = bar(16, 1, 1, width=0.25, height=0.25)  # few tets, quickly filled
    write_surface(tmp_path / "bar.ply", thin.vertices, thin.surface)
    content = (tmp_path / "bar.ply").read_bytes()
    with empty.page() as page:
        state = page.take("workspace")
        assert (state["kind"], state["mesh"], state["upload_limit"]) == ("empty", None, 2**20)
        assert empty.upload(state["id"], "../b/drop me.ply", content) == (202, "")
        state = page.workspace()
        assert (state["kind"], state["name"]) == ("mesh", "drop me")
        stages = [m["stage"] for m in page.seen if m["type"] == "progress"]
        assert stages[-1].startswith("filling")
        shown = empty.fetch(state["mesh"])
        vertices, faces = compact_surface(thin.vertices, thin.surface)
        np.testing.assert_allclose(shown["vertices"], vertices, atol=1e-6)
        assert np.array_equal(shown["faces"], faces), "the user's own surface"
        x = shown["vertices"][:, 0]
        handles = [
            {"name": "foot", "vertices": np.flatnonzero(x < 0.2).tolist(), "moving": False},
            {"name": "head", "vertices": np.flatnonzero(x > 3.8).tolist()},
        ]
        ranges = {"translation": state["translation"], "angle": state["angle"]}
        far = [*handles, {"name": "far", "vertices": [len(vertices)]}]
        page.send("choose", request=7, handles=far, **ranges)
        assert "'far' has vertex index" in page.take("failed")["message"]
        page.ask("choose", "chosen", handles=handles, **ranges)
        page.send("compute", **{**ORDER, "stiffness": state["stiffness"], "poisson": 0.4})
        model = page.take("model", "failed")
        assert model["type"] == "model"
        packed = empty.fetch(model["address"])
        assert np.array_equal(packed["faces"], faces)
        np.testing.assert_allclose(packed["base"].reshape(-1, 3), vertices, atol=1e-6)
        assert (packed["handle_of_vertex"][x < 0.2] == 0).all()
        assert (packed["handle_of_vertex"][x > 3.8] == 1).all()


def test_filling_is_cancelled_and_the_workspace_is_empty_again(
    empty: Running, tmp_path: Path
) -> None:
    # the finest surface below the limit takes seconds
    fine = bar(24, 12, 12)
    write_surface(tmp_path / "fine.stl", fine.vertices, fine.surface)
    with empty.page() as page:
        state = page.take("workspace")
        assert empty.upload(state["id"], "fine.stl", (tmp_path / "fine.stl").read_bytes())[0] == 202
        while page.take("progress")["stage"] != "filling":
            pass
        page.send("compute", **ORDER)
        assert "wait until it is read" in page.take("failed")["message"]
        page.ask("cancel", "cancelled", request=3)
        kinds = [m["kind"] for m in page.seen if m["type"] == "workspace"]
        while kinds[-1] != "empty":  # the server does not wait for filling that is slow to stop
            kinds.append(page.take("workspace")["kind"])


def test_uploads_that_are_not_meshes_are_refused(empty: Running) -> None:
    with empty.page() as page:
        state = page.take("workspace")
        status, text = empty.upload(state["id"], "x.obj", b"0" * (2**20 + 1))
        assert status == 413 and "more than 1 MB; raise --upload-limit" in text
        # far more than a socket's buffer: the answer is lost if the server stops reading
        assert empty.upload(state["id"], "x.exe", bytes(2**25))[0] == 415
        chunks = (bytes(2**16) for _ in range(2**9))
        assert empty.upload(state["id"], "x.obj", chunks)[0] == 413
        assert empty.upload(state["id"], "x.exe", b"0")[0] == 415
        assert empty.upload("another", "x.obj", b"0")[0] == 404
        assert empty.upload(state["id"], "x.obj", b"hello")[0] == 202
        assert page.take("failed") == {
            "type": "failed",
            "request": 0,
            "message": "x.obj: it has no faces (0 vertices)",
        }
        page.send("save", request=4)
        assert "there is no mesh yet" in page.take("failed")["message"]
