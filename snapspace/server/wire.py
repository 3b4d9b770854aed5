"""encoded, decoded: messages as JSON text."""

from __future__ import annotations

import dataclasses
import json
import math
import types
import typing
from typing import Any

from .messages import FROM_PAGE, PageMessage, ServerMessage, type_name

_CLASSES = {type_name(each): each for each in FROM_PAGE}


def encoded(message: ServerMessage) -> str:
    """The JSON text of a message. Numbers that are not finite become null."""
    content = {"type": type_name(type(message)), **dataclasses.asdict(message)}
    finite = {k: None if _is_not_finite(v) else v for k, v in content.items()}
    return json.dumps(finite, allow_nan=False)


def decoded(text: str) -> PageMessage:
    """The message of a JSON text.

    Raises
    ------
    ValueError
        For text that is not JSON, an unknown type, or an entry that is unknown, missing or of the
        wrong type; the message names the entry.
    """
    try:
        content = json.loads(text)
    except (ValueError, RecursionError):
        raise ValueError("message: not valid JSON") from None
    if not isinstance(content, dict):
        raise ValueError("message: must be an object with the entry 'type'")
    name = content.pop("type", None)
    if not isinstance(name, str) or name not in _CLASSES:
        raise ValueError(f"message: type is {_shown(name)}; known are {', '.join(_CLASSES)}")
    message: PageMessage = _object(content, _CLASSES[name], name)
    return message


def request_of(text: str) -> int:
    """The number of the request in a message that may be malformed; 0 if there is none."""
    try:
        number = json.loads(text)["request"]
    except (ValueError, TypeError, KeyError, RecursionError):
        return 0
    return number if type(number) is int else 0


def _object(content: Any, kind: type, where: str) -> Any:
    if not isinstance(content, dict):
        raise ValueError(f"{where} must be an object, got {_shown(content)}")
    hints = typing.get_type_hints(kind)
    for key in content:
        if key not in hints:
            raise ValueError(f"{where}: unknown entry {_shown(key)}; known are {', '.join(hints)}")
    values = {}
    for field in dataclasses.fields(kind):
        if field.name in content:
            place = f"{where}.{field.name}"
            values[field.name] = _value(content[field.name], hints[field.name], place)
        elif field.default is dataclasses.MISSING:
            raise ValueError(f"{where}: the entry '{field.name}' is missing")
    return kind(**values)


def _value(value: Any, hint: Any, where: str) -> Any:
    if dataclasses.is_dataclass(hint) and isinstance(hint, type):
        return _object(value, hint, where)
    arguments = typing.get_args(hint)
    if isinstance(hint, types.UnionType):  # a value or null
        inner = next(argument for argument in arguments if argument is not type(None))
        return None if value is None else _value(value, inner, where)
    if typing.get_origin(hint) is tuple:
        return _list(value, arguments, where)
    if hint is float:
        return _number(value, where)
    if hint is int and type(value) is int and not _fits(value):
        raise ValueError(f"{where} is {_shown(value)}, but it must fit in 32 bits")
    if type(value) is not hint:
        what = {int: "an integer", str: "a string", bool: "true or false"}[hint]
        raise ValueError(f"{where} must be {what}, got {_shown(value)}")
    return value


def _list(value: Any, arguments: tuple[Any, ...], where: str) -> tuple[Any, ...]:
    if not isinstance(value, list):
        raise ValueError(f"{where} must be a list, got {_shown(value)}")
    if arguments[-1] is Ellipsis:
        kind = arguments[0]
        if kind is int and all(type(item) is int and _fits(item) for item in value):
            return tuple(value)
        return tuple(_value(item, kind, f"{where}[{i}]") for i, item in enumerate(value))
    if len(value) != len(arguments):
        raise ValueError(f"{where} must have {len(arguments)} entries, got {len(value)}")
    pairs = zip(value, arguments, strict=True)
    return tuple(_value(item, kind, f"{where}[{i}]") for i, (item, kind) in enumerate(pairs))


def _number(value: Any, where: str) -> float:
    if type(value) not in (int, float):
        raise ValueError(f"{where} must be a number, got {_shown(value)}")
    try:
        number = float(value)
    except OverflowError:
        number = math.inf
    if not math.isfinite(number):
        raise ValueError(f"{where} is {_shown(value)}, but it must be finite")
    return number


def _fits(value: int) -> bool:
    """Whether a number fits in 32 bits, as binary frames and meshes need."""
    return -(2**31) <= value < 2**31


def _is_not_finite(value: Any) -> bool:
    return isinstance(value, float) and not math.isfinite(value)


def _shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
