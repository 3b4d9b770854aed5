"""Which models of a computation a page gets."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from snapspace import Growth, PosingModel, growing_models
from snapspace.server import messages as m
from snapspace.server.body import Body
from snapspace.server.given_model import GivenModel
from snapspace.server.kept_points import with_points
from snapspace.server.models import Models
from snapspace.server.publishing import Publishing

from .test_extending import bar_with_ends, middle


@pytest.fixture(scope="module")
def start() -> PosingModel:
    model = next(growing_models(bar_with_ends())).model
    assert isinstance(model, PosingModel)
    return model


@pytest.fixture(scope="module")
def growths(start: PosingModel) -> list[Growth]:
    """The models of a bar that gets a handle at its middle."""
    problem = with_points(start.problem, start.surface, [middle(start.problem)])
    return list(growing_models(problem, target_error=0.5, start=start))


def published(
    growths: Sequence[Growth], models: Models, *, start: PosingModel | None = None
) -> list[m.Model]:
    """The messages that a page gets."""
    sent: list[m.ServerMessage] = []
    publishing = Publishing(
        models=models,
        request=1,
        name="bar",
        up=lambda: "z",
        owners=lambda model: None,
        mirror=lambda model: {},
        address=str,
        send=sent.append,
        start=start,
    )
    for growth in growths:
        publishing(growth, 0.0)
    return [message for message in sent if isinstance(message, m.Model)]


def dimensions(growths: Sequence[Growth | m.Model]) -> list[int]:
    return [one.model.dimension if isinstance(one, Growth) else one.dimension for one in growths]


def test_the_impression_of_new_handles_is_shown_at_once(growths: list[Growth]) -> None:
    assert [growth.impression for growth in growths] == [True, False, False]
    assert dimensions(published(growths, Models(None))) == dimensions(growths)


def test_a_page_with_a_model_of_fewer_handles_keeps_it_until_a_better_one_is_there(
    growths: list[Growth], start: PosingModel
) -> None:
    assert dimensions(published(growths, Models(None), start=start)) == dimensions(growths[1:])


def test_only_better_models_replace_one_that_is_computed_again(growths: list[Growth]) -> None:
    models, last = Models(None), growths[-1]
    published(growths, models)
    assert last.step is not None
    error = last.step.error
    worse, better = (
        replace(last, final=False, step=replace(last.step, error=factor * error))
        for factor in (2.0, 0.5)
    )
    again = published([*growths[:2], worse, better, last], models)
    assert [(message.error, message.final) for message in again] == [
        (0.5 * error, False),
        (error, True),
    ]


def test_only_better_models_replace_one_from_a_file(growths: list[Growth], tmp_path: Path) -> None:
    models, last = Models(None), growths[-1]
    assert last.step is not None and isinstance(last.model, PosingModel)
    problem = last.model.problem
    body = Body(
        name="bar", mesh=problem.mesh, file=None, folder=tmp_path, problem=problem, model=last.model
    )
    GivenModel(body).give(models, address=str)
    worse = replace(last, final=False, step=replace(last.step, error=2.0 * last.step.error))
    assert published([*growths[:2], worse], models) == []


def test_the_samples_of_the_model_it_started_from_count_too(
    growths: list[Growth], start: PosingModel
) -> None:
    """A first model that meets the target needs 16 samples more, those that judge it."""
    assert len(growths[-1].snapshots) == 16
    first, last = published(growths, Models(None), start=start)
    assert first.samples >= len(start.training_parameters)
    assert last.samples == first.samples + 16
