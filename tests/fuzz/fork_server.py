# SPDX-License-Identifier: LGPL-2.1-or-later
"""Many short starts of one program: copies of a process that has loaded its libraries (fork_server.c)."""
import os
import pathlib
import queue
import signal
import socket
import subprocess
import tempfile

ROOM = 64  # for arguments


class ForkServers:
    """Processes that wait before main(); each serves one start at a time."""

    def __init__(self, executable, number, environment):
        folder = tempfile.TemporaryDirectory(prefix="fork_server_")
        library = os.path.join(folder.name, "fork_server.so")
        source = pathlib.Path(__file__).with_suffix(".c")
        subprocess.run([os.environ.get("CC", "cc"), "-O1", "-shared", "-fPIC", "-o", library, str(source)], check=True)
        self.idle = queue.SimpleQueue()
        for _ in range(number):
            self.idle.put(Server(executable, library, environment))
        self.folder = folder  # until the end: a copy may be made of a server that starts late

    def start(self, arguments, folder, out, err, own):
        """A Process, as if subprocess.Popen had started the program with these arguments (bytes)."""
        server = self.idle.get()
        return Process(server, server.start([folder, out, err, own], arguments), self.idle)


class Server:
    def __init__(self, executable, library, environment):
        ours, theirs = socket.socketpair()
        environment = dict(environment, LD_PRELOAD=library, UNDINE_FORK_SERVER=str(theirs.fileno()))
        self.process = subprocess.Popen([executable] + ["x"] * ROOM, env=environment, stdin=subprocess.DEVNULL,
                                        pass_fds=[theirs.fileno()], start_new_session=True)
        theirs.close()
        self.socket = ours
        self.read = b""  # of an answer that has not come to its end

    def start(self, words, arguments):
        request = b"".join(os.fsencode(str(word)) + b"\n" for word in (*words, len(arguments)))
        self.socket.settimeout(None)
        self.socket.sendall(request + b"".join(word + b"\0" for word in arguments))
        return self.number()

    def number(self):
        """The next answer; raises TimeoutError if there is none within the socket's timeout."""
        while not self.read.endswith(b"\n"):
            byte = self.socket.recv(1)
            if not byte:
                raise RuntimeError(f"the fork server has ended: exit code {self.process.wait()}")
            self.read += byte
        word, self.read = self.read, b""
        return int(word)


class Process:
    """What process.Program needs of a subprocess.Popen."""

    def __init__(self, server, pid, idle):
        self.server, self.pid, self.idle = server, pid, idle
        self.returncode = None

    def poll(self):
        try:
            return self.wait(0.001)
        except subprocess.TimeoutExpired:
            return None

    def wait(self, timeout=None):
        if self.returncode is None:
            self.server.socket.settimeout(timeout)
            try:
                self.returncode = os.waitstatus_to_exitcode(self.server.number())
            except TimeoutError:
                raise subprocess.TimeoutExpired("the program", timeout) from None
            self.idle.put(self.server)
        return self.returncode

    def send_signal(self, number=signal.SIGTERM):
        try:
            os.kill(self.pid, number)
        except ProcessLookupError:
            pass
