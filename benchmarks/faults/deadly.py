"""A process that dies at its k-th dealing with the file system, or counts them.

    python -m benchmarks.faults.deadly KILL_AT FOLDER MODULE [ARGUMENT ...]

Runs MODULE as a program.  Whatever it opens for writing, renames, removes or makes
within FOLDER counts; at number KILL_AT the process is killed, before that happens.
With 0 it lives, and the count is the last line of FOLDER/../count.
"""

import os
import runpy
import signal
import sys
from pathlib import Path

CHANGING = ("os.rename", "os.remove", "os.mkdir", "os.rmdir", "os.truncate", "os.link")


class Counter:
    """An audit hook: it cannot be removed and sees every call of the kind."""

    def __init__(self, kill_at: int, folder: Path) -> None:
        self.kill_at, self.folder, self.count = kill_at, str(folder), 0

    def __call__(self, event: str, args: tuple[object, ...]) -> None:
        if event == "open":
            mode, flags = args[1], args[2]
            writes = isinstance(flags, int) and flags & (os.O_WRONLY | os.O_RDWR)
            if not writes and not (isinstance(mode, str) and set(mode) & set("wax+")):
                return
        elif event not in CHANGING:
            return
        if isinstance(args[0], int):  # a descriptor: its opening was counted
            return
        if self.folder in os.path.abspath(os.fsdecode(args[0])):
            self.count += 1
            if self.count == self.kill_at:
                os.kill(os.getpid(), signal.SIGKILL)


def main() -> None:
    kill_at, folder, module, *words = sys.argv[1:]
    counter = Counter(int(kill_at), Path(folder))
    sys.argv = [module, *words]
    sys.addaudithook(counter)
    try:
        runpy.run_module(module, run_name="__main__", alter_sys=True)
    finally:
        Path(folder).with_name("count").write_text(str(counter.count))


if __name__ == "__main__":
    main()
