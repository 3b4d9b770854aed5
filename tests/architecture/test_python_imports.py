"""Dependencies point one way, as in the design; they are read from the import statements."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

from .allowed_imports import ALLOWED

PACKAGE = Path(__file__).parents[2] / "snapspace"

#: `model.session()`, `save()` and `show()` import upwards, inside the method, for convenience;
#: `snapshot_pca` names the type of its argument.
REACHING_UP = {
    ("reduction", "session"),
    ("reduction", "model_file"),
    ("reduction", "page"),
    ("subspace", "snapshots"),
}

#: The top: may import everything, and nothing may import it.
TOP = {"cli", "__main__", "__init__"}


def package(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py").removesuffix(".pyi")


def modules() -> list[Path]:
    return sorted(path for path in PACKAGE.rglob("*.py") if "__pycache__" not in path.parts)


def imported(node: ast.stmt, path: Path) -> Iterator[str]:
    """Packages of snapspace that an import statement names; '' for snapspace itself."""
    parent = ("snapspace", *path.relative_to(PACKAGE).parent.parts)
    if isinstance(node, ast.Import):
        targets = [alias.name.split(".") for alias in node.names]
    elif isinstance(node, ast.ImportFrom):
        base = list(parent[: len(parent) - node.level + 1]) if node.level else []
        base += node.module.split(".") if node.module else []
        targets = [[*base, alias.name] for alias in node.names]
    else:
        return
    for target in targets:
        if target[0] == "snapspace":
            name = target[1] if len(target) > 1 else ""
            known = (PACKAGE / name).is_dir() or (PACKAGE / f"{name}.py").is_file()
            yield name if known or name == "_cpu_level" else ""


def statements(path: Path) -> Iterator[tuple[ast.stmt, bool]]:
    """All imports of a module; True for those that do not run when the module is loaded."""

    def walk(node: ast.AST, later: bool) -> Iterator[tuple[ast.stmt, bool]]:
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.Import | ast.ImportFrom):
                yield child, later
            in_function = isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
            for_types = isinstance(child, ast.If) and "TYPE_CHECKING" in ast.dump(child.test)
            yield from walk(child, later or in_function or for_types)

    yield from walk(ast.parse(path.read_text(encoding="utf-8")), False)


def violations(path: Path) -> list[str]:
    """Imports of a module that point the wrong way, as 'file:line: package imports package'."""
    own = package(path)
    found = []
    for node, later in statements(path):
        for target in imported(node, path):
            fine = target == own or target in ALLOWED[own]
            fine = fine or (later and (own, target) in REACHING_UP)
            if not fine:
                where = f"{path.relative_to(PACKAGE.parent)}:{node.lineno}"
                found.append(f"{where}: {own} imports {target or 'the whole package'}")
    return found


def test_imports_point_one_way() -> None:
    """The message lists every import that does not."""
    checked = [path for path in modules() if package(path) not in TOP]
    assert [fault for path in checked for fault in violations(path)] == []


def test_every_package_is_in_the_table() -> None:
    """A new package must be added to the table above."""
    packages = {package(path) for path in modules()}
    assert packages - TOP == set(ALLOWED)


def test_the_table_has_no_cycle() -> None:
    """With a cycle, "one way" would mean nothing."""
    left = {name: set(below) for name, below in ALLOWED.items()}
    while left:
        free = [name for name, below in left.items() if not below & set(left)]
        assert free, f"a cycle among {sorted(left)}"
        for name in free:
            del left[name]


def test_nothing_imports_the_top() -> None:
    for path in modules():
        if package(path) not in TOP:
            for node, _ in statements(path):
                assert not set(imported(node, path)) & (TOP | {""}), path


@pytest.mark.parametrize(
    ("module", "line", "problem"),
    [
        ("mesh/read.py", "from ..problem import Handles", "mesh imports problem"),
        ("energy/elastic_energy.py", "import snapspace.snapshots.solve", "energy imports snap"),
        ("sampling.py", "from .problem.handle_box import HandleBox", "sampling imports problem"),
        ("generators/bar.py", "from snapspace import TetMesh", "generators imports the whole p"),
        ("snapshots/solve.py", "from .. import reduction", "snapshots imports reduction"),
        ("reduction/quartic.py", "from ..session import Session", "reduction imports session"),
        (
            "session/session.py",
            "def f():\n    from ..validation import validate",
            "session imports valid",
        ),
    ],
)
def test_the_check_finds_a_wrong_import(
    monkeypatch: pytest.MonkeyPatch, module: str, line: str, problem: str
) -> None:
    path = PACKAGE / module
    assert violations(path) == []
    monkeypatch.setattr(Path, "read_text", lambda self, encoding: line)
    (found,) = violations(path)
    assert problem in found
