"""`snapspace export`: one page with the model inside."""

from __future__ import annotations

import base64
import re
from pathlib import Path

from snapspace import load
from snapspace.page import packed

from .conftest import Run


def test_the_page_holds_the_model(run: Run, model: Path, tmp_path: Path) -> None:
    out = tmp_path / "out.html"
    figures = run(
        "export", model, "--html", out, "--title", "A bar", "--dimension", 6, "--up", "y", "--json"
    ).json
    text = out.read_text(encoding="utf-8")
    assert figures == {"file": str(out), "bytes": out.stat().st_size, "dimension": 6}
    found = re.search(r'octet-stream">([^<]*)</script>', text)
    assert found is not None
    assert base64.b64decode(found[1]) == packed(load(model).leading(6), name="A bar", up="y")
    assert "<title>A bar</title>" in text


def test_mistakes_give_one_line(run: Run, model: Path, tmp_path: Path) -> None:
    result = run("export", model, "--html", tmp_path / "a.pdf")
    assert "name of a page must end in .html" in result.error
    assert "no such model file" in run("export", "none.snapspace", "--html", "a.html").error
    assert "--html" in run("export", model).error
    assert "must end in .snapspace" in run("export", model, "--packed", tmp_path / "a.bin").error
    assert "this is the model itself" in run("export", model, "--packed", model).error
    assert "must end in .py" in run("export", model, "--blender", tmp_path / "a.blend").error
    assert "cannot be written" in run("export", model, "--html", tmp_path / "no" / "a.html").error


def test_a_model_becomes_gltf(run: Run, model: Path, tmp_path: Path) -> None:
    out = tmp_path / "bar.glb"
    result = run("export", model, "--glb", out, "--json")
    loaded = load(model)
    assert result.json["targets"] == loaded.dimension and result.json["target_error"] == 0.0
    assert result.json["glb_bytes"] == out.stat().st_size
    few = run("export", model, "--glb", out, "--targets", 3, "--json").json
    assert few["targets"] == 3 and 0.0 < few["target_error"] < 0.5
    assert few["glb_bytes"] < result.json["glb_bytes"]


def test_mistakes_with_gltf_give_one_line(run: Run, model: Path, tmp_path: Path) -> None:
    assert "must end in .glb" in run("export", model, "--glb", tmp_path / "a.obj").error
    page = tmp_path / "a.html"
    assert "give --glb or --blender" in run("export", model, "--html", page, "--targets", 3).error
    assert not page.exists()


def test_the_packed_model_is_what_the_page_holds(run: Run, model: Path, tmp_path: Path) -> None:
    out = tmp_path / "small.snapspace"
    figures = run("export", model, "--packed", out, "--title", "A bar", "--json").json
    assert out.read_bytes() == packed(load(model), name="A bar")
    assert figures["packed_bytes"] == out.stat().st_size


def test_a_packed_model_is_called_what_it_is(run: Run, model: Path, tmp_path: Path) -> None:
    out = tmp_path / "small.snapspace"
    assert run("export", model, "--packed", out).code == 0
    for words in (("info", out), ("pose", out), ("export", out, "--html", tmp_path / "a.html")):
        message = run(*words).error
        assert message.startswith(f"{out}: this is a packed model for <snapspace-viewer>")
        assert message.endswith("use the model that it was made from")


def test_a_model_becomes_shape_keys_of_blender(run: Run, model: Path, tmp_path: Path) -> None:
    out = tmp_path / "bar.py"
    figures = run("export", model, "--blender", out, "--targets", 3, "--json").json
    assert figures["shape_keys"] == 3
    compile(out.read_text(encoding="utf-8"), "bar.py", "exec")
