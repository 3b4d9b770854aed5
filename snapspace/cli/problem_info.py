"""Figures of posing problems."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ..problem import PosingProblem, read_problem
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
    bounds = problem.domain.half_widths[:6]
    return {
        "handles": [
            {"name": handle.name, "vertices": len(handle.vertices), "moves": number > 0}
            for number, handle in enumerate(problem.handles)
        ],
        "parameters": problem.parameter_count,
        "material": {"model": "stvk", "lam": problem.material.lam, "mu": problem.material.mu},
        "stiffness": problem.stiffness,
        "domain": {
            "translation": bounds[:3].tolist(),
            "angle_degrees": np.rad2deg(bounds[3:]).tolist(),
        },
    }


def problem_facts(figures: dict[str, Any]) -> list[tuple[str, str]]:
    """The same for people."""
    material, domain = figures["material"], figures["domain"]
    handles = [
        (
            "" if number else "handles",
            f"{handle['name']}: {handle['vertices']} vertices, "
            + ("moves" if handle["moves"] else "fixed"),
        )
        for number, handle in enumerate(figures["handles"])
    ]
    return [
        *handles,
        ("parameters", str(figures["parameters"])),
        (
            "domain",
            f"translation up to {_bounds(domain['translation'])}, "
            f"angles up to {_bounds(domain['angle_degrees'])} degrees",
        ),
        (
            "material",
            f"St.Venant-Kirchhoff, lam {material['lam']:g}, mu {material['mu']:g}; "
            f"handle stiffness {figures['stiffness']:g}",
        ),
    ]


def _bounds(values: list[float]) -> str:
    texts = [f"{value:.6g}" for value in values]
    return texts[0] if len(set(texts)) == 1 else ", ".join(texts)
