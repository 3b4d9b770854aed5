"""Operators that make models, in a thread, so that Blender stays usable meanwhile."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Iterator

import bpy

import snapspace as ss
from snapspace.stopping import Stopped, stoppable

from . import live, models
from .empties import check_alone, make_empties
from .mesh_data import (
    check_scale,
    handle_vertices,
    key_points,
    pose_keys,
    rest_points,
    result_key,
    triangles,
)
from .problems import Motions, blending_growths, posing_growths, solid_of

Growths = Iterator[ss.Growth]
INTERVAL = 0.1  # seconds between two checks for news


def posing_work(owner: bpy.types.Object) -> Callable[[], Growths]:
    """A function that computes a model of the vertex groups; ValueError for an unusable object."""
    check_scale(owner)
    check_alone(owner)
    settings, handles = owner.snapspace, handle_vertices(owner)
    points, faces = rest_points(owner.data), triangles(owner.data)
    motions = Motions(settings.translation, settings.angle)
    options = {"target_error": settings.error / 100}
    edge_length = settings.edge_length
    return lambda: posing_growths(
        solid_of(points, faces, edge_length=edge_length), handles, motions, **options
    )


def blending_work(owner: bpy.types.Object) -> Callable[[], Growths]:
    """A function that computes a model of the shape keys; ValueError for an unusable object."""
    check_scale(owner)
    points, faces = rest_points(owner.data), triangles(owner.data)
    poses = {key.name: key_points(key) for key in pose_keys(owner)}
    options = {"target_error": owner.snapspace.error / 100}
    edge_length = owner.snapspace.edge_length
    return lambda: blending_growths(
        solid_of(points, faces, edge_length=edge_length), poses, **options
    )


class _Computation:
    """A computation in a thread. `news` gets the growths, any Exception, and None at the end."""

    def __init__(self, work: Callable[[], Growths]) -> None:
        self.news: queue.SimpleQueue[ss.Growth | Exception | None] = queue.SimpleQueue()
        self._cancelled = threading.Event()
        self._thread = threading.Thread(target=self._run, args=(work,), daemon=True)
        self._thread.start()

    def cancel(self) -> None:
        self._cancelled.set()

    def _run(self, work: Callable[[], Growths]) -> None:
        try:
            with stoppable(self._cancelled.is_set):
                for growth in work():
                    self.news.put(growth)
        except Stopped:
            pass
        except Exception as error:  # shown to the user
            self.news.put(error)
        self.news.put(None)


class _Compute:
    """What both operators share: they show each better model, and store the last one."""

    bl_options = {"REGISTER"}
    work: Callable[[bpy.types.Object], Callable[[], Growths]]

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        owner = context.object
        return owner is not None and owner.type == "MESH" and owner.mode == "OBJECT"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Computes to the end before it returns."""
        owner = context.object
        try:
            *_, best = type(self).work(owner)()
        except ValueError as error:
            return self._refuse(str(error))
        self._finish(context, owner, best)
        return {"FINISHED"}

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Computes in a thread; Escape keeps the best model so far."""
        owner = context.object
        try:
            work = type(self).work(owner)
        except ValueError as error:
            return self._refuse(str(error))
        self._owner, self._best = owner, None
        self._computation = _Computation(work)
        self._timer = context.window_manager.event_timer_add(INTERVAL, window=context.window)
        context.window_manager.modal_handler_add(self)
        owner.snapspace.status = "Computing"
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == "ESC":
            self._computation.cancel()
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        while not self._computation.news.empty():
            news = self._computation.news.get()
            if isinstance(news, Exception):
                self._end(context)
                return self._refuse(str(news))
            if news is None:
                self._end(context)
                if self._best is None:
                    return self._refuse("cancelled before there was a model")
                self._finish(context, self._owner, self._best)
                return {"FINISHED"}
            self._best = news
            self._show(context, self._owner, news)
        return {"PASS_THROUGH"}

    def _end(self, context: bpy.types.Context) -> None:
        context.window_manager.event_timer_remove(self._timer)

    def _refuse(self, reason: str) -> set[str]:
        self.report({"ERROR"}, reason)
        return {"CANCELLED"}

    def _finish(self, context: bpy.types.Context, owner: bpy.types.Object, best: ss.Growth) -> None:
        self._show(context, owner, best)
        path = models.store(owner, best.model)
        live.forget()
        live.update(owner, context.evaluated_depsgraph_get())
        self.report({"INFO"}, f"{owner.snapspace.status}; {path}")

    def _show(self, context: bpy.types.Context, owner: bpy.types.Object, growth: ss.Growth) -> None:
        model = growth.model
        owner.snapspace.live = True  # baking has switched it off
        result_key(owner)
        models.show(owner, model)
        if isinstance(model, ss.PosingModel):
            problem = model.problem
            make_empties(owner, problem.handles.names, problem.centroids, problem.mesh.diagonal)
        else:
            for key in pose_keys(owner):
                key.mute = True  # its value is a weight; it must not be added to the solved shape
        owner.snapspace.status = _said(growth)
        context.view_layer.update()


def _said(growth: ss.Growth) -> str:
    error = "" if growth.step is None else f", error {100 * growth.step.error:.2g} %"
    more = "" if growth.final else ", improving"
    return f"{growth.model.dimension} dimensions{error}{more}"


class SNAPSPACE_OT_compute(_Compute, bpy.types.Operator):
    """Make a model with the vertex groups as handles, and empties that move the handles"""

    bl_idname = "snapspace.compute"
    bl_label = "Compute"
    work = staticmethod(posing_work)


class SNAPSPACE_OT_compute_blend(_Compute, bpy.types.Operator):
    """Make a model with the shape keys as poses. Their values are then weights of elastic blends"""

    bl_idname = "snapspace.compute_blend"
    bl_label = "Compute Blends"
    work = staticmethod(blending_work)


_CLASSES = (SNAPSPACE_OT_compute, SNAPSPACE_OT_compute_blend)


def register() -> None:
    for one in _CLASSES:
        bpy.utils.register_class(one)


def unregister() -> None:
    for one in reversed(_CLASSES):
        bpy.utils.unregister_class(one)
