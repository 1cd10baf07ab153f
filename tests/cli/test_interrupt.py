import json
import os
import signal
import subprocess
import sys
import threading

import pytest

from rrnn_opt.cli.interrupt import held, noticed
from rrnn_opt.cli.main import COMMANDS, main
from rrnn_opt.cli.output import Output


def press() -> None:
    signal.raise_signal(signal.SIGINT)


def test_an_interrupt_that_a_library_swallows_still_decides(capfd, monkeypatch):
    def deaf(_, out):
        try:
            press()
        except KeyboardInterrupt:
            out.document({"went": "on"})
        return 0

    before = signal.getsignal(signal.SIGINT)
    monkeypatch.setattr(COMMANDS["robots"], "run", deaf)
    assert main(["robots", "--json"]) == 130
    shown, said = capfd.readouterr()
    assert json.loads(shown) == {"went": "on"}
    assert said == "rrnn: interrupted; the command had come to its end\n"
    assert signal.getsignal(signal.SIGINT) is before


def test_an_interrupt_that_becomes_another_error_is_no_fault_of_ours(
    capfd, monkeypatch
):
    def disguised(*_):
        try:
            press()
        except KeyboardInterrupt:
            raise RuntimeError("Error calling __set_name__") from None

    monkeypatch.setattr(COMMANDS["robots"], "run", disguised)
    assert main(["robots", "--json"]) == 130
    shown, said = capfd.readouterr()
    assert json.loads(shown)["error"]["kind"] == "interrupted"
    assert said == "rrnn: interrupted\n"


def test_an_interrupt_waits_for_the_document():
    reader, writer = os.pipe()
    received: list[bytes] = []

    def read() -> None:
        received.append(os.read(reader, 1))
        os.kill(os.getpid(), signal.SIGINT)  # most of it is still to be written
        while chunk := os.read(reader, 1 << 16):
            received.append(chunk)

    document = {"long": list(range(200_000))}  # far beyond what a pipe holds
    thread = threading.Thread(target=read)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        Output(True, writer).document(document)
    os.close(writer)
    thread.join()
    os.close(reader)
    assert json.loads(b"".join(received)) == document


def test_a_second_interrupt_does_not_wait():
    reached: list[int] = []

    def twice() -> None:
        with held():
            press()
            reached.append(1)
            press()
            reached.append(2)

    with pytest.raises(KeyboardInterrupt):
        twice()
    assert reached == [1]


def test_nothing_is_noticed_where_nothing_happened():
    with noticed() as interrupt, held():
        pass
    assert not interrupt.seen


@pytest.mark.parametrize("options", [[], ["--json"]])
def test_an_interrupt_while_the_program_loads_leaves_no_traceback(options):
    code = (
        "import sys, time\n"
        "class Slow:\n"
        "    def find_spec(self, name, *_):\n"
        "        if name == 'argparse':\n"
        "            print('loading', flush=True); time.sleep(30)\n"
        "from rrnn_opt.cli import start\n"
        "sys.modules.pop('argparse', None); sys.meta_path.insert(0, Slow())\n"
        "sys.exit(start.main())\n"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", code, *options],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    process.stdout.readline()
    process.send_signal(signal.SIGINT)
    shown, said = process.communicate(timeout=30)
    assert process.returncode == 130
    assert not options or json.loads(shown)["error"]["kind"] == "interrupted"
    assert said == "rrnn: interrupted\n"


INTERRUPTED_IN_C = """
import atexit, concurrent.futures, ctypes, os, pathlib, sys, tempfile
from rrnn_opt.cli import main, start
def spoil():
    ctypes.pythonapi.PyRun_SimpleString(b'raise KeyboardInterrupt')
def late():
    pathlib.Path('late').write_text('done')
    spoil()
def run():
    global folder, pool
    folder = tempfile.TemporaryDirectory(dir='.', prefix='draft-')
    pool = concurrent.futures.ProcessPoolExecutor(1)
    print(pool.submit(os.getpid).result(), end='')
    atexit.register(late)
    spoil()
    return STATUS
main.main = run
if __name__ == '__main__':
    sys.exit(start.main())
"""


@pytest.mark.parametrize("status", [130, 143, 129])
def test_the_status_stands_where_a_c_library_was_interrupted(tmp_path, status):
    """Also in the last moment; what others do at the exit is done all the same."""
    text = INTERRUPTED_IN_C.replace("STATUS", str(status))
    (tmp_path / "started.py").write_text(text)
    words = [sys.executable, "-m", "started"]  # only with -m does CPython ask again
    done = subprocess.run(
        words, capture_output=True, check=False, timeout=30, cwd=tmp_path, text=True
    )
    assert done.returncode == status
    with pytest.raises(ProcessLookupError):
        os.kill(int(done.stdout), 0)  # its worker; what was printed is whole
    left = {path.name for path in tmp_path.iterdir()}
    assert left - {"__pycache__"} == {"started.py", "late"}


@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP"])
def test_other_requests_to_end_are_noticed_too(capfd, monkeypatch, name):
    number = getattr(signal, name)
    before = signal.signal(number, signal.SIG_DFL)
    try:
        monkeypatch.setattr(
            COMMANDS["robots"], "run", lambda *_: signal.raise_signal(number)
        )
        assert main(["robots", "--json"]) == 128 + number
        assert signal.getsignal(number) == signal.SIG_DFL
    finally:
        signal.signal(number, before)
    shown, said = capfd.readouterr()
    assert json.loads(shown)["error"]["kind"] == "interrupted"
    assert said == f"rrnn: interrupted by {name}\n"


def test_what_is_ignored_stays_ignored():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with noticed() as interrupt, held():
            signal.raise_signal(signal.SIGHUP)
    finally:
        signal.signal(signal.SIGHUP, before)
    assert not interrupt.seen
