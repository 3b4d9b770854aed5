"""What tests of wrong arguments share."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import pytest

#: A call, given a model and its snapshots.
Call = Callable[[Any, Any], Any]


def check_refused(call: Callable[[], Any], message: str) -> None:
    """The call must raise a ValueError of one line, with this part."""
    with pytest.raises(ValueError, match=re.escape(message)) as told:
        call()
    assert "\n" not in str(told.value)
