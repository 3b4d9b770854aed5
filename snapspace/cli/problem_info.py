"""Numbers about posing problems, for `info`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..problem import PosingProblem, read_problem
from ..problem.domain_entries import domain_content
from .material_info import material_figures, material_text
from .mesh_info import Info, mesh_facts, mesh_figures


def problem_file_info(file: Path) -> Info:
    """JSON content and facts of a problem file and its mesh; ValueError if one cannot be read."""
    problem = read_problem(file)
    figures = {
        "kind": "problem",
        **problem_figures(problem),
        "mesh": mesh_figures(problem.mesh),
    }
    return figures, problem_facts(figures) + mesh_facts(figures["mesh"])


def problem_figures(problem: PosingProblem) -> dict[str, Any]:
    """Handles, material and domain, for JSON."""
    common, bounds = problem.domain.common, problem.domain.bounds
    moves = [False, *(bool(row.any()) for row in bounds)]
    handles: list[dict[str, Any]] = [
        {"name": handle.name, "vertices": len(handle.vertices), "moves": moving}
        for handle, moving in zip(problem.handles, moves, strict=True)
    ]
    for handle, row in zip(handles[1:], bounds, strict=True):
        if handle["moves"] and (row != common.bounds[0]).any():
            handle["domain"] = domain_content(row)
    return {
        "handles": handles,
        "parameters": problem.parameter_count,
        "material": material_figures(problem.material),
        "stiffness": problem.stiffness,
        "domain": domain_content(common.bounds[0]),
    }


def problem_facts(figures: dict[str, Any]) -> list[tuple[str, str]]:
    """The same as lines for the user."""
    handles = [
        (
            "" if number else "handles",
            f"{handle['name']}: {handle['vertices']} vertices, "
            + ("moves" if handle["moves"] else "fixed")
            + (f", {_domain(handle['domain'])}" if "domain" in handle else ""),
        )
        for number, handle in enumerate(figures["handles"])
    ]
    return [
        *handles,
        ("parameters", str(figures["parameters"])),
        ("domain", _domain(figures["domain"])),
        (
            "material",
            f"{material_text(figures['material'])}; handle stiffness {figures['stiffness']:g}",
        ),
    ]


def _domain(domain: dict[str, list[float]]) -> str:
    return (
        f"translation up to {_bounds(domain['translation'])}, "
        f"angles up to {_bounds(domain['angle_degrees'])} degrees"
    )


def _bounds(values: list[float]) -> str:
    texts = [f"{value:.6g}" for value in values]
    return texts[0] if len(set(texts)) == 1 else ", ".join(texts)
