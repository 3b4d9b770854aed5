"""Bench: handles, models and files of one body, as a page makes them."""

from __future__ import annotations

from dataclasses import replace

from ..energy import StVK
from ..problem import PosingProblem
from . import messages
from .body import Body
from .computation import Computation, Publish
from .models import Models
from .reporter import Reporter
from .saving import Savings
from .selection import (
    ANGLE,
    TRANSLATION_SHARE,
    Selection,
    as_vector,
    choices_of,
    default_stiffness,
    selection_of,
)
from .solved_samples import SolvedSamples
from .surface_regions import SurfaceRegions
from .turns import Turns


class Bench:
    """What a page does with one body.

    Parameters
    ----------
    body : Body
    models : Models
        Of the page.
    """

    def __init__(self, body: Body, models: Models) -> None:
        self.body = body
        self._models = models
        self._solved = SolvedSamples()
        self._savings = Savings()
        self._problem = body.problem
        self._selection: Selection | None = None
        surface = body.surface
        self._regions = None if surface is None else SurfaceRegions(body.mesh, surface)
        if body.problem is not None:
            self._selection = Selection(body.problem.handles, body.problem.domain)

    def begin(self, empty: messages.Workspace, *, mesh: str) -> messages.Workspace:
        """What the page begins with, out of the message of an empty workspace and an address."""
        shape, problem = self.body.mesh, self.body.problem
        length = TRANSLATION_SHARE * shape.diagonal
        known = replace(
            empty,
            kind="mesh",
            name=self.body.name,
            mesh=mesh,
            diagonal=shape.diagonal,
            translation=(length, length, length),
            angle=(ANGLE, ANGLE, ANGLE),
            stiffness=self._stiffness,
            folder=str(self.body.folder),
        )
        if problem is None:
            return known
        bounds = problem.domain.common.bounds[0]
        choices = choices_of(problem)
        return replace(
            known,
            handles=choices if self._regions is None else self._regions.shown(choices),
            translation=as_vector(bounds[:3]),
            angle=as_vector(bounds[3:]),
        )

    def choose(self, choice: messages.Choose) -> messages.Chosen:
        """Takes the handles of a message; ValueError if no problem can have them."""
        selection = selection_of(choice)
        if self._regions is not None:
            selection = replace(selection, handles=self._regions.in_tets(selection.handles))
        problem = self._of(selection, self._stiffness, self._material)
        self._selection = selection
        return messages.Chosen(request=choice.request, handles=problem.handles.names)

    def computation(
        self, order: messages.Compute, *, turns: Turns, report: Reporter, publish: Publish
    ) -> Computation:
        """What `Compute` asks for, of the handles chosen last; ValueError if it cannot be done."""
        if self._selection is None:
            raise ValueError("no handles are chosen; choose at least two, one of them fixed")
        material = StVK() if self.body.problem is None else self.body.problem.material
        if order.poisson is not None:
            material = _with_poisson(material, order.poisson)
        problem = self._of(self._selection, order.stiffness, material)
        computation = Computation(
            problem,
            order,
            turns=turns,
            solved=self._solved,
            report=report,
            surface=self.body.surface,
            publish=publish,
        )
        self._problem = problem
        return computation

    def save(self, order: messages.Save) -> messages.Saved:
        """Writes the problem of the handles chosen last, and the newest model.

        ValueError if there are no handles, and as for `Savings.save`.
        """
        if self._selection is None:
            raise ValueError("save: no handles are chosen, so there is nothing to save")
        problem = self._of(self._selection, self._stiffness, self._material)
        newest = self._models.newest
        return self._savings.save(
            self.body,
            problem,
            None if newest is None else newest.model,
            name=order.name,
            request=order.request,
        )

    @property
    def _stiffness(self) -> float:
        """Of the last computation, else of the problem file, else one that suits the mesh."""
        return (
            default_stiffness(self.body.mesh)
            if self._problem is None
            else (self._problem.stiffness)
        )

    @property
    def _material(self) -> StVK:
        return StVK() if self._problem is None else self._problem.material

    def _of(self, selection: Selection, stiffness: float, material: StVK) -> PosingProblem:
        return selection.problem(
            self.body.mesh, material=material, stiffness=stiffness, known=self._problem
        )


def _with_poisson(material: StVK, ratio: float) -> StVK:
    """The material with the same shear modulus and a Poisson ratio in [0, 0.5), else ValueError."""
    if not 0.0 <= ratio < 0.5:
        raise ValueError(f"Poisson's ratio is {ratio:g}, but it must be from 0 to below 0.5")
    return replace(material, lam=2.0 * material.mu * ratio / (1.0 - 2.0 * ratio))
