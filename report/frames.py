# SPDX-License-Identifier: LGPL-2.1-or-later
"""Frames, or a film, that contrib/render has left in the folder of a run, small enough to be part of its page."""
import base64
import glob
import io
import os

MOST = 60
WIDTH = 720  # pixels
FILM = "film.mp4"
MOST_BYTES = 8_000_000  # of a film that is part of the page; a larger one must lie beside it
SOON = 60  # seconds: files of a folder that was copied are no older than this beside each other


def small(path):
    """A data URI of the picture, not wider than WIDTH."""
    from PIL import Image  # only runs with frames need it
    with Image.open(path) as picture:
        picture = picture.convert("RGB")
        if picture.width > WIDTH:
            picture = picture.resize((WIDTH, round(picture.height * WIDTH / picture.width)))
        stream = io.BytesIO()
        picture.save(stream, "JPEG", quality=75, optimize=True)
    return "data:image/jpeg;base64," + base64.b64encode(stream.getvalue()).decode()


def is_of_earlier_run(results, file):
    """Was it made before the run began that this folder is about now? A run leaves what it has not written."""
    begin = results.path("original.prm")
    try:
        return os.path.getmtime(file) < os.path.getmtime(begin) - SOON
    except OSError:  # one of them is not there
        return False


def of_run(results):
    """([data URI], number of frames that there are): all frames, or MOST of them evenly."""
    files = sorted(glob.glob(os.path.join(glob.escape(results.folder), "frames", "frame_*.png")))
    if files and is_of_earlier_run(results, files[-1]):
        results.problems.append("the pictures in 'frames' are of an earlier run in this folder; contrib/render makes them anew")
        return [], 0
    step = -(-len(files) // MOST) or 1
    pictures = []
    for file in files[::step]:
        try:
            pictures.append(small(file))
        except (OSError, ImportError) as error:
            results.problems.append(f"'frames/{os.path.basename(file)}' cannot be shown: {error}")
    return pictures, len(files)


def film_of(results):
    """(what a page plays, whether that is a part of it): a data URI, or the name of the file beside it; "" if there is no film."""
    path = results.path(FILM)
    if is_of_earlier_run(results, path):
        results.problems.append(f"'{FILM}' is of an earlier run in this folder; contrib/render --film makes it anew")
        return "", False
    try:
        if os.path.getsize(path) > MOST_BYTES:
            return FILM, False
        with open(path, "rb") as file:
            return "data:video/mp4;base64," + base64.b64encode(file.read()).decode(), True
    except FileNotFoundError:
        return "", False
    except OSError as error:
        results.problems.append(f"'{FILM}' cannot be shown: {error}")
        return "", False
