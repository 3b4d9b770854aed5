"""The local server: who is answered, with what, and how it ends."""

from __future__ import annotations

import socket
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from snapspace import PosingModel, load
from snapspace.page import packed
from snapspace.server import serve

from .running import Running


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


def test_others_are_refused(running: Running) -> None:
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


def test_it_works_in_a_browser(
    running: Running, chromium: object, posing_model: PosingModel
) -> None:
    from ..page.pages import open_page

    page = open_page(chromium, running.address)
    assert page.run("snapspace.kind") == "posing"
    assert page.text(".hud h1") == "bar"
    page.close()
    assert page.faults == []


def test_ctrl_c_ends_it_cleanly(saved: Path) -> None:
    server = Running(saved)
    assert server.get()[0] == 200
    code, rest = server.stop()
    assert code == 0
    assert rest.splitlines() == ["snapspace: Ctrl-C ends it", "snapspace: stopped"]


def test_a_port_that_is_taken_is_told(posing_model: PosingModel) -> None:
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        with pytest.raises(ValueError, match=rf"cannot listen at 127.0.0.1:{port}: .*--port"):
            serve(posing_model, title="", port=port)
    with pytest.raises(ValueError, match="ports go from 0 to 65535"):
        serve(posing_model, title="", port=70_000)
