"""The page for fingers, in forced colours, without JavaScript, and with a server that is gone."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from snapspace.mesh import write_tets
from snapspace.server.bodies import read_mesh
from snapspace.server.shared_body import SharedBody

from ..server.in_process import socket, started
from .choosing_page import BAR, press, wait_for_text
from .pages import OpenPage, Page, Tabs
from .serving import served

#: Controls that are too small for fingers: narrower or lower than 44 pixels.
SMALL = """[...document.querySelectorAll(
  "#panel button, #panel input, #panel select, #panel summary, #message button, .corner circle"
)].filter((e) => e.offsetParent !== null || e.closest("svg")).flatMap((e) => {
  const { width, height } = e.getBoundingClientRect();
  return Math.min(width, height) < 43.9 ? [`${e.outerHTML.slice(0, 80)} ${width} x ${height}`] : [];
})"""
#: Elements that are wider than their place.
OVERFLOWING = """[...document.querySelectorAll("#panel, #panel section *")].filter(
  (e) => e.scrollWidth > e.clientWidth + 1 && e.clientWidth > 0
    && !["hidden", "clip"].includes(getComputedStyle(e).overflowX)
    && getComputedStyle(e).display !== "inline" && !["INPUT", "SELECT"].includes(e.tagName)
).map((e) => `${e.outerHTML.slice(0, 90)} ${e.scrollWidth} > ${e.clientWidth}`)"""
#: Fields that do not show their longest text: a number of four decimals, words of a drop-down.
CUT = """(() => {
  const numbers = [...document.querySelectorAll(".motion-fields input")].filter((field) => {
    field.value = "-0.0123";
    return field.scrollWidth > field.clientWidth;
  });
  const lists = [...document.querySelectorAll("#panel select")].filter((list) => {
    const { width } = list.getBoundingClientRect();
    list.style.flex = "none";
    return list.getBoundingClientRect().width > width + 0.5;
  });
  return [...numbers, ...lists].map((field) => field.getAttribute("aria-label"));
})()"""
FRAMED = """(field) => {
  const left = (element) => element.getBoundingClientRect().left;
  const style = getComputedStyle(field);
  const [width, offset] = [style.outlineWidth, style.outlineOffset].map(parseFloat);
  return width > 0 && width + offset <= left(field) - left(field.parentElement);
}"""

PHONE: dict[str, Any] = {"size": (390, 844), "has_touch": True, "is_mobile": True}
LONG = "the_left_hand_of_the_creature_that_waves_to_everybody"
#: Parts of the page that the notice of the connection covers.
COVERED = """(() => {
  const box = (e) => e.getBoundingClientRect();
  const notice = box(document.getElementById("connection"));
  const parts = [...document.querySelectorAll("#panel, .hud h1, .hud p")];
  return parts.filter((part) => {
    const { left, right, top, bottom } = box(part);
    return left < notice.right && notice.left < right && top < notice.bottom && notice.top < bottom;
  }).map((part) => part.outerHTML.slice(0, 80));
})()"""

CHOICE = f"""snapspace.choosing.go({{
  selected: Int32Array.of(1, 2),
  handles: [
    {{ key: 0, name: "{LONG}", vertices: Int32Array.of(3, 4), moving: false }},
    {{ key: 1, name: "b", vertices: Int32Array.of(5, 6), moving: true,
       translation: [1, 2, 3], angle: [1, 2, 3] }},
  ],
  parts: [{{ key: 0, name: "{LONG}", vertices: Int32Array.of(7, 8), factor: 0.0001 }}],
}})"""


def with_everything(page: Page) -> None:
    page.wait("snapspace.kind === 'choosing'")
    page.run(CHOICE)
    press(page, "Own range")
    for summary in page.page.locator("summary").all():
        summary.click()


def test_controls_are_large_enough_for_fingers(
    bar_server: str, posing_page: Path, many_poses_page: Path, tabs: Tabs
) -> None:
    """One page after the other, in the same tab."""
    page = tabs.open(bar_server, **PHONE)
    with_everything(page)
    assert page.run(SMALL) == [] and page.run(OVERFLOWING) == []
    tabs.close(page)
    page = tabs.open(posing_page.as_uri(), **PHONE)
    assert page.run(SMALL) == [] and page.run(OVERFLOWING) == []
    tabs.close(page)
    page = tabs.open(many_poses_page.as_uri(), **PHONE)
    assert page.run(SMALL) == []
    tabs.close(page)


def test_a_phone_shows_no_keys_to_press(posing_page: Path, opened: OpenPage) -> None:
    turns = {"choose Turn": PHONE, "Shift-drag": {}}
    for how, options in turns.items():
        page = opened(posing_page.as_uri(), **options)
        assert f"or {how} to turn it" in page.text("#panel")


def test_texts_fit_their_fields(posing_page: Path, opened: OpenPage) -> None:
    page = opened(posing_page.as_uri(), size=(1280, 800))
    for key in "2k":
        page.page.keyboard.press(key)
    assert page.run(CUT) == []
    page.run("(navigator.clipboard.writeText = () => Promise.reject(Error()), null)")
    press(page, "Copy link")
    field = page.page.get_by_label("The address of this pose")
    field.wait_for()
    assert field.evaluate(FRAMED), "the paragraph cuts no side of the frame"


def test_forced_colours_and_long_names(bar_server: str, opened: OpenPage) -> None:
    page = opened(bar_server, size=(900, 800), forced_colors="active")
    with_everything(page)
    assert page.run(OVERFLOWING) == []
    style = "(e) => { const s = getComputedStyle(e); return [s.backgroundColor, s.borderColor]; }"
    pressed = page.page.get_by_role("radio", name="Brush").evaluate(style)
    others = page.page.get_by_role("radio", name="Box").evaluate(style)
    assert pressed[0] != others[0], "pressed buttons look different"
    swatches = page.page.locator(".swatch").evaluate_all(
        "(all) => all.map((e) => getComputedStyle(e).backgroundColor)"
    )
    assert len(set(swatches)) == 3, "handles and parts keep their colours"


def test_without_javascript_the_page_says_so(posing_page: Path, chromium: object) -> None:
    context = chromium.new_context(java_script_enabled=False)  # type: ignore[attr-defined]
    page = context.new_page()
    page.goto(posing_page.as_uri())
    assert "JavaScript" in page.locator(".noscript").inner_text()
    context.close()


def test_a_phone_shows_the_name_of_the_mesh_without_a_connection(
    tmp_path: Path, opened: OpenPage, chromium: object
) -> None:
    write_tets(tmp_path / "bar.mesh", BAR)
    address = started(body=SharedBody(read_mesh(tmp_path / "bar.mesh")))
    page = opened(address, **PHONE)
    page.wait("snapspace.kind === 'choosing'")
    id = page.run("new URLSearchParams(location.search).get('workspace')")
    with socket(address, id):
        wait_for_text(page, "#connection", "open in another tab")
        assert page.run(COVERED) == []
        page.page.locator("#fold").click()
        assert page.run(COVERED) == []


def test_a_new_token_is_asked_for(bar_folder: Path, opened: OpenPage) -> None:
    with served(bar_folder / "bar.mesh", cwd=bar_folder) as address:
        page = opened(address)
        page.wait("snapspace.kind === 'choosing'")
        page.run(CHOICE)
        page.loses_server = True
        port = address.split(":")[2].split("/")[0]
    wait_for_text(page, "#connection", "No connection to the server")
    assert page.run(COVERED) == []
    handles = page.run("snapspace.handles")
    with served(bar_folder / "bar.mesh", "--port", port, cwd=bar_folder) as other:
        wait_for_text(page, "#connection", "has another token")
        assert page.run(COVERED) == []
        field = page.page.get_by_label("Address or token of the server")
        field.fill("wrong")
        press(page, "Connect")
        page.page.wait_for_timeout(100)
        wait_for_text(page, "#connection", "has another token")
        sent: list[str] = []
        page.page.on("websocket", lambda to: to.on("framesent", lambda text: sent.append(text)))
        field.fill(other)
        press(page, "Connect")
        page.wait("document.getElementById('connection').hidden")
        assert page.run("snapspace.handles") == handles
        page.wait_for(lambda: any(LONG in text for text in sent), "the choice is sent")
        page.page.reload()
        page.wait("snapspace.kind === 'choosing'")
        assert page.run("snapspace.handles") == handles, "the new server has them as well"
        page.close()


def test_sliders_say_what_is_beside_them(blending_page: Path, opened: OpenPage) -> None:
    """Not a bare number such as 0.333 for 33 %."""
    page = opened(blending_page.as_uri())
    texts = page.run(
        "[...document.querySelectorAll('#panel input[type=range]')]"
        ".filter((input) => input.checkVisibility()).map((input) => input.ariaValueText)"
    )
    assert "33 %" in texts and "0.00 s" in texts and None not in texts
