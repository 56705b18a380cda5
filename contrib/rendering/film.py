# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures one after the other as a film: H.264 in MP4, which browsers and office programs play."""
import subprocess
import sys

SMOOTH = (10, 30)  # pictures a second
OTHERWISE = 25  # pictures a second, where real time is not smooth


def rate_of(interval, options):
    """Pictures a second, if there are `interval` seconds between two in the scene."""
    if options.rate:
        return options.rate
    if interval <= 0:
        return OTHERWISE
    real = (options.speed or 1) / interval
    return real if options.speed or SMOOTH[0] <= real <= SMOOTH[1] else OTHERWISE


def pace(rate, interval):
    """In words: how fast the film is."""
    speed = rate * interval
    if speed <= 0 or abs(speed - 1) < 0.01:
        return "in real time"
    return f"{speed:.3g} times as fast as in reality" if speed > 1 else f"{1 / speed:.3g} times slower than in reality"


def make_film(pattern, count, interval, options):
    """`pattern`: of the pictures' names, with %04d, counted from 0. Returns what was made, in words."""
    rate = rate_of(interval, options)
    # What would be jerky is repeated, what nobody would see left out: the pace stays.
    played = min(max(rate, SMOOTH[0]), 2 * SMOOTH[1])
    command = ["ffmpeg", "-y", "-loglevel", "error", "-framerate", repr(rate), "-i", str(pattern),
               "-frames:v", str(max(1, round(count * played / rate))), "-r", repr(played),
               "-c:v", "libx264", "-crf", "20", "-preset", "slow", "-pix_fmt", "yuv420p",
               "-movflags", "+faststart", str(options.film)]
    result = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if result.returncode != 0:
        sys.exit(f"render: the film '{options.film}' could not be made:\n{result.stderr.strip()}")
    return f"{count / rate:.3g} s at {rate:.3g} pictures a second, {pace(rate, interval)}, in {options.film}"
