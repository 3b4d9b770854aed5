"""`snapspace check`: says what is wrong with a surface or a mesh, and mends it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from ..doctor import Finding, MendedSurface, SurfaceReport, check_surface, mend_surface
from ..mesh import open_surface, read_tets, write_surface, write_tets
from ..mesh.input_path import existing_file, writable_path
from ..point_text import corner_texts
from .console import notice, print_facts, print_json, print_next
from .files import SURFACE_INPUTS, SURFACE_OUTPUTS, TET_INPUTS, TET_OUTPUTS
from .mesh_info import mesh_info
from .options import FILE, json_option
from .own_surface import is_plain
from .progress import spinner

FINE, FAULTS = 0, 1
#: Thickness of a shell in the advice, as a share of the diagonal. With the default material, the
#: thickness is only a factor.
SHELL = 0.01


@click.command(short_help="Say what is wrong with a surface or mesh, and mend it.")
@click.argument("file", type=FILE)
@click.option(
    "--fix",
    "output",
    type=FILE,
    metavar="OUT",
    help="Mend what is safe and write it: merge equal points, drop useless faces, orient faces "
    "consistently, close flat and small holes. A surface as .obj, .ply, .off, .stl (triangles "
    "only), or tets as .msh, .vtu, .vtk, .mesh.",
)
@json_option
@click.pass_context
def check(ctx: click.Context, /, file: Path, output: Path | None, as_json: bool) -> None:
    """Say what is wrong with a surface, what it means, and what to do.

    The exit code is 0 if nothing needs mending, and 1 otherwise; with --fix it is that of the
    mended surface. A tet mesh is checked as in `info`.

    \b
    Examples:
      snapspace check scan.stl
      snapspace check scan.stl --fix mended.obj
      snapspace check scan.stl --json
    """
    existing_file(file, known=(*SURFACE_INPUTS, *TET_INPUTS))
    tets = file.suffix.lower() in TET_INPUTS
    if output is not None:
        writable_path(output, known=TET_OUTPUTS if tets else SURFACE_OUTPUTS)
    figures = _tets(file, output) if tets else _surface(file, output)
    if as_json:
        print_json({"file": str(file), **figures})
    ctx.exit(FINE if figures.get("mended", figures)["fine"] else FAULTS)


def _surface(file: Path, output: Path | None) -> dict[str, Any]:
    source = open_surface(file)
    vertices, faces = source.vertices, source.faces
    with spinner("checking the surface"):
        report = check_surface(vertices, faces)
    _print(f"{file}: surface", report)
    figures: dict[str, Any] = {"kind": "surface", **report.as_json()}
    if output is not None:
        mended = mend_surface(vertices, faces)
        left = check_surface(mended.vertices, mended.faces)
        write_surface(output, mended.vertices, mended.faces)
        for note in mended.notes or ("there was nothing to mend",):
            notice(note)
        if not is_plain(source):
            notice(
                f"notice: {output} has triangles and positions only; `build` and `view` mend "
                f"{file.name} when they fill it, and keep all that it has"
            )
        _print(f"{output}: mended", left)
        figures["mended"] = {**left.as_json(), **_mending(mended), "output": str(output)}
    else:
        print_next(_suggestions(file, report))
    return figures


def _suggestions(file: Path, report: SurfaceReport) -> list[tuple[str, list[str | Path]]]:
    """What to try next."""
    commands: list[tuple[str, list[str | Path]]] = []
    if any(finding.mended and finding.fault for finding in report.findings):
        commands.append(("mend it", ["check", file, "--fix", f"{file.stem}-mended.obj"]))
    if any(finding.details.get("sheet") for finding in report.findings):
        commands.append(("pose it as a thin shell, open as it is", ["view", file]))
        thickness = f"{SHELL * report.diagonal:.2g}"
        blend: list[str | Path] = ["interpolate", file, f"pose{file.suffix}", "--shell", thickness]
        blend += ["-o", f"{file.stem}.snapspace"]
        commands.append(("blend it with other poses as a thin shell", blend))
    return commands


def _tets(file: Path, output: Path | None) -> dict[str, Any]:
    figures, facts = mesh_info(file)
    print_facts(f"{file}: tet mesh", facts)
    result: dict[str, Any] = {**figures, "fine": figures["valid"]}
    if output is not None:
        write_tets(output, read_tets(file, repair=True))
        result["mended"] = {"fine": True, "notes": figures["repairs"], "output": str(output)}
    return result


def _mending(mended: MendedSurface) -> dict[str, Any]:
    return {
        "notes": list(mended.notes),
        "invented_faces": mended.invented,
        "invented_area": mended.invented_area,
    }


def _print(title: str, report: SurfaceReport) -> None:
    volume = "none: it is not closed" if report.volume is None else f"{report.volume:.6g}"
    facts = [
        ("vertices", str(report.vertices)),
        ("faces", str(report.faces)),
        ("bounds", f"{' to '.join(corner_texts(*report.bounds))}, diagonal {report.diagonal:.6g}"),
        ("area", f"{report.area:.6g}"),
        ("volume", volume),
    ]
    facts += [_line(finding) for finding in report.findings]
    facts.append(("result", "ready to be filled" if report.fine else "needs mending"))
    print_facts(title, facts)


def _line(finding: Finding) -> tuple[str, str]:
    mark = "fault: " if finding.fault else ""
    return finding.name, f"{mark}{finding.text}\n{finding.meaning}\nwhat to do: {finding.cure}"
