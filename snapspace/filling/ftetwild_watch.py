"""The program between snapspace and fTetWild: ends fTetWild when snapspace ends in any way.

Arguments: a folder, and the program to run with this folder as its only argument. Standard input
is a pipe from snapspace, which closes when snapspace ends, killed or not. Then fTetWild, which
reacts to nothing while it works, is killed, and the folder is removed. Otherwise the exit status
is that of fTetWild, and the folder stays.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import threading


def main(folder: str, program: str) -> int:
    ending = threading.Event()
    work = subprocess.Popen([sys.executable, program, folder], stdin=subprocess.DEVNULL, cwd=folder)

    def end_with_snapspace() -> None:
        # not sys.stdin, whose lock Python would wait for at exit
        while os.read(0, 1):
            pass
        ending.set()
        work.kill()
        work.wait()
        shutil.rmtree(folder, ignore_errors=True)
        os._exit(1)

    watch = threading.Thread(target=end_with_snapspace, daemon=True)
    watch.start()
    status = work.wait()
    if ending.is_set():
        watch.join()  # ends the process once the folder is gone
    return status if status >= 0 else 128 - status  # as shells report a signal


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
