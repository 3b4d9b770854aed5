"""BodySession: handles, parts, models and files that a page makes from one body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..accurate import MOTIONS
from ..material import Material
from ..mesh import Body as Mesh
from ..page.painted import KEY
from ..problem import PosingProblem, usual_stiffness
from ..reduction import PosingModel, ReducedModel
from . import messages
from .body import Body
from .body_choice import BodyChoice, shown_thickness
from .computation import Computation, Publish
from .computation_queue import ComputationQueue
from .extension import Extension, extension_of
from .first_workspaces import mesh_workspace
from .given_model import GivenModel
from .materials import chosen_material, fitted_material
from .mirroring import Mirroring
from .models import Models, usable_start
from .parts import FloatArray, part_factors, with_factors
from .recorded import recorded
from .reporter import Reporter
from .saving import SavedFiles
from .selection import Selection, selection_of
from .solved_samples import SolvedSamples
from .surface_regions import SurfaceRegions


class BodySession:
    """Chooses handles, computes models and saves files of one body.

    Parameters
    ----------
    body : Body
    models : Models
        The page's models.
    """

    def __init__(self, body: Body, models: Models) -> None:
        self.body = body  # as it was opened, or the shell that was chosen last
        self._bodies = BodyChoice(body)
        self._models = models
        self._solved = SolvedSamples()
        self._saved = SavedFiles()
        self._problem = body.problem
        given = body.material if body.problem is None else body.problem.material
        self._given = given
        self._material = given  # that of the last computation, without parts; None: the usual one
        self._factors: FloatArray | None = None  # by tet, from the parts
        self._selection: Selection | None = None
        self._painted: tuple[messages.HandleChoice, ...] = ()  # if the body has its own surface
        self.mirroring = Mirroring(body)
        self.given = GivenModel(body)
        self._order: messages.Compute | None = None  # the last one
        self._extension: Extension | None = None  # until there is a model of it
        self._regions = _regions_of(body)
        if body.problem is not None:
            self._selection = Selection(body.problem.handles, body.problem.domain)

    def begin(self, empty: messages.Workspace, *, mesh: str) -> messages.Workspace:
        """The workspace at first, from that of an empty one and the address `mesh`."""
        known = mesh_workspace(empty, self.body, self._given, self._regions, mesh=mesh)
        return replace(known, stiffness=self._stiffness)

    def choose(self, choice: messages.Choose) -> messages.Chosen:
        """Takes the handles and parts of a message; ValueError if they make no valid problem."""
        body = self._bodies.of(choice.thickness)
        regions = self._regions if body is self.body else _regions_of(body)
        selection = selection_of(choice)
        painted: tuple[messages.HandleChoice, ...] = ()
        if regions is not None:
            painted = choice.handles
            selection = replace(selection, handles=regions.in_tets(selection.handles))
        factors = part_factors(choice.parts, body.mesh, regions)
        material = fitted_material(self._material, body.mesh)
        problem = self._make_problem(
            selection, self._stiffness, with_factors(material, factors), mesh=body.mesh
        )
        self.body, self._regions = body, regions
        self._selection, self._factors, self._painted = selection, factors, painted
        self._extension = None
        return messages.Chosen(request=choice.request, handles=problem.handles.names)

    def computation(
        self,
        order: messages.Compute,
        *,
        queue: ComputationQueue,
        report: Reporter,
        publish: Publish,
    ) -> Computation:
        """The computation for a `Compute` message, with the handles and parts chosen last.

        ValueError if it cannot be done.
        """
        if self._selection is None:
            raise ValueError("no handles are chosen; choose at least two, one of them fixed")
        material = chosen_material(
            self._given, self.body.mesh, kind=order.material, poisson=order.poisson
        )
        problem = self._make_problem(
            self._selection, order.stiffness, with_factors(material, self._factors)
        )
        computation = Computation(
            problem,
            order,
            queue=queue,
            solved=self._solved,
            report=report,
            start=self._models.start(problem),
            surface=self.body.surface,
            publish=publish,
        )
        self._problem, self._material, self._order = problem, material, order
        return computation

    def extend(self, order: messages.Extend, model: PosingModel) -> Extension:
        """The model's problem with further handles; ValueError as for `with_points`.

        They count as chosen once there is a model of it.
        """
        self._settle()
        if model.problem.mesh is not self.body.mesh:  # another one was chosen since
            self.body = self._bodies.of(shown_thickness(model.problem.mesh))
            self._regions = _regions_of(self.body)
        painted = {handle.name: handle.vertices for handle in self._painted}
        self._extension = extension_of(
            model.problem,
            order.points,
            model.surface,
            regions=self._regions,
            painted=painted or self.body.painted,
        )
        return self._extension

    def extended_computation(
        self,
        order: messages.Extend,
        problem: PosingProblem,
        model: PosingModel,
        *,
        queue: ComputationQueue,
        report: Reporter,
        publish: Publish,
    ) -> Computation:
        """The computation for an `Extend` message, which starts from a model of fewer handles."""
        usual = messages.Compute(
            request=0, target_error=_target_of(model), seed=0, stiffness=problem.stiffness
        )
        return Computation(
            problem,
            replace(self._order or usual, request=order.request),
            queue=queue,
            solved=self._solved,
            report=report,
            start=usable_start(model, problem),
            surface=self.body.surface,
            publish=publish,
        )

    def _settle(self) -> None:
        """Chooses the handles of the last extension, if there is a model of it."""
        extended = self._extension
        if extended is None or not self._models.is_of(extended.problem):
            return
        self._extension, self._problem = None, extended.problem
        self._selection = Selection(extended.problem.handles, extended.problem.domain)
        self._painted = () if self._regions is None else extended.shown

    def painted_owners(
        self, model: PosingModel, painted: Sequence[messages.HandleChoice] | None = None
    ) -> NDArray[np.int32] | None:
        """The handle painted at each surface vertex, (s,), -1 for none.

        painted : the handles as they were painted, by default those chosen last

        None if the body has no surface of its own, or if other handles have been chosen since.
        """
        names = list(model.problem.handles.names)
        painted = self._painted if painted is None else painted
        if self._regions is None or sorted(h.name for h in painted) != sorted(names):
            return None
        owners = np.full(self._regions.surface_vertices, -1, np.int32)
        for handle in painted:
            owners[list(handle.vertices)] = names.index(handle.name)
        return owners

    def save(self, order: messages.Save) -> messages.Saved:
        """Writes the problem with the handles and parts chosen last, and the newest posing model.

        ValueError if there are no handles, for an invalid timeline, and as for `SavedFiles.save`.
        """
        self._settle()
        if self._selection is None:
            raise ValueError("save: no handles are chosen, so there is nothing to save")
        material = with_factors(fitted_material(self._material, self.body.mesh), self._factors)
        problem = self._make_problem(self._selection, self._stiffness, material)
        model = self._models.current
        return self._saved.save(
            self.body,
            problem,
            # a model that blends poses has no handles
            self.recorded(model, order) if isinstance(model, PosingModel) else None,
            name=order.name,
            request=order.request,
            up=order.up,
            mirror=self.mirroring.plane,
            painted=self._painted,
        )

    def recorded(self, model: ReducedModel, order: messages.Save | messages.Export) -> ReducedModel:
        """The model as files and pages store it; ValueError for an invalid timeline."""
        self._settle()
        others, plane = self._record_of(model), self.mirroring.plane
        if plane is not None:
            others["mirror"] = plane.content
        return recorded(model, up=order.up, timeline=order.timeline, **others)

    def _record_of(self, model: ReducedModel) -> dict[str, Any]:
        """How the handles of a model were painted, for its record; empty if others are chosen."""
        if not self._painted or self._selection is None or not isinstance(model, PosingModel):
            return {}
        chosen = {handle.name: handle.vertices for handle in self._selection.handles}
        own = {handle.name: handle.vertices for handle in model.problem.handles}
        if chosen.keys() != own.keys() or any(
            not np.array_equal(own[name], chosen[name]) for name in own
        ):
            return {}
        return {KEY: {handle.name: list(handle.vertices) for handle in self._painted}}

    @property
    def _stiffness(self) -> float:
        """The stiffness of the last computation or problem file, or the usual one for the mesh."""
        return (
            usual_stiffness(self.body.mesh, fitted_material(self._given, self.body.mesh))
            if self._problem is None
            else (self._problem.stiffness)
        )

    def _make_problem(
        self,
        selection: Selection,
        stiffness: float,
        material: Material,
        *,
        mesh: Mesh | None = None,
    ) -> PosingProblem:
        mesh = mesh or self.body.mesh
        known = self._problem
        if known is not None and known.mesh is not mesh:
            known = None
        return selection.problem(mesh, material=material, stiffness=stiffness, known=known)


def _regions_of(body: Body) -> SurfaceRegions | None:
    return None if body.surface is None else SurfaceRegions(body.mesh, body.surface)


def _target_of(model: PosingModel) -> float:
    """The target of `accurate_model` that the model was made for, or the usual one."""
    record = model.provenance.get("accurate")
    target = record.get("target_error") if isinstance(record, dict) else None
    return target if isinstance(target, float) and target > 0 else MOTIONS.target
