"""Studies that worker processes can import."""

import os
import signal
import time
from pathlib import Path

from rrnn_opt.study import Case


class Draws:
    """Each case draws; some wait, some end their worker."""

    name = "draws"

    def __init__(self, count, *, wait_s=0.0, deadly=None, flag=None, stuck=None):
        self.count, self.wait_s = count, wait_s
        self.deadly, self.flag, self.stuck = deadly, flag, stuck

    def __iter__(self):
        return (Case(f"case/{k}", {"k": k}) for k in range(self.count))

    def measure(self, case, rng):
        k = case.parameters["k"]
        if k == self.deadly and not self._died_before():
            os.kill(os.getpid(), signal.SIGKILL)
        time.sleep(100.0 if k == self.stuck else self.wait_s)
        return {
            "k": k,
            "first": float(rng.random()),
            "curve": [float(x) for x in rng.random(3)],
            "words": {"plan_s": time.perf_counter(), "status": "solved"},
            "time_s": time.perf_counter(),
            "pid_us": os.getpid(),
        }

    def _died_before(self):
        """Once where there is a flag; each time without one."""
        if self.flag is None:
            return False
        before = Path(self.flag).exists()
        Path(self.flag).touch()
        return before


class Threads:
    """What a worker is told about threads."""

    name = "threads"

    def __iter__(self):
        return (Case(str(k)) for k in range(2))

    def measure(self, case, rng):
        return {"omp": os.environ.get("OMP_NUM_THREADS")}


class Broken(Draws):
    def measure(self, case, rng):
        raise ZeroDivisionError("by design")


class Unborn(Draws):
    """Ends the process that unpickles it."""

    def __setstate__(self, state):
        os._exit(3)
