"""What tests of wrong arguments share."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pytest

#: A call, given a model and its snapshots.
Call = Callable[[Any, Any], Any]


def check_refused(call: Callable[[], Any], message: str) -> None:
    """The call must raise a ValueError of one line, with this part."""
    with pytest.raises(ValueError, match=re.escape(message)) as told:
        call()
    assert "\n" not in str(told.value)


def refusals(wrong: Mapping[str, tuple[Call, str]]) -> Callable[..., None]:
    """A test for each named call: it is refused with its message, and nothing is written."""

    @pytest.mark.parametrize(("call", "message"), wrong.values(), ids=wrong)
    def test(
        posing_model: Any,
        posing_snapshots: Any,
        tmp_path: Path,
        monkeypatch: pytest.MonkeyPatch,
        call: Call,
        message: str,
    ) -> None:
        monkeypatch.chdir(tmp_path)
        check_refused(lambda: call(posing_model, posing_snapshots), message)
        assert not list(tmp_path.iterdir())

    return test
