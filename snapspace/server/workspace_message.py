"""The message with the workspace of a page."""

from __future__ import annotations

from dataclasses import dataclass

from .message_parts import HandleChoice, MaterialChoice, PartChoice, Vector


@dataclass(frozen=True, kw_only=True)
class Workspace:
    """Server: the workspace of the page. The first message, sent again after an upload.

    A page that reconnects gets its choices back; the newest `Model` and last `Progress` follow.

    id : part of the address of uploads, POST mesh?workspace=ID&name=FILE&request=N&token=..., and
        of the websocket of a page that reconnects, live?workspace=ID&token=...
    kind : "empty": the page asks for a mesh; "reading": progress and another workspace follow;
        "surface": the surface can only be viewed yet, and progress of filling it and a workspace of
        its tets, or `Failed`, follow; "mesh": handles can be chosen; "model": the page's own model,
        number 0, can be polished
    name : name of the mesh or model
    mesh : address of the packed mesh, the same while it is filled and afterwards; null unless the
        kind is surface or mesh
    up : axis that points up at first, x, y or z
    handles, parts, translation, angle : initial choices
    diagonal : diagonal of the mesh; 0 if there is none
    target_error, most_samples, seed, stiffness, material, poisson : initial values for `Compute`
    materials : materials that can be chosen
    solid_material, shell_material : kinds of the initial materials of a solid and of a shell
    folder : folder where `Save` writes, to show to the reader
    upload_limit : largest upload, in bytes
    own_poisson : Poisson's ratio that the page chose instead of `poisson`; null: none
    job : request of the last `Compute` or `Extend` for this mesh; 0 if there was none
    is_running : whether that request is still running
    has_model : whether a model of that request follows
    has_surface : whether the mesh came as a surface, so that `Check` examines it
    thickness : thickness of the shell; null: a solid
    usual_thickness : initial thickness if a solid becomes a shell; null: it came as tets
    is_filled : whether there are tets instead of only a surface
    is_open : whether the surface is a shell with holes, which filling would close
    notices : what was mended or left out when the mesh was made, or is not shown, one sentence each
    """

    id: str
    kind: str
    name: str
    mesh: str | None
    up: str
    handles: tuple[HandleChoice, ...]
    translation: Vector
    angle: Vector
    diagonal: float
    target_error: float
    seed: int
    stiffness: float
    materials: tuple[MaterialChoice, ...]
    material: str
    solid_material: str
    shell_material: str
    poisson: float | None
    folder: str
    upload_limit: int
    parts: tuple[PartChoice, ...] = ()
    most_samples: int | None = None
    own_poisson: float | None = None
    job: int = 0
    is_running: bool = False
    has_model: bool = False
    has_surface: bool = False
    thickness: float | None = None
    usual_thickness: float | None = None
    is_filled: bool = False
    is_open: bool = False
    notices: tuple[str, ...] = ()
