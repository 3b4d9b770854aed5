"""page_computation: the work for a page's `Compute` or `Extend` message."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from ..reduction import PosingModel
from .body_session import BodySession
from .computation import Computation
from .computation_queue import ComputationQueue
from .messages import Compute, Extend, ServerMessage
from .models import Models
from .publishing import Publishing
from .reporter import Reporter


def page_computation(
    order: Compute | Extend,
    session: BodySession,
    models: Models,
    *,
    queue: ComputationQueue,
    up: Callable[[], str],
    address: Callable[[int], str],
    send: Callable[[ServerMessage], None],
) -> Computation:
    """The computation of a message; it has not begun.

    Parameters
    ----------
    order : Compute or Extend
    session : BodySession
    models : Models
        The page's models; those of the computation are added.
    queue : ComputationQueue
    up, address, send : as for `Publishing`

    Raises
    ------
    ValueError
        If it cannot be done. The message names the reason.
    """
    report = Reporter(send, order.request)
    publish = Publishing(
        models=models,
        request=order.request,
        name=session.body.name,
        up=up,
        owners=session.painted_owners,
        mirror=session.mirroring.about,
        address=address,
        send=send,
    )
    if isinstance(order, Compute):
        return session.computation(order, queue=queue, report=report, publish=publish)
    model = models.current
    if not isinstance(model, PosingModel):
        raise ValueError("there is no model with handles yet; compute one first")
    extended = session.extend(order, model)
    return session.extended_computation(
        order,
        extended.problem,
        model,
        queue=queue,
        report=report,
        publish=replace(
            publish,
            owners=lambda better: session.painted_owners(better, extended.shown),
            kept=extended.kept,
            start=model,
        ),
    )
