"""The progress of a computation, on a page that comes to it later or loses it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from snapspace.mesh import write_tets
from snapspace.server.bodies import read_mesh
from snapspace.server.shared_body import SharedBody
from snapspace.stopping import check_stop

from ..server.in_process import socket, started
from .choosing_page import BAR, bar_with_ends, cancel, handles, press, wait_for_text
from .pages import OpenPage

STAGE = "Finding the subspace"
BAR_IS_SHOWN = "!document.querySelector('#panel .progress').hidden"


def held(*_: Any, begins: Callable[[str], None], **__: Any) -> Iterator[Any]:
    """A computation that stays in one stage, and says so only once, until it is cancelled."""
    begins("subspace")
    while True:
        check_stop()
        time.sleep(0.02)
    yield


def test_progress_after_a_reload_and_in_a_tab_that_was_taken_over(
    tmp_path: Path, opened: OpenPage, chromium: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("snapspace.server.computation.growing_models", held)
    write_tets(tmp_path / "bar.mesh", BAR)
    address = started(body=SharedBody(read_mesh(tmp_path / "bar.mesh")))
    page = bar_with_ends(opened, address)
    press(page, "Compute")
    wait_for_text(page, ".progress-words", STAGE)
    page.page.reload()
    wait_for_text(page, ".progress-words", STAGE)
    id = page.run("new URLSearchParams(location.search).get('workspace')")
    with socket(address, id):
        wait_for_text(page, "#connection", "open in another tab")
        assert not page.run(BAR_IS_SHOWN), "nothing is known of the computation"
        assert not page.page.get_by_role("button", name="Cancel").is_visible()
        assert not page.page.get_by_role("button", name="Compute").is_visible()
    press(page, "Use it here")
    page.wait(BAR_IS_SHOWN)
    assert STAGE in page.text(".progress-words")
    cancel(page)
    page.wait(f"!({BAR_IS_SHOWN})")


def test_a_tab_that_was_taken_over_sends_no_mesh(
    tmp_path: Path, opened: OpenPage, chromium: object
) -> None:
    """It would replace the mesh of the other tab."""
    for name in ("bar", "other"):
        write_tets(tmp_path / f"{name}.mesh", BAR)
    address = started(body=SharedBody(read_mesh(tmp_path / "bar.mesh")))
    page = bar_with_ends(opened, address)
    chosen, sent = handles(page), []
    page.page.on("request", lambda request: sent.append(request.method))
    id = page.run("new URLSearchParams(location.search).get('workspace')")
    with socket(address, id):
        wait_for_text(page, "#connection", "open in another tab")
        footer = page.page.locator("footer input[type=file]")
        footer.set_input_files(tmp_path / "other.mesh")
        wait_for_text(page, "#message", "other.mesh was not sent: there is no connection")
        assert "POST" not in sent
        press(page, "Close")
    press(page, "Use it here")
    page.wait("document.getElementById('connection').hidden")
    assert handles(page) == chosen
