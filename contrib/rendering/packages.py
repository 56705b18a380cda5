# SPDX-License-Identifier: LGPL-2.1-or-later
"""The Debian packages that pictures need, and a display that nobody sees."""
import ctypes
import os
import shutil
import signal
import subprocess
import sys

PACKAGES = ["python3-vtk9", "python3-numpy", "xvfb"]
FOR_FILMS = ["ffmpeg"]
ATTEMPTS = 5  # to start a display


def missing_packages(film):
    try:
        import numpy  # noqa: F401  (python3-vtk9 only recommends it)
        import vtk  # noqa: F401
        missing = [] if shutil.which("Xvfb") else PACKAGES
    except ImportError:
        missing = PACKAGES
    return missing + (FOR_FILMS if film and not shutil.which("ffmpeg") else [])


def provide_packages(film):
    """Import VTK and NumPy, after installing what is missing if need and rights are there; ffmpeg only for a film."""
    missing = missing_packages(film)
    if missing:
        command = ["apt-get", "install", "-y", "--no-install-recommends"] + missing
        if os.geteuid() != 0 or "UNDINE_RENDER_INSTALLED" in os.environ:
            sys.exit("render: these Debian packages are needed: " + " ".join(missing) +
                     "\n  sudo " + " ".join(command))
        subprocess.run(["apt-get", "update", "-q"], stdout=sys.stderr, check=False)
        subprocess.run(command, stdout=sys.stderr, check=False)
        os.environ["UNDINE_RENDER_INSTALLED"] = "1"
        os.execv(sys.executable, [sys.executable] + sys.argv)
    import vtk
    vtk.vtkObject.GlobalWarningDisplayOff()


def virtual_display():
    """The number of a new X server without a screen, which ends with this program; "" if it could not start, as when two
    start at the same moment and want the same number."""
    out, into = os.pipe()
    end_with_parent = ctypes.CDLL(None).prctl
    subprocess.Popen(["Xvfb", "-displayfd", str(into), "-screen", "0", "64x64x24",
                      "-nolisten", "tcp"], pass_fds=[into], stdin=subprocess.DEVNULL,
                     stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                     preexec_fn=lambda: end_with_parent(1, signal.SIGTERM))
    os.close(into)
    with os.fdopen(out) as answer:
        return answer.readline().strip()


def start_virtual_display():
    """VTK of Debian 12 draws through an X server."""
    number = next(filter(None, (virtual_display() for _ in range(ATTEMPTS))), "")
    if not number:
        sys.exit("render: the X server Xvfb does not start")
    os.environ["DISPLAY"] = ":" + number
