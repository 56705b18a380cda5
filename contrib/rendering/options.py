# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line of contrib/render."""
import argparse
import pathlib
import re
import sys

DIRECTIONS = ("front", "back", "left", "right", "top", "bottom", "oblique")
MAY_BE_NEGATIVE = ("--range", "--frames", "--camera", "--slice")


def numbers(count):
    def read(text):
        words = text.split(",")
        if len(words) != count:
            raise argparse.ArgumentTypeError(f"needs {count} numbers with ',' between")
        return tuple(float(word) for word in words)
    return read


def positive(text):
    value = float(text)
    if not value > 0:
        raise argparse.ArgumentTypeError(f"'{text}' is not above 0")
    return value


def plane(text):
    """(axis, place) of a text like x=0.5."""
    match = re.fullmatch(r"\s*([xyz])\s*=\s*(\S+)\s*", text)
    try:
        return "xyz".index(match[1]), float(match[2])
    except (TypeError, ValueError):
        raise argparse.ArgumentTypeError(f"'{text}' is no plane: x=0.5, y=... or z=...") from None


def parser_of(description):
    parser = argparse.ArgumentParser(description=description,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=pathlib.Path, nargs="?",
                        help="folder of a run, with solution.pvd")
    parser.add_argument("--compare", type=pathlib.Path, nargs=2, metavar=("A", "B"),
                        help="folders of two runs to be shown side by side")
    parser.add_argument("--out", type=pathlib.Path, help="folder for frame_0000.png, ... "
                        "(default: 'frames' in the results, or in A)")
    add_choices(parser.add_argument_group("what is shown"))
    add_views(parser.add_argument_group("how it is seen"))
    film = parser.add_argument_group("a film of the pictures")
    film.add_argument("--film", type=pathlib.Path, nargs="?", const="", metavar="FILE.mp4",
                      help="make one, too (default: film.mp4 in the results, or in A); needs ffmpeg")
    pace = film.add_mutually_exclusive_group()
    pace.add_argument("--rate", type=positive, metavar="N", help="pictures a second "
                      "(default: in real time, where that is 10 to 30 pictures a second, else 25)")
    pace.add_argument("--speed", type=positive, metavar="S",
                      help="seconds of the scene in one of the film: 1 is real time")
    return parser


def add_choices(group):
    group.add_argument("--field", help="what to colour by: displacement, speed, pressure, vorticity, ...; "
                       "vectors by their length. Where a part has no such field, its default")
    group.add_argument("--range", type=numbers(2), metavar="LOW,HIGH",
                       help="ends of the colour scale of --field, or of the fluid's default field (default: over "
                       "all frames)")
    group.add_argument("--slice", type=plane, action="append", default=[], metavar="AXIS=PLACE",
                       help="in space: show the fluid on this plane, as x=0.5; may be given several times")
    group.add_argument("--vectors", action="store_true", help="arrows along the fluid's velocity")
    group.add_argument("--streamlines", action="store_true",
                       help="lines along the fluid's velocity as it is at that time")
    group.add_argument("--surface", action="store_true",
                       help="draw the surface of a liquid of particles, and of bodies of particles, "
                       "instead of the particles; water, unless there is a --field")
    group.add_argument("--warp", type=float, default=1.0, metavar="FACTOR",
                       help="show displacements this much larger")


def add_views(group):
    group.add_argument("--frames", metavar="FIRST:LAST", default=":",
                       help="which output times, counted from 0; negative: from the end")
    group.add_argument("--every", type=int, default=1, metavar="N", help="only every N-th of them")
    group.add_argument("--size", metavar="WIDTHxHEIGHT",
                       help="(default: 1280x720, of two runs 1920x720)")
    group.add_argument("--camera", default=None, help="where from: " + ", ".join(DIRECTIONS) +
                       ", or X,Y,Z (a direction)")
    group.add_argument("--zoom", type=positive, default=1.0, metavar="FACTOR", help="show the middle this much larger")


def arguments(description):
    parser = parser_of(description)
    # A value that begins with a minus is no option.
    words = sys.argv[1:]
    for at in reversed(range(len(words) - 1)):
        if words[at] in MAY_BE_NEGATIVE:
            words[at:at + 2] = [words[at] + "=" + words[at + 1]]
    options = parser.parse_args(words)
    if bool(options.results) == bool(options.compare):
        parser.error("needs the folder of one run, or --compare and two")
    options.size = options.size or ("1920x720" if options.compare else "1280x720")
    options.results = options.compare or [options.results]
    try:
        options.width, options.height = (int(word) for word in options.size.split("x"))
        options.first, options.last = (int(word) if word else None
                                       for word in options.frames.split(":"))
        if options.camera and options.camera not in DIRECTIONS:
            options.camera = numbers(3)(options.camera)
    except (ValueError, argparse.ArgumentTypeError):
        parser.error("--size is like 1280x720, --frames like 0:10 or -1:, --camera a name or X,Y,Z")
    if options.every < 1 or min(options.width, options.height) < 16:
        parser.error("--every is 1 or more, --size 16x16 or more")
    if not isinstance(options.camera, (str, type(None))) and not any(options.camera):
        parser.error("--camera 0,0,0 is no direction")
    if options.range and not options.range[0] < options.range[1]:
        parser.error("--range is LOW,HIGH with LOW below HIGH")
    check_film(parser, options)
    if options.field == "speed":
        options.field = "velocity"  # vectors are coloured by their length
    options.out = options.out or options.results[0] / "frames"
    return options


def check_film(parser, options):
    if options.film is None:
        if options.rate or options.speed:
            parser.error("--rate and --speed are about a --film")
        return
    if str(options.film) in ("", "."):
        options.film = options.results[0] / "film.mp4"
    if options.film.suffix != ".mp4":
        parser.error(f"--film takes a file FILE.mp4, not '{options.film}'; the folder of the run stands before it")
    if options.width % 2 or options.height % 2:
        parser.error(f"films have even sizes, not {options.size}")
