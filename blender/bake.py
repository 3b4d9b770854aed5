"""Baking: the solved film as shape keys with keyframes, for files that need no extension."""

import bpy
import numpy as np

from . import live
from .mesh_data import RESULT, rest_points, write_key
from .principal_shapes import principal_shapes

#: Shape keys that were baked have names that begin with this.
BAKED = "Baked"


class SNAPSPACE_OT_bake(bpy.types.Operator):
    """Solve every frame of the scene, and animate shape keys that show it without Snapspace"""

    bl_idname = "snapspace.bake"
    bl_label = "Bake"
    bl_options = {"REGISTER", "UNDO"}

    tolerance: bpy.props.FloatProperty(
        name="Tolerance",
        description="Largest distance of a vertex from the solved film, as a share of the diagonal",
        default=1e-4,
        min=1e-6,
        max=0.1,
        precision=6,
    )
    most: bpy.props.IntProperty(
        name="Most shape keys",
        description="Even if the tolerance needs more",
        default=64,
        min=1,
        max=500,
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        owner = context.object
        return owner is not None and owner.type == "MESH" and bool(owner.snapspace.model)

    def execute(self, context: bpy.types.Context) -> set[str]:
        owner, scene = context.object, context.scene
        frames = range(scene.frame_start, scene.frame_end + 1, scene.frame_step)
        before = scene.frame_current
        try:
            film = [self._solved(context, owner, frame) for frame in frames]
        except ValueError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            scene.frame_set(before)
        rest = rest_points(owner.data)
        diagonal = float(np.linalg.norm(np.ptp(rest, axis=0)))
        found = principal_shapes(
            np.array(film) - rest, tolerance=self.tolerance * diagonal, most=self.most
        )
        _write(owner, rest, found.shapes, found.values, frames)
        share = found.error / diagonal
        self.report(
            {"INFO"}, f"{len(found.shapes)} shape keys, at most {share:.1e} of the diagonal off"
        )
        return {"FINISHED"}

    def _solved(
        self, context: bpy.types.Context, owner: bpy.types.Object, frame: int
    ) -> np.ndarray:
        context.scene.frame_set(frame)
        live.forget()
        points = live.solved_points(owner, context.evaluated_depsgraph_get())
        assert points is not None
        return points


def _write(
    owner: bpy.types.Object,
    rest: np.ndarray,
    shapes: np.ndarray,
    values: np.ndarray,
    frames: range,
) -> None:
    """Replaces earlier baked keys, and switches the live shape off, so that they do not add up."""
    owner.snapspace.live = False
    blocks = owner.data.shape_keys.key_blocks
    for key in [key for key in blocks if key.name.startswith(BAKED)]:
        owner.shape_key_remove(key)
    blocks[RESULT].value = 0.0
    for number, shape in enumerate(shapes):
        key = owner.shape_key_add(name=f"{BAKED} {number}", from_mix=False)
        write_key(key, rest + shape)
        key.slider_min, key.slider_max = -1.0, 1.0
        for frame, value in zip(frames, values[:, number], strict=True):
            key.value = value
            key.keyframe_insert("value", frame=frame)
    owner.data.update()


def register() -> None:
    bpy.utils.register_class(SNAPSPACE_OT_bake)


def unregister() -> None:
    bpy.utils.unregister_class(SNAPSPACE_OT_bake)
