"""Baking: the solved film as shape keys with keyframes, for use without the extension."""

from collections.abc import Iterator

import bpy
import numpy as np

from snapspace.gltf import sliders

from . import live
from .mesh_data import BAKED, RESULT, baked_keys, rest_points, write_key
from .principal_shapes import principal_shapes


class SNAPSPACE_OT_bake(bpy.types.Operator):
    """Solve every frame of the scene, and bake it into shape keys that play without Snapspace"""

    bl_idname = "snapspace.bake"
    bl_label = "Bake"
    bl_options = {"REGISTER", "UNDO"}

    tolerance: bpy.props.FloatProperty(
        name="Tolerance",
        description="Largest error of a vertex in any frame, as a share of the mesh's diagonal",
        default=1e-4,
        min=1e-6,
        max=0.1,
        precision=6,
    )
    most: bpy.props.IntProperty(
        name="Most shape keys",
        description="Limit, even if the tolerance needs more keys; one of them may be an offset",
        default=64,
        min=2,
        max=500,
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        owner = context.object
        known = owner is not None and owner.type == "MESH" and bool(owner.snapspace.model)
        return known and owner.mode == "OBJECT"

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
            np.array(film) - rest, tolerance=self.tolerance * diagonal, most=self.most - 1
        )
        mix, values = sliders(found.values)
        shapes = np.tensordot(mix, found.shapes, axes=1)
        _write(owner, rest, shapes, values, frames)
        share = found.error / diagonal
        self.report({"INFO"}, f"{len(shapes)} shape keys, at most {share:.1e} of the diagonal off")
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
    """Replaces earlier baked keys, and switches the live shape off, so that both do not add up."""
    owner.snapspace.live = False
    for key in baked_keys(owner):
        _forget_motion(key)
        owner.shape_key_remove(key)
    owner.data.shape_keys.key_blocks[RESULT].value = 0.0
    for number, shape in enumerate(shapes):
        key = owner.shape_key_add(name=f"{BAKED} {number}", from_mix=False)
        write_key(key, rest + shape)
        for frame, value in zip(frames, values[:, number], strict=True):
            key.value = value
            key.keyframe_insert("value", frame=frame)
    owner.data.update()


def _forget_motion(key: bpy.types.ShapeKey) -> None:
    """Removes the keyframes of a key, which a new key of the same name would inherit."""
    path = key.path_from_id("value")
    for curves in _curves(key.id_data):
        for curve in [curve for curve in curves if curve.data_path == path]:
            curves.remove(curve)


def _curves(keys: bpy.types.Key) -> Iterator[bpy.types.bpy_prop_collection]:
    """The animation curves of the keys. Since 5.0 Blender stores them by slots of an action."""
    animation = keys.animation_data
    action = None if animation is None else animation.action
    if action is None:
        return
    if bpy.app.version < (5, 0, 0):
        yield action.fcurves
        return
    for strip in (strip for layer in action.layers for strip in layer.strips):
        for bag in strip.channelbags:
            if bag.slot_handle == animation.action_slot_handle:
                yield bag.fcurves


def register() -> None:
    bpy.utils.register_class(SNAPSPACE_OT_bake)


def unregister() -> None:
    bpy.utils.unregister_class(SNAPSPACE_OT_bake)
