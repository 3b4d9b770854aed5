"""Messages between page and server match the message classes on both sides."""

from __future__ import annotations

import json
from typing import Any

import pytest

from snapspace.server import messages as m
from snapspace.server.wire import decoded, encoded, request_of

from ..page.tools import tool


def test_the_page_has_the_message_types_of_the_server() -> None:
    files = tool("make_messages").files()
    written = {path: path.read_text(encoding="utf-8") for path in files}
    assert written == files, "run python tools/make_messages.py"


CHOOSE = m.Choose(
    request=3,
    handles=(
        m.HandleChoice(name="foot", vertices=(0, 1, 2), moving=False),
        m.HandleChoice(name="Kopf", vertices=(7,), translation=(0.0, 1.0, 2.5)),
    ),
    translation=(1.0, 2.0, 3.0),
    angle=(0.5, 0.5, 0.5),
    parts=(m.PartChoice(name="bone", vertices=(4, 5, 6), factor=12.5),),
)
POLISH = m.Polish(
    request=4,
    model=1,
    handles=(m.HandleMotion(rotation=(1, 0, 0, 0, 1, 0, 0, 0, 1), translation=(0.0, 0.0, 1.0)),),
    q=(0.5, -0.25),
)
EXTEND = m.Extend(
    request=5,
    points=(
        m.KeptPoint(
            name="point 1", corners=(1, 2, 3), shares=(0.5, 0.25, 0.25), reach=(0.0, 1.0, 0.0)
        ),
    ),
)


@pytest.mark.parametrize(
    "message",
    [
        CHOOSE,
        POLISH,
        m.Compute(request=1, target_error=0.1, seed=0, stiffness=3.0, material="arap"),
        m.Compute(request=1, target_error=0.1, most_samples=30, seed=0, stiffness=3.0),
        m.Cancel(request=2),
        m.Save(request=2, name="a name"),
        m.Export(request=2, model=3, up="y", timeline="{}"),
        EXTEND,
    ],
    ids=lambda message: type(message).__name__,
)
def test_a_message_arrives_as_it_was_sent(message: Any) -> None:
    text = encoded(message)
    assert decoded(text) == message
    assert json.loads(text)["type"] == m.type_name(type(message))
    assert request_of(text) == message.request


def test_entries_with_a_default_may_be_left_out_and_integers_are_numbers() -> None:
    text = '{"type": "choose", "request": 1, "handles": [{"name": "a", "vertices": [4]}], '
    message = decoded(text + '"translation": [1, 2, 3], "angle": [0, 0, 1]}')
    assert isinstance(message, m.Choose)
    assert message.handles[0] == m.HandleChoice(name="a", vertices=(4,))
    assert message.translation == (1.0, 2.0, 3.0)


def test_numbers_that_json_lacks_become_null() -> None:
    sent = m.Progress(
        request=1,
        stage="energy",
        done=0,
        total=0,
        seconds=1.0,
        eta=float("inf"),
        error=float("nan"),
    )
    content = json.loads(encoded(sent))
    assert content["eta"] is None and content["error"] is None and content["seconds"] == 1.0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("hello", "not valid JSON"),
        ("[" * 100_000, "not valid JSON"),
        ("[]", "must be an object with the entry 'type'"),
        ('{"request": 1}', "type is None; known are choose, compute, cancel, save, polish"),
        ('{"type": ["choose"]}', r"type is \['choose'\]"),
        ('{"type": "workspace"}', "type is 'workspace'"),
        ('{"type": "cancel"}', "cancel: the entry 'request' is missing"),
        ('{"type": "cancel", "request": 1.0}', "cancel.request must be an integer, got 1.0"),
        ('{"type": "cancel", "request": 2147483648}', "cancel.request is 2147483648, but it must"),
        ('{"type": "cancel", "request": true}', "cancel.request must be an integer, got True"),
        ('{"type": "cancel", "request": 1, "x": 2}', "cancel: unknown entry 'x'"),
        ('{"type": "save", "request": 1, "name": 5}', "save.name must be a string, got 5"),
    ],
)
def test_text_that_is_not_a_message_is_refused(text: str, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        decoded(text)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"handles": 5}, "choose.handles must be a list, got 5"),
        ({"handles": ["a"]}, r"choose.handles\[0\] must be an object, got 'a'"),
        ({"handles": [{"name": "a"}]}, r"choose.handles\[0\]: the entry 'vertices' is missing"),
        (
            {"handles": [{"name": "a", "vertices": [1, True]}]},
            r"choose.handles\[0\].vertices\[1\] must be an integer, got True",
        ),
        (
            {"handles": [{"name": "a", "vertices": [1, -(2**31) - 1]}]},
            r"choose.handles\[0\].vertices\[1\] is -2147483649, but it must fit in 32 bits",
        ),
        ({"translation": [1, 2]}, "choose.translation must have 3 entries, got 2"),
        ({"angle": [1, 2, "3"]}, r"choose.angle\[2\] must be a number, got '3'"),
        ({"angle": [1, 2, 1e999]}, r"choose.angle\[2\] is inf, but it must be finite"),
        (
            {"parts": [{"name": "a", "vertices": [1], "factor": "stiff"}]},
            r"choose.parts\[0\].factor must be a number, got 'stiff'",
        ),
        ({"parts": [{"name": "a", "vertices": [1]}]}, "the entry 'factor' is missing"),
        ({"angle": [1, 2, 10**400]}, r"choose.angle\[2\] is 1000.*must be finite"),
    ],
)
def test_a_mistyped_entry_is_named(change: dict[str, Any], message: str) -> None:
    content = {**json.loads(encoded(CHOOSE)), **change}
    with pytest.raises(ValueError, match=message):
        decoded(json.dumps(content))


def test_the_request_of_a_malformed_message_is_found_where_there_is_one() -> None:
    assert request_of('{"type": "evil", "request": 7}') == 7
    for text in ("hello", "[]", "{}", '{"request": "7"}', '{"request": true}', "5"):
        assert request_of(text) == 0
