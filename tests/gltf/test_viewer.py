"""An independent viewer, three.js's GLTFLoader in a browser, draws the shapes of the model."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from snapspace import PosingModel, write_animation

from ..own_file import own_file, with_file
from ..page.tools import ROOT

MODULES = ROOT / "web" / "node_modules" / "three"
PAGE = """<!doctype html>
<script type="importmap">
{"imports": {"three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/"}}
</script>
<canvas width="200" height="200"></canvas>
<script type="module">
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
const { scene, animations } = await new GLTFLoader().loadAsync("/nod.glb");
const mixer = new THREE.AnimationMixer(scene);
mixer.clipAction(animations[0]).setLoop(THREE.LoopOnce).play().clampWhenFinished = true;
window.shapeAt = (seconds) => {
  mixer.setTime(seconds);
  scene.updateMatrixWorld(true);
  let mesh;
  scene.traverse((node) => (mesh = node.isMesh ? node : mesh));
  const point = new THREE.Vector3();
  return Array.from({ length: mesh.geometry.attributes.position.count }, (_, v) =>
    mesh.getVertexPosition(v, point).applyMatrix4(mesh.matrixWorld).toArray());
};
const canvas = document.querySelector("canvas");
const renderer = new THREE.WebGLRenderer({ canvas, preserveDrawingBuffer: true });
const camera = new THREE.PerspectiveCamera(40, 1, 0.01, 100);
const box = new THREE.Box3().setFromObject(scene);
camera.position.copy(box.max).multiplyScalar(2);
camera.lookAt(box.getCenter(new THREE.Vector3()));
const world = new THREE.Scene();
world.add(scene, new THREE.AmbientLight(0xffffff, 3));
renderer.render(world, camera);
const pixels = new Uint8Array(4 * 200 * 200);
const gl = renderer.getContext();
gl.readPixels(0, 0, 200, 200, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
const more = (a, b) =>
  pixels.filter((value, i) => i % 4 === a && value > pixels[i + b - a] + 60).length;
window.reddish = more(0, 2);
window.bluish = more(2, 0);
window.covered = pixels.filter((value, i) => i % 4 === 0 && value > 20).length;
</script>
"""


class Handler(SimpleHTTPRequestHandler):
    """Files of a folder, and those of three.js."""

    def translate_path(self, path: str) -> str:
        if path.startswith("/three/"):
            return str(MODULES / path.removeprefix("/three/"))
        return super().translate_path(path)

    def log_message(self, *_: Any) -> None:
        pass


@pytest.fixture
def address(tmp_path: Path) -> Iterator[str]:
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(Handler, directory=str(tmp_path)))
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()
    server.server_close()
    thread.join()


def test_three_js_plays_the_path(
    posing_model: PosingModel, address: str, tmp_path: Path, chromium: Any
) -> None:
    session = posing_model.session()
    nod = session.animate([{"head": ((0, 0.5, 0.4), (0, 0, 0.4))}], frames=5)
    shapes = [session.vertices for _ in nod]
    write_animation(tmp_path / "nod.glb", posing_model, shapes, frames_per_second=10.0, up="z")
    (tmp_path / "index.html").write_text(PAGE, encoding="utf-8")
    page = chromium.new_page()
    try:
        page.goto(f"{address}/index.html")
        page.wait_for_function("window.covered !== undefined")
        assert page.evaluate("covered") > 400, "the body is drawn"
        close = 1e-5 * posing_model.problem.mesh.diagonal
        for frame in (0, 2, 4):
            found = np.array(page.evaluate(f"shapeAt({frame / 10})"))
            x, y, z = posing_model.surface.vertices(shapes[frame]).T
            np.testing.assert_allclose(found, np.column_stack([x, z, -y]), atol=close)
    finally:
        page.close()


def test_three_js_draws_the_users_texture(
    posing_model: PosingModel, address: str, tmp_path: Path, chromium: Any
) -> None:
    """It is red on one half of the body and blue on the other; clay is neither."""
    model = with_file(posing_model, own_file(posing_model))
    session = model.session()
    nod = session.animate([{"head": ((0, 0.5, 0.4), (0, 0, 0.4))}], frames=3)
    write_animation(tmp_path / "nod.glb", model, [session.vertices for _ in nod])
    (tmp_path / "index.html").write_text(PAGE, encoding="utf-8")
    page = chromium.new_page()
    try:
        page.goto(f"{address}/index.html")
        page.wait_for_function("window.covered !== undefined")
        covered, red, blue = (page.evaluate(name) for name in ("covered", "reddish", "bluish"))
        assert min(red, blue) > 0.1 * covered, (covered, red, blue)
    finally:
        page.close()
