# SPDX-License-Identifier: LGPL-2.1-or-later
"""The arguments of benchmarks that compare grids, steps and forms of convection."""
import argparse
import os

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def parser(description):
    """PROGRAM, --across, --step, --form and --check; None where nothing is given."""
    result = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    result.add_argument("program", nargs="?", default=os.path.join(ROOT, "build", "undine"))
    result.add_argument("--across", action="append", type=int)
    result.add_argument("--step", action="append")
    result.add_argument("--form", action="append", choices=("along paths", "flux"))
    result.add_argument("--check", action="store_true")
    return result
