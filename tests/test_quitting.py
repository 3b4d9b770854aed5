"""A program that quits while threads still compute ends as it would without them."""

from __future__ import annotations

import subprocess
import sys

QUITS_WHILE_COMPUTING = """
import threading

import snapspace as ss
from snapspace.generators import creature

mesh = creature(5000)
energy = ss.ElasticEnergy(mesh, ss.StableNeoHookean())
computing = threading.Event()


def compute():
    while True:
        energy.value_and_gradient(mesh.vertices)
        computing.set()


for _ in range(3):
    threading.Thread(target=compute, daemon=True).start()
computing.wait()
print("quits")
"""


def test_a_program_quits_while_daemon_threads_compute() -> None:
    # Python before 3.14 unwinds such threads as they ask for its lock, which must not abort
    program = [sys.executable, "-c", QUITS_WHILE_COMPUTING]
    for _ in range(3):
        ended = subprocess.run(program, capture_output=True, text=True, timeout=60)
        assert (ended.returncode, ended.stdout, ended.stderr) == (0, "quits\n", "")
