"""safetensors_bytes: arrays and a header in safetensors layout, the same bytes every time."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray
from safetensors.numpy import save


def safetensors_bytes(arrays: dict[str, NDArray[Any]], header: dict[str, str]) -> bytes:
    """The bytes of a file, with sorted header keys: the library's own order is random."""
    content = save({name: np.ascontiguousarray(array) for name, array in arrays.items()}, header)
    size = int.from_bytes(content[:8], "little")
    text = json.dumps(json.loads(content[8 : 8 + size]), sort_keys=True).encode()
    text += b" " * (-len(text) % 8)  # the arrays stay aligned
    return len(text).to_bytes(8, "little") + text + content[8 + size :]
