"""The local server: which requests it answers, with what, and how it ends."""

from __future__ import annotations

import signal
import socket as tcp
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

import numpy as np
import pytest

from snapspace import InterpolationModel, PosingModel, load
from snapspace.cli import main
from snapspace.page import packed
from snapspace.server import serve

from .in_process import socket, started
from .running import Page, Running


@pytest.fixture(scope="module")
def saved(posing_model: PosingModel, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return posing_model.save(tmp_path_factory.mktemp("server") / "bar.snapspace")


@pytest.fixture(scope="module")
def running(saved: Path) -> Iterator[Running]:
    server = Running(saved)
    yield server
    server.kill()


def test_the_page_and_the_model_are_served(running: Running, saved: Path) -> None:
    status, page = running.get()
    assert status == 200 and b'name="snapspace-model" content="model?token=' in page
    assert b'name="snapspace-server" content="live?token=' in page
    assert running.get("/model") == (200, packed(load(saved), name="bar"))
    assert running.get("/../pyproject.toml")[0] == 404


def test_requests_of_others_are_refused(running: Running) -> None:
    port = urlsplit(running.address).port
    for token in ("", "token=", "token=wrong", f"{urlsplit(running.address).query}&token=x"):
        status, text = running.get(token=token)
        assert status == 403 and b"the token is missing or wrong" in text
    for host in (f"evil.example:{port}", "[", "127.0.0.1.evil.example"):
        assert running.get(Host=host)[0] == 403
    for origin in ("http://evil.example", "null", f"http://127.0.0.1:{port}.evil.example"):
        assert running.get("/model", Origin=origin)[0] == 403
    own = f"localhost:{port}"
    assert running.get("/model", Host=own, Origin=f"http://{own}")[0] == 200
    assert running.get("/model", Host="localhost:9000")[0] == 200, "through a tunnel"


def test_the_page_works_in_a_browser(
    running: Running, chromium: object, posing_model: PosingModel
) -> None:
    from ..page.pages import Tabs

    page = Tabs(chromium).open(running.address)
    assert page.run("snapspace.kind") == "posing"
    assert page.text(".hud h1") == "bar"
    page.close()
    assert page.faults == []


def test_ctrl_c_ends_the_server_cleanly(blending_model: InterpolationModel, tmp_path: Path) -> None:
    server = Running(blending_model.save(tmp_path / "blend.snapspace"))
    assert server.get()[0] == 200
    code, rest = server.stop()
    assert code == 0
    assert rest.splitlines() == ["snapspace: Ctrl-C ends it", "snapspace: stopped"]


def test_sigterm_ends_the_server_as_cleanly(saved: Path, tmp_path: Path) -> None:
    server = Running(saved, environment={"TMPDIR": str(tmp_path)})
    assert len(list(tmp_path.iterdir())) == 1
    code, rest = server.stop(signal.SIGTERM)
    assert code == 0 and rest.splitlines()[-1] == "snapspace: stopped"
    assert list(tmp_path.iterdir()) == []


def frame(model: PosingModel) -> dict[str, object]:
    session = model.session()
    session.move("head", translation=(0.3, 0.1, 0.0))
    rest = {"rotation": [1, 0, 0, 0, 1, 0, 0, 0, 1], "translation": [0, 0, 0]}
    head = {**rest, "translation": [0.3, 0.1, 0.0]}
    return {"model": 0, "handles": [rest, head, rest], "q": session.q.tolist()}


def test_shapes_of_the_model_are_polished(running: Running, posing_model: PosingModel) -> None:
    session = posing_model.session()
    session.move("head", translation=(0.3, 0.1, 0.0))
    expected = session.polish(iterations=4)
    with running.page() as page:
        workspace = page.take("workspace")
        assert (workspace["kind"], workspace["name"], workspace["mesh"]) == ("model", "bar", None)
        done = page.ask("polish", "polished", request=7, iterations=4, **frame(posing_model))
        assert done["iterations"] == expected.report.iterations
        assert done["moved"] == pytest.approx(expected.moved_relative, rel=1e-6)
        assert np.frombuffer(page.frames[0][:4], "<i4")[0] == 7
        shown = np.frombuffer(page.frames[0][4:], "<f4").reshape(-1, 3)
        surface = posing_model.problem.mesh.surface_vertices
        np.testing.assert_allclose(shown, expected.vertices[surface], atol=1e-6)
        page.send("polish", request=8, **{**frame(posing_model), "handles": []})
        assert "got 0 motions, but there are 3 handles" in page.take("failed")["message"]
        assert running.upload(workspace["id"], "x.txt", b"0")[0] == 415


def test_blends_are_polished(blending_model: InterpolationModel, tmp_path: Path) -> None:
    weights, session = [0.2, 0.5, 0.3], blending_model.session()
    session.blend(weights)
    expected = blending_model.surface.vertices(session.polish(iterations=3).vertices)
    with socket(started(model=blending_model, folder=tmp_path)) as opened:
        page, q = Page(opened), session.q.tolist()
        page.ask("polish", "polished", model=0, weights=weights, q=q, iterations=3)
        shown = np.frombuffer(page.frames[0][4:], "<f4").reshape(-1, 3)
        np.testing.assert_allclose(shown, expected, atol=1e-5)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["missing.json"], "there is no such file"),
        (["x.txt"], "unknown extension '.txt'; known are .snapspace, .json, .mesh"),
        (["--dimension", "3"], "--dimension is for models"),
        (["--upload-limit", "0"], "--upload-limit"),
    ],
)
def test_what_cannot_be_viewed_is_reported_at_once(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["view", *arguments]) != 0
    assert message in capsys.readouterr().err.replace("\n", " ")


def test_a_port_in_use_is_reported(posing_model: PosingModel) -> None:
    with tcp.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        with pytest.raises(ValueError, match=rf"cannot listen on 127.0.0.1:{port}: .*--port"):
            serve(posing_model, title="", port=port)
    with pytest.raises(ValueError, match="must be from 0 to 65535"):
        serve(posing_model, title="", port=70_000)
