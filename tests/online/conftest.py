"""The library that tests of the C entry call."""

from __future__ import annotations

import ctypes

import pytest

from .library import compiled


@pytest.fixture(scope="session")
def library(tmp_path_factory: pytest.TempPathFactory) -> ctypes.CDLL:
    return compiled(tmp_path_factory.mktemp("online"))
