"""Makes the pictures of the Blender extension: rendered by Blender itself, without a window.

Needs bpy (pip install bpy==4.2.0, with Python 3.11), which is under the GPL.

python docs/make_blender_pictures.py
"""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils import Vector
from pictures_creature import creature_problem

sys.path.insert(0, str(Path(__file__).parents[1]))

import blender
from snapspace.generators import bar

FOLDER = Path(__file__).parent / "pictures"
SIZE = (960, 540)
SAMPLES = 48
CLAY, DOT, PALE = (0.72, 0.62, 0.5), (0.85, 0.25, 0.12), (0.35, 0.45, 0.62)


def empty_scene() -> Any:
    """A scene with light, ground and nothing else."""
    bpy.ops.wm.read_homefile(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = SAMPLES, False
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.view_settings.view_transform = "Standard"
    world = bpy.data.worlds.new("world")
    scene.world = world
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs[0].default_value = (0.9, 0.93, 1.0, 1.0)
    world.node_tree.nodes["Background"].inputs[1].default_value = 0.55
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.data.angle = 2.4, math.radians(8)
    sun.rotation_euler = (math.radians(48), math.radians(8), math.radians(35))
    scene.collection.objects.link(sun)
    return scene


def material(color: tuple[float, float, float]) -> Any:
    made = bpy.data.materials.new("clay")
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*color, 1.0)
    shader.inputs["Roughness"].default_value = 0.6
    return made


def mesh_object(
    name: str, points: np.ndarray, faces: np.ndarray, color: tuple[float, float, float] = CLAY
) -> Any:
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points.tolist(), [], faces.tolist())
    mesh.shade_smooth()
    mesh.materials.append(material(color))
    made = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    return made


def dot(place: Any, radius: float) -> None:
    """A ball where an empty is: renders do not show empties."""
    bpy.ops.mesh.primitive_uv_sphere_add(radius=radius, location=place, segments=48, ring_count=24)
    ball = bpy.context.object
    ball.data.shade_smooth()
    ball.data.materials.append(material(DOT))


def render(scene: Any, name: str, points: np.ndarray, direction: Vector) -> None:
    """Looks at points from a direction, with a ground below them."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, diagonal = Vector((low + high) / 2), float(np.linalg.norm(high - low))
    bpy.ops.mesh.primitive_plane_add(size=60 * diagonal, location=(middle.x, middle.y, low[2]))
    bpy.context.object.data.materials.append(material((0.82, 0.81, 0.79)))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.lens = 60
    camera.location = middle + 2.1 * diagonal * direction.normalized()
    camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.filepath = str(FOLDER / f"{name}.png")
    bpy.ops.render.render(write_still=True)


def shown(owner: Any) -> np.ndarray:
    """Points of the mesh after shape keys, in the world."""
    bpy.context.view_layer.update()
    mesh = owner.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    return np.array([owner.matrix_world @ vertex.co for vertex in mesh.vertices])


def posed() -> None:
    """A creature whose head and tail were moved by their empties."""
    scene = empty_scene()
    problem = creature_problem(12_000)
    mesh = problem.mesh
    used, faces = np.unique(mesh.surface, return_inverse=True)
    owner = mesh_object("creature", mesh.vertices[used], faces.reshape(-1, 3))
    for handle in problem.handles:
        group = owner.vertex_groups.new(name=handle.name)
        group.add(np.flatnonzero(np.isin(used, handle.vertices)).tolist(), 1.0, "REPLACE")
    assert bpy.ops.snapspace.compute() == {"FINISHED"}
    empties = {child["snapspace_handle"]: child for child in owner.children}
    for empty, angle in zip(list(empties.values())[1:], (0.45, -0.5), strict=False):
        empty.rotation_euler = (0.0, angle, 0.5 * angle)
        empty.location.z += 0.1 * mesh.diagonal
    points = shown(owner)
    for empty in empties.values():
        dot(empty.matrix_world.translation, 0.022 * mesh.diagonal)
    render(scene, "blender-posed", points, Vector((0.5, -1.0, 0.45)))


def blended() -> None:
    """A bar half way between straight and bent: along lines, and elastically."""
    scene = empty_scene()
    body = bar(20, 4, 4, length=4.0, width=0.7, height=0.7)
    used, faces = np.unique(body.surface, return_inverse=True)
    rest, faces = body.vertices[used] - [2.0, 0.35, 0.0], faces.reshape(-1, 3)
    owner = mesh_object("elastic", rest, faces)
    owner.shape_key_add(name="Basis", from_mix=False)
    key = owner.shape_key_add(name="bent", from_mix=False)
    bent = _bent(rest, 2.6)
    key.data.foreach_set("co", bent.astype(np.float32).ravel())
    owner.snapspace.edge_length = 0.06
    assert bpy.ops.snapspace.compute_blend() == {"FINISHED"}
    owner.data.shape_keys.key_blocks["bent"].value = 0.5
    owner.location.y -= 1.1
    straight = mesh_object("straight", 0.5 * (rest + bent), faces, PALE)
    straight.location.y += 1.1
    points = np.concatenate([shown(owner), shown(straight)])
    render(scene, "blender-blend", points, Vector((0.35, -1.0, 0.6)))


def _bent(points: np.ndarray, angle: float) -> np.ndarray:
    """A bar along x, bent upwards by an angle."""
    radius = 4.0 / angle
    turn = angle * points[:, 0] / 4.0
    away = radius - points[:, 2]
    return np.stack([away * np.sin(turn), points[:, 1], radius - away * np.cos(turn)], axis=1)


if __name__ == "__main__":
    blender.register()
    posed()
    blended()
