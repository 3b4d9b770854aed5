"""A page that returns finds its work; one that stays away leaves nothing behind."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import Request, urlopen

import pytest
from websockets.exceptions import ConnectionClosed

from snapspace import InterpolationModel, PosingModel
from snapspace.server import workspace as module
from snapspace.server.body import Body
from snapspace.server.settings import PageTimeouts
from snapspace.server.shared_body import SharedBody

from ..shapes import bar_problem
from .in_process import socket, started
from .running import Page

KEPT = {
    "translation": [0.1, 0.2, 0.3],
    "angle": [0.4, 0.5, 0.6],
    "target_error": 0.02,
    "most_samples": 50,
    "stiffness": 70.0,
    "material": "arap",
    "poisson": 0.4,
    "up": "x",
}
HANDLES = [{"name": "späť", "vertices": [1, 2, 5], "moving": True, "translation": None}]
PARTS = [{"name": "bone", "vertices": [3, 4], "factor": 10.0}]
LONG = {"target_error": 1e-9, "most_samples": 20_000, "seed": 0, "stiffness": 100.0}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("workspaces")


@pytest.fixture(scope="module")
def address(folder: Path) -> Iterator[str]:
    problem = bar_problem()
    body = Body(name="bar", mesh=problem.mesh, file=None, folder=folder, problem=problem)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(PageTimeouts.__init__, "__kwdefaults__", {"alone": 1.0, "waited_for": 0.2})
        yield started(body=SharedBody(lambda stage: body), folder=folder)


def test_a_page_that_returns_finds_its_choices_and_its_computation(address: str) -> None:
    with socket(address) as first:
        page = Page(first)
        before = page.workspace()
        assert (before["job"], before["is_running"], before["parts"]) == (0, False, [])
        page.send("keep", request=2, handles=HANDLES, parts=PARTS, **KEPT)
        page.send("compute", request=41, **LONG)
        model = page.take("model", "failed")
    with socket(address, before["id"]) as second:
        page = Page(second)
        again = page.take("workspace")
        assert again["id"] == before["id"] and again["mesh"] == before["mesh"]
        assert again["handles"] == [{**HANDLES[0], "angle": None}]
        assert again["parts"] == PARTS
        assert {name: again[name] for name in KEPT} == KEPT | {"poisson": before["poisson"]}
        assert again["own_poisson"] == KEPT["poisson"]
        assert (again["job"], again["is_running"]) == (41, True)
        latest = page.take("model")
        assert latest["request"] == 41 and latest["number"] >= model["number"]
        assert page.take("progress")["request"] == 41, "it continues"
        page.ask("cancel", "cancelled", request=42)
    with socket(address, before["id"]) as third:
        again = Page(third).take("workspace")
        assert (again["job"], again["is_running"]) == (41, False)


def test_another_page_takes_a_workspace_over(address: str) -> None:
    with socket(address) as first:
        id = Page(first).workspace()["id"]
        with socket(address, id) as second:
            assert Page(second).workspace()["id"] == id
            with pytest.raises(ConnectionClosed) as closed:
                while True:
                    first.recv(timeout=30)
            assert closed.value.rcvd is not None and closed.value.rcvd.code == 4001
            page = Page(second)
            page.ask("cancel", "cancelled", request=3)


def test_a_page_that_stays_away_is_forgotten(address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    closed, gone = threading.Event(), list[str]()
    close = module.Workspace.close

    def recorded(workspace: module.Workspace) -> None:
        close(workspace)
        if workspace.id in gone:
            closed.set()

    monkeypatch.setattr(module.Workspace, "close", recorded)
    with socket(address) as first:
        id = Page(first).workspace()["id"]
        gone.append(id)
    begin = time.monotonic()
    assert closed.wait(30) and time.monotonic() - begin > 0.5
    with socket(address, id) as second:
        assert Page(second).workspace()["id"] != id


def test_no_page_waits_long_for_a_closed_one(address: str) -> None:
    with socket(address) as second:
        page = Page(second)
        page.workspace()
        with socket(address) as first:
            other = Page(first)
            other.workspace()
            other.send("compute", request=1, **LONG)
            other.take("progress")
        page.send("compute", request=1, **LONG)
        begin = time.monotonic()
        page.take("model", "failed")
        assert any(message.get("stage") == "waiting" for message in page.seen)
        assert time.monotonic() - begin < 20


def test_handles_are_chosen_on_the_body_of_a_model(posing_model: PosingModel, folder: Path) -> None:
    address = started(model=posing_model, folder=folder)
    with socket(address) as opened:
        page = Page(opened)
        assert page.take("workspace")["kind"] == "model"
        page.send("edit")
        workspace = page.workspace()
        assert workspace["kind"] == "mesh" and workspace["folder"] == str(folder)
        problem = posing_model.problem
        for handle, own in zip(workspace["handles"], problem.handles, strict=True):
            assert handle["name"] == own.name and handle["vertices"] == own.vertices.tolist()
        model = page.take("model")
        assert (model["request"], model["final"]) == (0, True), "it can be posed again"
        assert model["dimension"] == posing_model.dimension
        upload = posing_model.save(folder / "other.snapspace")
        where = urlsplit(address)
        url = f"http://{where.netloc}/mesh?workspace={workspace['id']}&name=other.snapspace"
        urlopen(Request(f"{url}&{where.query}", data=upload.read_bytes()), timeout=30).close()
        again = page.workspace()
        assert (again["kind"], again["name"]) == ("mesh", "other")
        assert json.dumps(again["handles"]) == json.dumps(workspace["handles"])
        assert page.take("model")["number"] > model["number"]
    with socket(address, workspace["id"]) as second:  # the page is reloaded
        page = Page(second)
        assert page.take("workspace")["has_model"] and page.take("model")["request"] == 0


def test_handles_on_a_pose_are_saved_without_the_model_that_blends(
    blending_model: InterpolationModel, tmp_path: Path
) -> None:
    with socket(started(model=blending_model, folder=tmp_path)) as opened:
        page = Page(opened)
        assert page.take("workspace")["kind"] == "model"
        page.send("edit")
        workspace = page.workspace()
        assert page.take("model")["final"], "it can be blended again"
        bounds = {name: workspace[name] for name in ("translation", "angle")}
        ends = [
            {"name": name, "vertices": vertices, "moving": name == "head"}
            for name, vertices in (("foot", [0, 1, 2]), ("head", [6, 7, 8]))
        ]
        page.ask("choose", "chosen", request=2, handles=ends, **bounds)
        saved = page.ask("save", "saved", request=3)
        assert Path(saved["problem"]).is_file() and saved["model"] is None
