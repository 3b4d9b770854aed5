"""--dask: a cluster's samples give the model of this machine; unsuitable clusters are refused."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from safetensors.numpy import load_file

from snapspace.cli import dask_cluster

from .conftest import Run
from .files import write_problem, write_tet_poses


def assert_same_tensors(a: Path, b: Path) -> None:
    first, second = load_file(a), load_file(b)
    assert first.keys() == second.keys()
    for name in first:
        np.testing.assert_array_equal(first[name], second[name], err_msg=name)


def build_words(folder: Path, *, output: str = "there.snapspace") -> list[object]:
    problem = write_problem(folder)
    size = ["--samples", 10, "--dimension", 5]
    return ["build", "--problem", problem, *size, "-o", folder / output]


def test_a_build_on_a_cluster_gives_the_model_of_this_machine(
    run: Run, cluster: Any, tmp_path: Path
) -> None:
    here = run(*build_words(tmp_path, output="here.snapspace"))
    assert here.code == 0
    there = run(*build_words(tmp_path), "--dask", cluster.scheduler_address, "--json")
    assert there.json["samples"] == 10
    assert_same_tensors(tmp_path / "there.snapspace", tmp_path / "here.snapspace")
    assert not list(tmp_path.glob("*.partial-*"))


def test_an_interpolation_on_a_cluster_gives_it_too(run: Run, cluster: Any, tmp_path: Path) -> None:
    words = ["interpolate", *write_tet_poses(tmp_path), "--samples", 6, "--dimension", 5]
    here, there = tmp_path / "here.snapspace", tmp_path / "there.snapspace"
    assert run(*words, "-o", here).code == 0
    assert run(*words, "-o", there, "--dask", cluster.scheduler_address).code == 0
    assert_same_tensors(there, here)


def test_the_client_is_closed(run: Run, cluster: Any, tmp_path: Path) -> None:
    before = set(cluster.scheduler.clients)
    assert run(*build_words(tmp_path), "--dask", cluster.scheduler_address).code == 0
    assert set(cluster.scheduler.clients) == before


def test_another_version_on_a_worker_is_refused(
    run: Run, cluster: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    installed = dask_cluster.__version__
    monkeypatch.setattr(dask_cluster, "__version__", "99.0")
    error = run(*build_words(tmp_path), "--dask", cluster.scheduler_address).error
    assert f"has snapspace {installed}, but this is snapspace 99.0; install the same" in error


def test_another_build_on_a_worker_is_reported(
    run: Run, cluster: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Builds for different processors round differently, so that the model differs."""
    monkeypatch.setattr(dask_cluster, "level", "v9")
    result = run(*build_words(tmp_path), "--dask", cluster.scheduler_address)
    assert result.code == 0
    assert result.err.count("build, this machine v9: its results differ by rounding") == 1


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGKILL")
def test_a_worker_that_is_lost_while_it_is_asked_is_ignored(
    run: Run, cluster: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    mark = tmp_path / "asked"

    def lost_or_level() -> str:
        """Kills the first worker that is asked."""
        try:
            mark.touch(exist_ok=False)
        except FileExistsError:
            return "v9"
        os.kill(os.getpid(), signal.SIGKILL)
        return ""

    monkeypatch.setattr(dask_cluster, "core_level", lost_or_level)
    result = run(*build_words(tmp_path), "--dask", cluster.scheduler_address)
    assert result.code == 0, result.err
    assert result.err.count("runs the v9 build") == 1
    assert mark.exists()


def test_a_cluster_without_workers_is_refused(run: Run, tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed", reason="needs the extra snapspace[dask]")
    with distributed.LocalCluster(n_workers=0, dashboard_address="127.0.0.1:0") as empty:
        error = run(*build_words(tmp_path), "--dask", empty.scheduler_address).error
    assert "the cluster has no workers; start some with 'dask worker tcp://" in error


def test_an_address_where_no_scheduler_answers_is_refused(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("distributed", reason="needs the extra snapspace[dask]")
    monkeypatch.setattr(dask_cluster, "CONNECT_SECONDS", 0.3)
    error = run(*build_words(tmp_path), "--dask", "tcp://127.0.0.1:1").error
    assert error.startswith("--dask tcp://127.0.0.1:1: no scheduler answers (Timed out")


@pytest.mark.parametrize("address", ["127.0.0.1", "tcp://localhost", "nonsense", ""])
def test_text_that_is_not_an_address_is_refused(run: Run, tmp_path: Path, address: str) -> None:
    error = run(*build_words(tmp_path), "--dask", address).error
    assert error == f"--dask {address}: this is not an address such as tcp://127.0.0.1:8786"


def test_an_unknown_scheme_is_refused(run: Run, tmp_path: Path) -> None:
    pytest.importorskip("distributed", reason="needs the extra snapspace[dask]")
    error = run(*build_words(tmp_path), "--dask", "pigeon://loft:1").error
    assert error.startswith("--dask pigeon://loft:1: no scheduler answers (unknown address scheme")


def test_without_the_extra_it_says_how_to_get_it(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    error = run(*build_words(tmp_path), "--dask", "tcp://127.0.0.1:8786").error
    assert error == '--dask needs the package distributed: pip install "snapspace[dask]"'
