"""A user's .obj file of the bar's surface, with materials, a texture and sharp edges."""

from __future__ import annotations

import io
from dataclasses import replace

from PIL import Image

from snapspace import PosingModel
from snapspace.mesh import SurfaceFile, compact_surface

RED, BLUE = (220, 30, 30), (30, 40, 220)


def picture(*halves: tuple[int, int, int], width: int = 8) -> bytes:
    """A PNG whose upper half has one colour and whose lower half the other one."""
    image = Image.new("RGB", (width, 8), halves[0])
    image.paste(halves[1], (0, 4, width, 8))
    file = io.BytesIO()
    image.save(file, "PNG")
    return file.getvalue()


def own_file(model: PosingModel, *, creases: bool = False) -> SurfaceFile:
    """The surface as OBJ: the texture's red half over one half of the length, blue over the other.

    The last faces have a green material.
    """
    mesh = model.problem.mesh
    vertices, faces = compact_surface(mesh.vertices, mesh.surface)
    along = vertices[:, 0] - vertices[:, 0].min()
    lines = ["mtllib own.mtl", *(f"v {x!r} {y!r} {z!r}" for x, y, z in vertices.tolist())]
    lines += [f"vt 0.5 {share:.4f}" for share in (along / along.max()).tolist()]
    lines += [f"vn 0 0 {1 + number}" for number in range(len(faces))]
    for number, face in enumerate((faces + 1).tolist()):
        if number in (0, len(faces) - 4):
            lines.append(f"usemtl {'skin' if number == 0 else 'cap'}")
        end = f"/{number + 1}" if creases else ""
        lines.append("f " + " ".join(f"{v}/{v}{end}" for v in face))
    mtl = b"newmtl skin\nmap_Kd own.png\nnewmtl cap\nKd 0.08 0.63 0.24\n"
    beside = {"own.mtl": mtl, "own.png": picture(RED, BLUE)}
    return SurfaceFile("own.obj", "\n".join(lines).encode(), beside=beside)


def with_file(model: PosingModel, file: SurfaceFile) -> PosingModel:
    return replace(model, surface=replace(model.surface, source=file))
