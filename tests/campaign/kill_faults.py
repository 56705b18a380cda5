# SPDX-License-Identifier: LGPL-2.1-or-later
"""What can happen to a run from outside: signals to its processes, at a moment; and a disk that is full."""
import dataclasses
import glob
import os
import resource
import shutil
import signal
import subprocess
import tempfile
import time

POLL = 2e-4  # seconds between looks for a file
AFTERLIFE = 10.0  # seconds in which all processes of a run that was hit must be gone
HUNG = "hung"
BETWEEN_SIGNALS = 2.5  # seconds; launchers send several in quick succession, which count as one


class Run:
    """A run under way in a session of its own, by which all its processes are found."""

    def __init__(self, command, program, output, environment):
        """Starts `command`, which starts `program`; what it prints goes to the file `output`."""
        self.program, self.output = program, output
        with open(output, "wb") as file:
            self.process = subprocess.Popen(command, stdout=file, stderr=file, env=environment,
                                            stdin=subprocess.DEVNULL, start_new_session=True)

    def processes(self):
        """(number, first word of the command line) of all that live."""
        result = []
        for folder in glob.glob("/proc/[0-9]*"):
            try:
                with open(folder + "/stat") as file:
                    fields = file.read().rpartition(")")[2].split()
                with open(folder + "/cmdline") as file:
                    word = file.read().partition("\0")[0]
            except OSError:
                continue  # it has just ended
            if fields[3] == str(self.process.pid) and fields[0] not in "ZX":
                result.append((int(folder.rpartition("/")[2]), word))
        return sorted(result)

    def ranks(self):
        """Numbers of the processes that compute."""
        return [number for number, word in self.processes() if word == self.program]

    def wait(self, seconds):
        """The exit code, as a shell gives it (128 and more for ends by signals), or HUNG after so many seconds."""
        try:
            code = self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            self.end_all()
            return HUNG
        return code if code >= 0 else 128 - code

    def printed(self):
        with open(self.output, errors="replace") as file:
            return file.read()

    def outlive(self):
        """True if processes are still there some seconds after the first of them has ended."""
        end = time.monotonic() + AFTERLIFE
        while self.processes():
            if time.monotonic() > end:
                self.end_all()
                return True
            time.sleep(0.05)
        return False

    def end_all(self):
        for number, _ in self.processes():
            send(number, signal.SIGKILL)
        self.process.wait()


def send(number, name):
    try:
        os.kill(number, name)
    except ProcessLookupError:
        pass  # it has just ended


# Moments: each waits for its own and says whether the run has seen it.

@dataclasses.dataclass(frozen=True)
class AfterSeconds:
    seconds: float

    def wait(self, run, _folder):
        try:
            run.process.wait(self.seconds)
        except subprocess.TimeoutExpired:
            return True
        return False


@dataclasses.dataclass(frozen=True)
class WhileWriting:
    """The `count`-th time that a file of this kind is there under its temporary name."""
    pattern: str
    count: int

    def wait(self, run, folder):
        pattern, seen, before = os.path.join(folder, self.pattern), 0, False
        while run.process.poll() is None:
            now = bool(glob.glob(pattern))
            seen += now and not before
            if seen == self.count:
                return True
            before = now
            time.sleep(POLL)
        return False


@dataclasses.dataclass(frozen=True)
class AtTheEnd:
    """So many seconds after the row of the last step."""
    last_step: int
    seconds: float

    def wait(self, run, folder):
        path = os.path.join(folder, "statistics")
        while run.process.poll() is None:
            if os.path.exists(path) and self.has_last_row(path):
                return AfterSeconds(self.seconds).wait(run, folder)
            time.sleep(0.005)
        return False

    def has_last_row(self, path):
        with open(path) as file:
            return any(line.split()[:1] == [str(self.last_step)] for line in file)


# Faults: each strikes, and says whether the run yields as it must.

@dataclasses.dataclass(frozen=True)
class Signal:
    """A signal to "ranks" (all), "a rank" (the last) or the "launcher" of ranks."""
    name: int
    to: str

    def __str__(self):
        return f"{signal.Signals(self.name).name} to {self.to}"

    @property
    def lets_it_stop(self):
        return self.name != signal.SIGKILL

    def strike(self, run):
        launcher = [run.process.pid]
        ranks = run.ranks() or launcher  # which has not started them yet
        for number in {"ranks": ranks, "a rank": ranks[-1:], "launcher": launcher}[self.to]:
            send(number, self.name)
        return True


@dataclasses.dataclass(frozen=True)
class SecondSignal:
    """A rank stands still, so that the others wait for it: the first SIGTERM cannot end them, the second must."""
    lets_it_stop = False

    def __str__(self):
        return "SIGTERM twice to a rank that waits"

    def strike(self, run):
        ranks = run.ranks()
        if len(ranks) < 2:
            return True  # not started yet, or at its end
        send(ranks[-1], signal.SIGSTOP)
        send(ranks[0], signal.SIGTERM)
        time.sleep(BETWEEN_SIGNALS)
        send(ranks[0], signal.SIGTERM)
        time.sleep(1)
        yields = ranks[0] not in run.ranks()
        for number in ranks:
            send(number, signal.SIGCONT)
            if not yields:
                send(number, signal.SIGKILL)
        return yields


@dataclasses.dataclass(frozen=True)
class FullDisk:
    """Room for this share of what the run has still to write."""
    share: float

    def __str__(self):
        return "full disk"


def used(folder):
    """Bytes of the disk that the files below a folder take."""
    return sum(os.lstat(os.path.join(place, name)).st_blocks * 512
               for place, _, names in os.walk(folder) for name in names)


# A small disk that holds a copy of the folder $3 in the place of it while a command runs; what the command leaves is
# copied to the folder $4. Nothing is mounted outside of it.
ON_SMALL_DISK = """
mount -t tmpfs -o size="$1" none "$2" && cp -a "$3/." "$2" && mount --bind "$2" "$3" || exit 125
copy=$4
small=$2
shift 4
"$@"
code=$?
cp -a "$small/." "$copy"
exit $code
"""
# A run in files of at most $1 blocks of 512 bytes; SIGXFSZ is ignored, so that writing fails.
IN_SMALL_FILES = 'trap "" XFSZ; ulimit -f "$1"; shift; exec "$@"'


def ways_to_mount():
    """Prefixes of a command that may mount, the best first: as root, or in a name space of one's own."""
    for prefix in (["unshare", "--mount"], ["unshare", "--map-root-user", "--mount"]):
        with tempfile.TemporaryDirectory() as folder:
            try:
                result = subprocess.run(prefix + ["mount", "-t", "tmpfs", "none", folder],
                                        capture_output=True)
            except OSError:
                return None
        if result.returncode == 0:
            return prefix
    return None


class SmallDisks:
    """Runs commands where little can be written: on a small disk in memory if mounting is allowed, else with a limit
    on the size of a file (one rank: the memory that ranks share is a file too)."""

    def __init__(self):
        self.prefix = ways_to_mount()

    def describe(self):
        if self.prefix:
            return f"full disk by '{' '.join(self.prefix)}' and a tmpfs"
        return "full disk by a limit on the size of files, on one rank only: nothing can be mounted here"

    def serve(self, ranks):
        return self.prefix is not None or ranks == 1

    def command(self, command, folder, room):
        """`command` with `room` bytes left for it in `folder`; then call `keep`."""
        if not self.prefix:
            return ["sh", "-c", IN_SMALL_FILES, "sh", str(max(1, room // 512))] + command
        for place in (folder + ".disk", folder + ".copy"):
            os.makedirs(place)
        size = max(used(folder) + room, resource.getpagesize())
        return self.prefix + ["sh", "-c", ON_SMALL_DISK, "sh", str(size), folder + ".disk", folder,
                              folder + ".copy"] + command

    def keep(self, folder):
        """What the run has left comes to the folder: there is space again."""
        if self.prefix:
            shutil.rmtree(folder)
            os.rename(folder + ".copy", folder)
            os.rmdir(folder + ".disk")
