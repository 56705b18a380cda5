# SPDX-License-Identifier: LGPL-2.1-or-later
"""Start the program under limits of time and memory."""
import dataclasses
import os
import pathlib
import resource
import shlex
import signal
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "checks"))
import scene_tools  # noqa: E402  in tests/checks

GIGABYTE = 1e9
WATCH = 0.25  # seconds between looks at the memory
GRACE = 15  # seconds that a run has to end after a signal
LONGEST_OUTPUT = 1000000  # characters of the screen that are read


@dataclasses.dataclass
class Limits:
    seconds: float = 20.
    gigabytes: float = 2.


@dataclasses.dataclass
class Result:
    """How a program ended."""
    code: int  # negative: by that signal
    out: str
    err: str
    seconds: float
    too_long: bool = False  # it was asked to end after the limit
    hung: bool = False  # and did not
    asked_by: int = 0  # the signal
    too_large: bool = False  # it was killed for its memory


class MemoryWatch:
    """One look at /proc for all programs that run: memory and processes by session.

    A limit of the address space would count what Open MPI and threads only reserve."""

    def __init__(self):
        self.lock = threading.Lock()
        self.looked = 0.
        self.sessions = {}

    def session(self, leader):
        """(bytes of memory, process ids) of the session that `leader` began."""
        with self.lock:
            if time.monotonic() - self.looked > WATCH:
                self.sessions = read_sessions()
                self.looked = time.monotonic()
            return self.sessions.get(leader, (0, []))


def read_sessions():
    page = resource.getpagesize()
    sessions = {}
    for entry in os.listdir("/proc"):
        if entry.isdigit():
            try:
                with open(f"/proc/{entry}/stat", "rb") as file:
                    words = file.read().rpartition(b")")[2].split()
            except OSError:
                continue
            memory, processes = sessions.get(int(words[3]), (0, []))
            sessions[int(words[3])] = (memory + page * int(words[21]), processes + [int(entry)])
    return sessions


class Program:
    """The program to be tested, and how it is started on so many ranks."""

    def __init__(self, executable, launcher, limits, servers=None):
        """`servers`: a ForkServers, for starts on one rank."""
        self.executable = executable
        self.launcher = launcher
        self.limits = limits
        self.servers = servers
        self.watch = MemoryWatch()

    def command(self, arguments, ranks=1):
        if self.launcher:
            start = shlex.split(self.launcher.replace("{ranks}", str(ranks)))
        else:
            start = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
        return start + [self.executable] + arguments

    def run(self, arguments, folder, ranks=1, may_be_stopped=False):
        """In `folder`; what it prints goes to files there. `may_be_stopped`: a run over its time is sent a signal and
        has GRACE seconds to end. At SIGTERM mpirun itself would end its ranks before they can."""
        stop = (signal.SIGTERM if ranks == 1 else signal.SIGUSR1) if may_be_stopped else None
        arguments = [word.encode("utf-8", "surrogateescape") for word in arguments]
        begin = time.monotonic()
        with (open(folder / "screen.out", "w+b") as out, open(folder / "screen.err", "w+b") as err,
              tempfile.TemporaryDirectory(prefix="mpi_", ignore_cleanup_errors=True) as own):
            if self.servers and ranks == 1:
                process = self.servers.start(arguments, folder, out.name, err.name, own)
            else:
                process = subprocess.Popen(self.command(arguments, ranks), cwd=folder, stdout=out, stderr=err,
                                           stdin=subprocess.DEVNULL, start_new_session=True, env=environment(own))
            result = Result(0, "", "", 0.)
            try:
                self.wait(process, result, stop)
            finally:
                self.end(process, result)
            result.code = process.returncode
            result.seconds = time.monotonic() - begin
            result.out, result.err = (read_screen(file) for file in (out, err))
        for name in ("screen.out", "screen.err"):
            (folder / name).unlink()
        return result

    def wait(self, process, result, stop):
        until = time.monotonic() + self.limits.seconds
        while True:
            try:
                return process.wait(min(WATCH, max(0.01, until - time.monotonic())))
            except subprocess.TimeoutExpired:
                pass
            if self.watch.session(process.pid)[0] > self.limits.gigabytes * GIGABYTE:
                result.too_large = True
                return None
            if time.monotonic() > until:
                if result.too_long or not stop:
                    result.hung = True
                    return None
                result.too_long, result.asked_by = True, stop
                until += GRACE
                process.send_signal(stop)

    def end(self, process, result):
        """Whatever is left of the session is killed: ranks live on if their mpirun is."""
        if process.poll() is not None and not result.too_long:
            return
        for pid in read_sessions().get(process.pid, (0, []))[1]:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        process.wait()


def environment(folder):
    """Open MPI's own files go to `folder`: programs that share one remove it for each other while they start."""
    return dict(scene_tools.environment(), OMPI_MCA_orte_tmpdir_base=folder)


def read_screen(file):
    file.seek(0)
    return readable(file.read(LONGEST_OUTPUT))


def readable(data):
    return data.decode("utf-8", "backslashreplace")
