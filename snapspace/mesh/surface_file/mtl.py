"""Materials of Wavefront OBJ files (.mtl)."""

from __future__ import annotations

from .appearance import SurfaceMaterial, Textures, linear_color

#: Options of `map_Kd` and the largest number of values that follow them.
_OPTIONS = {
    "-blendu": 1, "-blendv": 1, "-boost": 1, "-bm": 1, "-cc": 1, "-clamp": 1, "-imfchan": 1,
    "-mm": 2, "-o": 3, "-s": 3, "-t": 3, "-texres": 1, "-type": 1,
}  # fmt: skip


def read_mtl(text: str, files: dict[str, bytes], textures: Textures) -> dict[str, SurfaceMaterial]:
    """The materials of a file by name; unknown lines are skipped.

    files : content of the available pictures, by their names in the file
    """
    found: dict[str, SurfaceMaterial] = {}
    name, color, picture = "", (1.0, 1.0, 1.0), ""

    def keep() -> None:
        if not name:
            return
        texture = textures.add(picture, files.get(picture)) if picture else None
        # several programs write black where a texture gives the colour
        known = (1.0, 1.0, 1.0) if texture is not None and not any(color) else color
        found[name] = SurfaceMaterial(name, known, texture)

    for line in text.splitlines():
        word, _, rest = line.strip().partition(" ")
        if word == "newmtl":
            keep()
            name, color, picture = rest.strip(), (1.0, 1.0, 1.0), ""
        elif word == "Kd":
            color = _color(rest, color)
        elif word == "map_Kd":
            picture = picture_name(rest)
    keep()
    return found


def pictures(text: str) -> list[str]:
    """Names of the files with the materials' colours."""
    lines = [line.strip().partition(" ") for line in text.splitlines()]
    return [picture_name(rest) for word, _, rest in lines if word == "map_Kd"]


def picture_name(rest: str) -> str:
    """The file in the values of a map, after its options; it may have spaces."""
    words = rest.split()
    place = 0
    while place < len(words) and words[place].lower() in _OPTIONS:
        most = _OPTIONS[words[place].lower()]
        place += 1
        if most == 1:
            place += 1
            continue
        while most and place < len(words) and _is_number(words[place]):
            place, most = place + 1, most - 1
    return rest.strip().split(maxsplit=place)[place] if place < len(words) else ""


def _color(rest: str, before: tuple[float, float, float]) -> tuple[float, float, float]:
    words = rest.split()
    if len(words) not in (1, 3) or not all(map(_is_number, words)):
        return before  # a spectral curve or CIE coordinates
    return linear_color([float(word) for word in (words * 3)[:3]])


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
