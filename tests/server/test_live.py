"""Real servers and websockets: from handles to models, and what may interrupt them."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus

from snapspace import HandleBox, Handles, PosingProblem, load, read_problem, write_tets
from snapspace.generators import bar
from snapspace.problem import problem_content

from .running import PATIENCE, Message, Page, Running

MESH = bar(16, 3, 3)
ENDS = {"foot": MESH.vertices[:, 0] < 0.1, "head": MESH.vertices[:, 0] > 3.9}
REST = {"rotation": [1, 0, 0, 0, 1, 0, 0, 0, 1], "translation": [0, 0, 0]}
LONG = {"target_error": 1e-9, "most_samples": 20_000, "seed": 0, "stiffness": 1000.0}
SHORT = {"target_error": 0.5, "most_samples": 24, "seed": 0, "stiffness": 1000.0}


def running(*arguments: str | Path) -> Iterator[Running]:
    server = Running(*arguments)
    yield server
    server.kill()


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("live")
    write_tets(folder / "mesh.msh", MESH)
    problem = PosingProblem(
        MESH,
        Handles(list(ENDS.values()), names=list(ENDS)),
        domain=HandleBox(translation=0.4, angle=0.5),
    )
    (folder / "bar.json").write_text(json.dumps(problem_content(problem, "mesh.msh")))
    return folder


@pytest.fixture(scope="module")
def server(folder: Path) -> Iterator[Running]:
    yield from running(folder / "bar.json")


@pytest.fixture
def page(server: Running) -> Iterator[Page]:
    with server.page() as opened:
        yield opened


def first_stage(page: Page) -> Message:
    """The first progress message that counts a solved sample."""
    while (progress := page.take("progress", "failed")).get("done") == 0:
        pass
    return progress


def test_a_page_begins_with_the_problem_of_the_file(
    server: Running, page: Page, folder: Path
) -> None:
    workspace = page.workspace()
    assert (workspace["kind"], workspace["name"]) == ("mesh", "bar")
    assert workspace["folder"] == str(folder)
    assert workspace["translation"] == [0.4] * 3 and workspace["angle"] == pytest.approx([0.5] * 3)
    assert workspace["diagonal"] == pytest.approx(MESH.diagonal)
    for handle, (name, mask) in zip(workspace["handles"], ENDS.items(), strict=True):
        assert handle["name"] == name and handle["moving"] == (name == "head")
        assert handle["vertices"] == np.flatnonzero(mask).tolist()
    arrays = server.fetch(workspace["mesh"])
    np.testing.assert_array_equal(arrays["vertices"], MESH.vertices.astype(np.float32))
    np.testing.assert_array_equal(arrays["faces"], MESH.surface)


def test_models_arrive_and_improve(server: Running, page: Page) -> None:
    page.workspace()
    page.send("compute", request=5, **SHORT)
    models = [page.take("model", "failed"), page.take("model", "failed")]
    assert [model["final"] for model in models] == [False, True], models
    assert [model["number"] for model in models] == [1, 2]
    assert [model["samples"] for model in models] == [20, 24], "the training samples, and four more"
    assert models[0]["error"] is None, "no test sample has judged it"
    assert 0 < models[1]["error"] < SHORT["target_error"]
    for model in models:
        assert model["request"] == 5
        assert len(server.fetch(model["address"])["space_scales"]) == model["dimension"]
    stages = [message["stage"] for message in page.seen if message["type"] == "progress"]
    assert list(dict.fromkeys(stages)) == ["snapshots", "subspace", "energy"]
    page.send("export", request=6, model=2)
    address = page.take("exported", "failed")["address"].split("?")[0]
    status, text = server.get(f"/{address}")
    assert status == 200 and text.count(b'<script id="model"') == 1, "a page with the model"
    status, text = server.get(f"/{address[:-1]}1")
    assert status == 404, "only the last one is kept"
    page.send("export", request=7, model=9)
    assert "no longer kept" in page.take("exported", "failed")["message"]
    page.send("export", request=8, model=2, timeline="{")
    assert "not JSON" in page.take("exported", "failed")["message"]
    status, text = server.get(f"/model/{models[0]['address'].split('/')[1]}/9")
    assert status == 404 and b"no longer kept" in text


def test_chosen_handles_are_answered_in_the_models_order(server: Running, page: Page) -> None:
    workspace = page.workspace()
    foot, head = workspace["handles"]
    ranges = {"translation": workspace["translation"], "angle": workspace["angle"]}
    chosen = page.ask("choose", "chosen", request=2, handles=[head, foot], **ranges)
    assert chosen["handles"] == ["foot", "head"]
    page.send("choose", request=3, handles=[{**foot, "moving": True}, head], **ranges)
    refused = page.take("failed", "chosen")
    assert refused["request"] == 3 and "mark one as fixed" in refused["message"]
    page.send("compute", request=4, **SHORT)
    assert page.take("model", "failed")["type"] == "model", "the last good choice still holds"


def test_cancel_keeps_solved_samples(server: Running, page: Page) -> None:
    page.workspace()
    page.send("compute", request=1, **LONG)
    model = page.take("model", "failed")
    first_stage(page)
    begin = time.perf_counter()
    page.ask("cancel", "cancelled", request=2)
    assert time.perf_counter() - begin < 2.0  # about 0.1 s on an idle machine
    assert server.fetch(model["address"])["space_scales"].size == model["dimension"]
    page.seen.clear()
    page.send("compute", request=3, **SHORT)
    better = page.take("model", "failed")
    assert better["type"] == "model" and better["final"], "the first model exists already"
    assert {message["request"] for message in page.seen} == {3}
    assert page.ask("cancel", "cancelled", request=4), "even if nothing runs"


def test_progress_comes_about_ten_times_a_second(page: Page) -> None:
    page.workspace()
    page.send("compute", request=1, **LONG)
    page.take("model", "failed")
    first_stage(page)
    progress: list[dict[str, Any]] = []
    begin = time.perf_counter()
    while time.perf_counter() - begin < 1.0:
        progress.append(page.take("progress"))
    changes = sum(one["stage"] != other["stage"] for one, other in pairwise(progress))
    assert 1 <= len(progress) <= 13 + changes
    solving = [one for one in progress if one["stage"] == "snapshots"]
    assert all(0 <= one["done"] <= one["total"] <= 20_000 for one in solving)
    assert all(one["eta"] is None or one["eta"] >= 0 for one in solving)
    page.ask("cancel", "cancelled")  # or it computes on for a page that may come back


def test_another_page_waits_for_its_turn(server: Running, page: Page) -> None:
    page.workspace()
    with server.page() as other:
        other.workspace()
        page.send("compute", request=1, **LONG)
        first_stage(page)
        other.send("compute", request=2, **SHORT)
        waiting = other.take("progress", "model", "failed")
        assert (waiting["stage"], waiting["request"]) == ("waiting", 2)
        page.ask("cancel", "cancelled")
        assert other.take("model", "failed")["type"] == "model"


def test_a_page_that_is_closed_ends_its_computation(server: Running) -> None:
    with server.page() as gone:
        gone.workspace()
        gone.send("compute", request=1, **LONG)
        first_stage(gone)
    with server.page() as next_one:
        next_one.workspace()
        next_one.send("compute", request=1, **SHORT)
        assert next_one.take("model", "failed")["type"] == "model"


def test_a_new_computation_replaces_the_running_one(page: Page) -> None:
    page.workspace()
    page.send("compute", request=1, **LONG)
    first_stage(page)
    page.send("compute", request=2, **SHORT)
    while (message := page.take("model", "failed"))["request"] != 2:
        pass
    assert message["type"] == "model"


def test_errors_are_answers(page: Page) -> None:
    page.workspace()
    page.send("compute", request=7, **{**SHORT, "target_error": 0.0})
    assert "target error is 0.0, but it must be between 0 and 1" in page.take("failed")["message"]
    page.send("compute", request=7, **{**SHORT, "most_samples": 19})
    assert "most_samples is 19, but at least 20" in page.take("failed")["message"]
    page.send("compute", request=7, **{**SHORT, "most_samples": 20_001})
    assert "the page takes at most 20000" in page.take("failed")["message"]
    page.send("compute", request=7, **{**SHORT, "poisson": 0.5})
    assert "must be from 0 to 0.49" in page.take("failed")["message"]
    page.send("compute", request=7, **{**SHORT, "material": "mud"})
    assert "unknown material 'mud'; known are arap" in page.take("failed")["message"]
    page.send("polish", request=8, model=3, q=[0.0])
    assert page.take("failed") == {
        "type": "failed",
        "request": 8,
        "message": "model 3 is no longer kept; use the newest one",
    }
    page.socket.send('{"type": "evil", "request": 9}')
    refused = page.take("failed")
    assert refused["request"] == 9 and "known are choose, compute" in refused["message"]
    page.socket.send(b"binary")
    assert "must be text" in page.take("failed")["message"]


def test_too_large_a_message_ends_the_connection_only(server: Running, page: Page) -> None:
    page.workspace()
    with pytest.raises(ConnectionClosed):
        page.socket.send(" " * (16 * 2**20 + 1))
        page.take("failed")
    with server.page() as other:
        assert other.workspace()["kind"] == "mesh"


def test_polish_answers_the_newest_request_with_the_shape(server: Running, page: Page) -> None:
    page.workspace()
    page.send("compute", request=1, **SHORT)
    while not (model := page.take("model", "failed"))["final"]:
        pass
    frame: dict[str, Any] = {
        "model": model["number"],
        "handles": [REST, {**REST, "translation": [0.2, 0.1, 0.0]}],
        "q": [0.0] * model["dimension"],
    }
    for request in (2, 3, 4):
        page.send("polish", request=request, iterations=200, **frame)
    while (done := page.take("polished", "failed"))["request"] != 4:
        assert done["type"] == "polished"
    assert done["status"] == "converged"
    content = page.frames[-1]
    assert np.frombuffer(content[:4], "<i4")[0] == 4
    surface = np.frombuffer(content[4:], "<f4").reshape(-1, 3)
    head = np.isin(MESH.surface_vertices, np.flatnonzero(ENDS["head"]))
    rest = MESH.vertices[MESH.surface_vertices]
    np.testing.assert_allclose((surface - rest)[head].mean(axis=0), [0.2, 0.1, 0.0], atol=0.02)


def test_files_are_saved_beside_the_mesh(server: Running, page: Page, folder: Path) -> None:
    page.workspace()
    page.send("compute", request=1, **SHORT)
    while not page.take("model", "failed")["final"]:
        pass
    saved = page.ask("save", "saved", request=2, name=None)
    assert saved["problem"] == str(folder / "bar-2.json"), "bar.json is the user's"
    assert read_problem(saved["problem"]).handles.names == ("foot", "head")
    record = load(saved["model"]).provenance["accurate"]
    assert record["reached"] and saved["mesh"] is None
    page.send("save", request=3, name="../bar")
    assert "not a plain file name" in page.take("failed")["message"]


@pytest.mark.parametrize(
    "stranger", [{"Origin": "http://evil.example"}, {"Origin": "null"}, {"token": "token=x"}]
)
def test_strangers_get_no_websocket(server: Running, stranger: dict[str, str]) -> None:
    with pytest.raises(InvalidStatus, match="403"), server.page(**stranger):
        pass


@pytest.fixture
def short_lived(folder: Path) -> Iterator[Running]:
    yield from running(folder / "mesh.msh", "--port", "0")


def test_ctrl_c_ends_computations_and_pages(short_lived: Running) -> None:
    server = short_lived
    with server.page() as page:
        workspace = page.workspace()
        assert workspace["handles"] == [] and workspace["kind"] == "mesh"
        handles = [
            {"name": name, "vertices": np.flatnonzero(mask).tolist(), "moving": name == "head"}
            for name, mask in ENDS.items()
        ]
        ranges = {"translation": workspace["translation"], "angle": workspace["angle"]}
        page.ask("choose", "chosen", handles=handles, **ranges)
        page.send("compute", **LONG)
        first_stage(page)
        begin = time.perf_counter()
        code, rest = server.stop()
        assert code == 0 and rest.splitlines()[-1] == "snapspace: stopped"
        assert time.perf_counter() - begin < PATIENCE / 10
        with pytest.raises(ConnectionClosed):
            page.take("failed")
