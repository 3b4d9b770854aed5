"""Files that are dropped on the page of a server, or opened there."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any
from urllib.request import urlopen

import numpy as np
import pytest

from snapspace.generators import bar
from snapspace.mesh import write_tets

from ..server.in_process import started
from .choosing_page import bar_with_ends, cancel, compute, handles, press, wait_for_text, widen
from .pages import SECONDS, OpenPage, Page


@pytest.fixture(scope="module")
def empty(tmp_path_factory: pytest.TempPathFactory) -> str:
    """A server without a mesh."""
    return started(title="Snapspace", folder=tmp_path_factory.mktemp("empty"))


def test_a_mesh_is_uploaded(empty: str, tmp_path: Path, opened: OpenPage) -> None:
    mesh = bar(12, 10, 10)
    write_tets(tmp_path / "body.mesh", mesh)
    page = opened(empty)
    assert "Drop a mesh here" in page.text("#message")
    page.page.set_input_files("#message input", tmp_path / "body.mesh")
    page.wait("snapspace.kind === 'choosing'")
    assert page.text(".hud h1") == "body"
    assert f"{len(mesh.vertices):,} vertices" in page.text(".hud")


def test_a_bad_mesh_is_reported(
    empty: str, tmp_path: Path, opened: OpenPage, bar_folder: Path
) -> None:
    bad = tmp_path / "bad.mesh"
    bad.write_text("MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n", encoding="utf-8")
    page = opened(empty)
    page.page.set_input_files("#message input", bad)
    page.wait("Boolean(document.querySelector('#message [role=alert]'))")
    assert "bad.mesh" in page.text("#message")
    page.page.set_input_files("#message input", bar_folder / "bar.mesh")
    page.wait("snapspace.kind === 'choosing'")


def drop_bad_file(page: Page) -> None:
    """Drops a file on the page that cannot be read."""
    page.run(
        """(() => {
            const files = new DataTransfer();
            files.items.add(new File(["v 0 0 0\\nf 1 1 9\\n"], "bad.obj"));
            document.dispatchEvent(new DragEvent("drop", { dataTransfer: files }));
        })()"""
    )


def test_a_cancelled_upload_leaves_what_was_there(
    bar_server: str, empty: str, bar_folder: Path, opened: OpenPage
) -> None:
    addresses: list[str] = []

    def cancel_upload(page: Page, send: Callable[[], None]) -> None:
        def hold(route: Any) -> None:  # the file is not received
            addresses.append(route.request.url)

        page.page.route("**/mesh?*", hold)
        send()
        wait_for_text(page, "#message", "Sending")
        with page.page.expect_event("requestfailed"):  # without the route it would be received
            page.page.locator("#message button", has_text="Cancel").click()
        page.page.unroute("**/mesh?*")

    def wait_until_gone(page: Page) -> None:
        page.page.locator("#message").wait_for(state="hidden")

    page = bar_with_ends(opened, bar_server)
    chosen = handles(page)
    cancel_upload(page, lambda: drop_bad_file(page))
    wait_until_gone(page)
    urlopen(addresses[0], data=b"v 0 0 0", timeout=SECONDS).close()  # or only now
    assert page.run("snapspace.kind") == "choosing" and handles(page) == chosen

    widen(page)
    compute(page, most_samples=20_000, percent=0.01)
    page.wait("snapspace.kind === 'posing'")
    cancel_upload(page, lambda: drop_bad_file(page))
    wait_until_gone(page)
    stage = "document.querySelector('#panel .progress').textContent"
    page.wait(f"{stage} !== {page.run(stage)!r}")  # the computation continues
    cancel(page)
    page.page.get_by_role("button", name="Cancel", exact=True).wait_for(state="hidden")

    alone = opened(empty)
    file = bar_folder / "bar.mesh"
    cancel_upload(alone, lambda: alone.page.set_input_files("#message input", file))
    wait_for_text(alone, "#message", "Drop a mesh here")


def test_a_bad_file_that_is_dropped_leaves_handles_and_model(
    bar_server: str, opened: OpenPage
) -> None:
    page = bar_with_ends(opened, bar_server)
    chosen = handles(page)
    compute(page)
    wait_for_text(page, "#panel", "Done in")
    drop_bad_file(page)
    page.wait("Boolean(document.querySelector('#message [role=alert]'))")
    assert "bad.obj: line 2: a face has vertex index 9" in page.text("#message")
    press(page, "Close")
    page.drag(page.run("snapspace.handle(1)"), 30, -20)
    assert np.linalg.norm(page.motions()[1][1]) > 0.02
    press(page, "Choose handles")
    page.wait("snapspace.kind === 'choosing'")
    assert handles(page) == chosen
