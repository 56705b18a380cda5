# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lengths of time as users write them."""
import argparse
import re

UNITS = {"": 1, "s": 1, "min": 60, "h": 3600}


def duration(text):
    """Seconds of "90", "20min" or "2h"."""
    found = re.fullmatch(r"(\d+(?:\.\d*)?)\s*(s|min|h|)", text)
    if not found:
        raise argparse.ArgumentTypeError(f"'{text}' is no time; examples: 90s, 20min, 2h")
    return float(found[1]) * UNITS[found[2]]
