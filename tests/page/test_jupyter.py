"""`model.show()` in a real JupyterLab; skipped where none is installed."""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from snapspace import PosingModel

from .framed import dragged, ready
from .pages import SECONDS

NEEDED = ("jupyterlab", "ipykernel")
pytestmark = pytest.mark.skipif(
    not all(importlib.util.find_spec(name) for name in NEEDED),
    reason="needs jupyterlab and ipykernel (pip install jupyterlab)",
)
CELL = "import snapspace as ss\nss.load('bar.snapspace').show(title='bar', height=420)"


@pytest.fixture
def address(posing_model: PosingModel, tmp_path: Path) -> Iterator[str]:
    """A notebook with one cell, on a server with its own settings; yields its address."""
    places = {f"JUPYTER_{name}_DIR": str(tmp_path / name) for name in ("CONFIG", "DATA", "RUNTIME")}
    folder = tmp_path / "notebooks"
    folder.mkdir()
    posing_model.save(folder / "bar.snapspace")
    (folder / "bar.ipynb").write_text(json.dumps(notebook()), encoding="utf-8")
    options = ("--no-browser", "--allow-root", "--ServerApp.ip=127.0.0.1", "--ServerApp.port=0")
    server = subprocess.Popen(
        [sys.executable, "-m", "jupyterlab", *options, f"--ServerApp.root_dir={folder}"],
        env={**os.environ, **places},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        record = started(server, tmp_path / "RUNTIME")
        # reset: no tabs of the notebook before
        yield f"{record['url']}lab/tree/bar.ipynb?reset&token={record['token']}"
    finally:
        server.terminate()
        server.wait(timeout=SECONDS)


def notebook() -> dict[str, Any]:
    cell = {"cell_type": "code", "id": "show", "source": CELL, "metadata": {}}
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    return {
        "cells": [{**cell, "outputs": [], "execution_count": None}],
        "metadata": {"kernelspec": kernel},
        "nbformat": 4,
        "nbformat_minor": 5,
    }


def started(server: subprocess.Popen[bytes], runtime: Path) -> dict[str, Any]:
    """The server's record of itself, once it listens."""
    file, end = runtime / f"jpserver-{server.pid}.json", time.monotonic() + SECONDS
    while time.monotonic() < end and server.poll() is None:
        try:
            record: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        except (FileNotFoundError, json.JSONDecodeError):  # not yet, or not yet whole
            time.sleep(0.1)
            continue
        return record
    raise AssertionError("JupyterLab does not start")


def frame_of(page: Any) -> Any:
    element = page.wait_for_selector(".jp-OutputArea-output iframe", timeout=1000 * SECONDS)
    return ready(element.content_frame())


def test_it_runs_in_jupyterlab(chromium: Any, address: str, tmp_path: Path) -> None:
    page, faults = chromium.new_page(viewport={"width": 1280, "height": 800}), []
    # errors of the frame; those of JupyterLab itself are not ours
    page.on(
        "console",
        lambda message: (
            faults.append(message.text)
            if message.type == "error" and message.location["url"] == "about:srcdoc"
            else None
        ),
    )
    page.goto(address)
    page.get_by_text("| Idle").wait_for(timeout=1000 * SECONDS)
    page.click(".jp-CodeCell .cm-content")
    page.keyboard.press("Control+Enter")
    frame = frame_of(page)
    assert frame.evaluate("snapspace.kind") == "posing"
    assert dragged(page, frame, 1, -40, -40) > 0.02

    page.click(".jp-CodeCell .cm-content")
    page.keyboard.press("Control+s")
    file, end = tmp_path / "notebooks" / "bar.ipynb", time.monotonic() + SECONDS
    while "srcdoc" not in file.read_text(encoding="utf-8"):
        assert time.monotonic() < end, "the notebook is not saved"
        page.wait_for_timeout(100)
    page.goto(address)
    assert frame_of(page).evaluate("snapspace.kind") == "posing"  # saved with the notebook

    saved = file.read_text(encoding="utf-8").replace("title='bar'", "title='changed'")
    other = file.with_name("untrusted.ipynb")  # not signed, as from somebody else
    other.write_text(saved, encoding="utf-8")
    page.goto(address.replace("bar.ipynb", "untrusted.ipynb"))
    page.get_by_text("appears when the notebook is trusted").wait_for(timeout=1000 * SECONDS)
    assert page.query_selector(".jp-OutputArea-output iframe") is None
    page.close()
    assert faults == []
