"""InputError: errors that know where they come from."""

from __future__ import annotations

import pickle

import pytest

from snapspace.input_error import InputError, fault_of, located


def test_it_is_a_value_error_of_one_line() -> None:
    error = InputError("stuff", "cell is -1, but must be positive")
    assert isinstance(error, ValueError)
    assert str(error) == "stuff: cell is -1, but must be positive"
    assert fault_of(error) == "cell is -1, but must be positive"
    assert fault_of(OSError("disk full")) == "disk full"


def test_it_comes_back_from_other_processes() -> None:
    again = pickle.loads(pickle.dumps(InputError("here", "there is nothing")))
    assert (again.place, again.fault, str(again)) == (
        "here",
        "there is nothing",
        "here: there is nothing",
    )


@pytest.mark.parametrize(
    "error", [InputError("TetMesh", "no tets"), ValueError("no tets"), OSError("no tets")]
)
def test_a_file_takes_the_place_of_the_function(error: Exception) -> None:
    with pytest.raises(InputError, match=r"^a\.mesh: no tets$"), located("a.mesh"):
        raise error


def test_other_errors_pass() -> None:
    with pytest.raises(KeyError), located("a.mesh"):
        raise KeyError("x")


def test_messages_about_long_names_stay_short() -> None:
    """The beginning says where the fault is, and the end says what helps."""
    error = InputError("a.json", f"unknown entry '{'x' * 5000}'; known are mesh, handles")
    assert len(str(error)) < 1000
    assert str(error).startswith("a.json: unknown entry 'xxx")
    assert str(error).endswith("xxx'; known are mesh, handles")
