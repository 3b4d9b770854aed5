"""The material of a problem file: its model, its moduli, and regions with other moduli."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..material import DEFAULT_MATERIAL, Material, StVK, default_material, material_class
from ..mesh import Body, ShellMesh
from .json_entries import as_list, as_number, as_object, as_text, within
from .material_regions import regions_content, with_regions
from .moduli_entries import NAMES, Value, moduli_of

_MODEL, _REGIONS = "model", "regions"


def material_from(value: Any, mesh: Body) -> Material:
    """The material of the entry "material" of a file.

    Parameters
    ----------
    value : object
        {"model": kind, moduli by name} or {"model": kind, "young", "poisson"}, settings by name,
        and "regions", see `with_regions`. Values of moduli are numbers, or lists with one number
        per tet; missing ones have the default of the class. Without "model" the material is stable
        neo-Hookean. Without moduli as well it is the default of the body, which for shells is
        `ARAP` with a radius. But if there is only "lam" or "mu", it is St.Venant-Kirchhoff, since
        old files named no model.
    mesh : TetMesh or ShellMesh

    Raises
    ------
    ValueError
        For an unknown model, an entry that is mistyped or that the model does not have, moduli that
        are out of range or for another number of tets, or a faulty region. The message names the
        entry.
    """
    content = as_object(value, "material")
    usual = default_material(surface=isinstance(mesh, ShellMesh))
    if not content.keys() - {_REGIONS, *usual.setting_names()}:
        content = {_MODEL: usual.kind, **usual.settings, **content}
    with within("material"):
        kind = _class_of(content)
    settings = kind.setting_names()
    as_object(content, "material", known={_MODEL, _REGIONS, *NAMES, *kind.names(), *settings})
    others = (_MODEL, _REGIONS, *settings)
    entries = {key: entry for key, entry in content.items() if key not in others}
    with within("material"):
        given = {name: as_number(content[name], name) for name in settings if name in content}
        material = kind(**moduli_of(entries, kind, of_each=_one_or_per_tet), **given)
        material.check_tets(len(mesh.cells), kind.__name__)
    return with_regions(material, as_list(content.get(_REGIONS, []), "material.regions"), mesh)


def material_content(material: Material) -> dict[str, Any]:
    """The entry "material" from which `material_from` makes the same material.

    Moduli that differ from tet to tet become regions if they have few different values, and
    otherwise lists.
    """
    content: dict[str, Any] = {_MODEL: material.kind}
    names, rows = material.names(), material.moduli
    base, regions = regions_content(rows, names)
    if base is not None:
        content |= dict(zip(names, base.tolist(), strict=True)) | material.settings
        return content | ({_REGIONS: regions} if regions else {})
    for name, column in zip(names, rows.T, strict=True):
        content[name] = column.tolist() if np.ptp(column) else float(column[0])
    return content | material.settings


def _class_of(content: dict[str, Any]) -> type[Material]:
    if _MODEL in content:
        return material_class(as_text(content[_MODEL], _MODEL))
    named = content.keys() & set(StVK.names())
    if not named:
        return DEFAULT_MATERIAL
    others = content.keys() - named
    if others:
        raise ValueError(
            f"'{min(named)}' without 'model' means {StVK.kind}, as in old files, which had no "
            f"'{min(others)}'; name the model"
        )
    return StVK


def _one_or_per_tet(value: Any, what: str) -> Value:
    if not isinstance(value, list):
        return as_number(value, what)
    return np.array([as_number(item, f"{what}[{i}]") for i, item in enumerate(value)])
