"""The program between snapspace and fTetWild: it ends fTetWild when snapspace ends, however.

Arguments: a folder, and the program to run with it as its only argument. Its standard input is a
pipe from snapspace, which closes when snapspace dies, killed or not. Then fTetWild, which does not
listen to anything while it works, is killed, and the folder is removed. Otherwise the exit status
is fTetWild's, and the folder stays.
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
        # not sys.stdin, whose lock Python would wait for at its own end
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
    return status if status >= 0 else 128 - status  # as shells tell a signal


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
