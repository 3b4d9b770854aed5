"""Makes the pictures of the page: screenshots in headless Chromium.

Needs a chromium on the path, and playwright.

python docs/make_page_pictures.py
"""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from pictures_choosing import choosing, creature_served, mirroring
from pictures_creature import creature_problem
from pictures_poses import creature_poses, many_creature_poses
from playwright.sync_api import sync_playwright

import snapspace as ss
from snapspace.generators import creature

FOLDER = Path(__file__).parent / "pictures"
SOFTWARE_WEBGL = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
TETS = 30_000
FEWER = 12_000  # of each of many poses
DRAWN = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"


def model_of(problem: Any, samples: int, dimension: int) -> ss.ReducedModel:
    """A model of a problem from so many samples."""
    snapshots = ss.solve_snapshots(problem, ss.sample(problem.domain, samples, method="sobol"))
    subspace = ss.snapshot_pca(snapshots, dimension=dimension)
    return ss.reduce(problem, subspace, snapshots=snapshots)


def model_of_many(poses: ss.Poses, dimension: int) -> ss.ReducedModel:
    """A model for blends of two poses, from the poses and the middles of some pairs."""
    ends = np.eye(len(poses))
    middles = [(ends + np.roll(ends, step, axis=0)) / 2 for step in (1, 4)]
    problem = ss.InterpolationProblem(poses)
    snapshots = ss.solve_snapshots(problem, np.concatenate([ends, *middles]))
    return ss.reduce(problem, ss.snapshot_pca(snapshots, dimension=dimension), snapshots=snapshots)


def drag(page: Any, handle: int, dx: float, dy: float) -> None:
    """Drags a handle by its centre, in steps."""
    x, y = page.evaluate(f"snapspace.handle({handle})")
    page.mouse.move(x, y)
    page.mouse.down()
    for step in range(1, 13):
        page.mouse.move(x + dx * step / 12, y + dy * step / 12)
        page.evaluate(DRAWN)
    page.mouse.up()


def posing(page: Any) -> None:
    """The head is turned down, the tail raised."""
    drag(page, 1, 40, 26)
    drag(page, 2, -24, -34)
    page.keyboard.press("t")
    page.keyboard.press("2")
    for key in ("ArrowRight", "ArrowRight", "ArrowDown", "ArrowDown"):
        page.keyboard.press(key)


def blending(page: Any) -> None:
    """Half of two poses, beside the straight blend."""
    page.get_by_role("button", name="Compare").click()
    sliders = page.locator("section", has_text="Poses").locator("input")
    sliders.nth(0).fill("0.5")
    sliders.nth(1).fill("0.5")
    page.wait_for_timeout(2500)  # the small pictures of the poses


def choosing_poses(page: Any) -> None:
    """Three poses of three groups are chosen of many."""
    page.wait_for_timeout(8000)  # the small pictures of the poses
    added, removed = (
        ("rear-up-04", "look-round-03", "sniff-04"),
        ("rest", "rear-up-01", "rear-up-02"),
    )
    for name in (*added, *removed):
        page.get_by_role("button", name=name, exact=True).click()
    page.get_by_role("slider", name="rear-up-04").fill("0.5")
    page.evaluate("for (const e of document.querySelectorAll('#panel, .poses')) e.scrollTop = 0")
    page.mouse.move(0, 0)


def take(browser: Any, address: str, theme: str, act: Callable[[Any], None], name: str) -> None:
    """A picture of a page after something was done in it."""
    page = browser.new_page(viewport={"width": 1280, "height": 720}, color_scheme=theme)
    page.goto(address)
    while not page.evaluate("Boolean(snapspace.ready)"):
        page.wait_for_timeout(50)
    act(page)
    page.wait_for_timeout(500)
    page.screenshot(path=FOLDER / f"{name}.png")
    page.close()


def main() -> None:
    poses = ss.InterpolationProblem(creature_poses(creature(TETS)))
    many = model_of_many(many_creature_poses(creature(FEWER)), 20)
    plans = [
        ("page-posing", model_of(creature_problem(TETS), 200, 40), "light", posing),
        ("page-blending", model_of(poses, 30, 20), "dark", blending),
        ("page-many-poses", many, "light", choosing_poses),
    ]
    program = shutil.which("chromium")
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        browser = playwright.chromium.launch(executable_path=program, args=SOFTWARE_WEBGL)
        for name, model, theme, act in plans:
            path = ss.export_html(model, Path(folder) / f"{name}.html", title="Creature")
            take(browser, path.as_uri(), theme, act, name)
        with creature_served(Path(folder), TETS) as address:
            take(browser, address, "light", choosing, "page-choosing")
            take(browser, address, "light", mirroring, "page-mirror")
        browser.close()


if __name__ == "__main__":
    main()
