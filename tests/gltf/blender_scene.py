"""The part of Blender (bpy and mathutils) that the scripts of write_blender use."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.transform import Rotation


class Points:
    """Vertices of a mesh or a key."""

    def __init__(self, places: Any) -> None:
        self.places = np.array(places, np.float32)

    def __len__(self) -> int:
        return len(self.places)

    def foreach_get(self, what: str, into: np.ndarray) -> None:
        assert what == "co" and into.dtype == np.float32
        into[:] = self.places.ravel()

    def foreach_set(self, what: str, values: np.ndarray) -> None:
        assert what == "co" and values.dtype == np.float32
        self.places = np.array(values).reshape(-1, 3)


class Mesh:
    def __init__(self, name: str) -> None:
        self.name, self.faces, self.shape_keys = name, [], None
        self.vertices = Points(np.zeros((0, 3)))

    def from_pydata(self, points: Any, edges: Any, faces: Any) -> None:
        self.vertices, self.faces = Points(points), faces

    def shade_smooth(self) -> None: ...

    def update(self) -> None: ...


class Object:
    def __init__(self, name: str, mesh: Mesh, world: np.ndarray | None = None) -> None:
        self.name, self.data, self.type = name, mesh, "MESH"
        self.rotation_euler = (0.0, 0.0, 0.0)
        self.matrix_world = np.eye(4)
        self.matrix_world[:3, :3] = np.eye(3) if world is None else world

    def shape_key_add(self, name: str, from_mix: bool) -> Any:
        if self.data.shape_keys is None:
            self.data.shape_keys = SimpleNamespace(key_blocks=Blocks())
        key = SimpleNamespace(name=name, value=0.0, data=Points(self.data.vertices.places))
        self.data.shape_keys.key_blocks.append(key)
        return key

    @property
    def keys(self) -> list[Any]:
        keys = self.data.shape_keys
        return [] if keys is None else keys.key_blocks

    def shape(self) -> np.ndarray:
        """The sum of the keys, as Blender draws it."""
        basis, *others = [key.data.places.astype(float) for key in self.keys]
        values = [key.value for key in self.keys[1:]]
        return basis + sum(v * (k - basis) for v, k in zip(values, others, strict=True))


class Blocks(list[Any]):
    def get(self, name: str) -> Any:
        return next((key for key in self if key.name == name), None)


class KDTree:
    def __init__(self, size: int) -> None:
        self._places = np.zeros((size, 3))

    def insert(self, place: Any, number: int) -> None:
        self._places[number] = place

    def balance(self) -> None:
        self._tree = cKDTree(self._places)

    def find(self, place: Any) -> tuple[Any, int, float]:
        distance, number = self._tree.query(place)
        return self._places[number], int(number), float(distance)


class Scene:
    """A scene whose active object and mode tests may set."""

    def __init__(self) -> None:
        self.objects: list[Any] = []
        self.data = SimpleNamespace(
            meshes=SimpleNamespace(new=Mesh), objects=SimpleNamespace(new=Object)
        )
        self.active = SimpleNamespace(active=None)
        collection = SimpleNamespace(objects=SimpleNamespace(link=self.objects.append))
        self.context = SimpleNamespace(
            mode="OBJECT",
            view_layer=SimpleNamespace(objects=self.active),
            scene=SimpleNamespace(collection=collection, objects=self.objects),
        )
        self.ops = SimpleNamespace(object=SimpleNamespace(mode_set=self._mode_set))

    def _mode_set(self, mode: str) -> None:
        self.context.mode = mode

    def add(self, points: Any, world: np.ndarray | None = None) -> Object:
        """A user's own mesh, and the matrix (3, 3) that puts it into the scene."""
        mesh = Mesh("own")
        mesh.vertices = Points(points)
        self.objects.append(Object("own", mesh, world))
        return self.objects[-1]

    def run(self, path: Path) -> Object:
        """Runs a script; the object that has the keys."""
        code = compile(path.read_text(encoding="utf-8"), str(path), "exec")
        names: dict[str, Any] = {"__name__": "__main__"}
        exec(code, names)
        found: Object = names["active"]
        return found

    @property
    def modules(self) -> dict[str, Any]:
        """What scripts import."""
        tree = SimpleNamespace(KDTree=KDTree)
        return {
            "bpy": self,
            "mathutils": SimpleNamespace(Euler=_euler),
            "mathutils.kdtree": tree,
        }


def _euler(angles: Any) -> Any:
    return SimpleNamespace(to_matrix=lambda: Rotation.from_euler("xyz", angles).as_matrix())
