# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes report.html into the folder of a run, or one page that compares several runs.

usage: ./undine report DIR                         DIR/report.html
       ./undine report A B ... [--out FILE.html]   a comparison
"""
import argparse
import os
import sys

PACKAGES = {"jinja2": "python3-jinja2", "matplotlib": "python3-matplotlib", "numpy": "python3-numpy",
            "markupsafe": "python3-markupsafe"}
FILES = ("statistics", "summary.json", "parameters.json", "log.txt")


def arguments():
    parser = argparse.ArgumentParser(prog="./undine report", description="Writes a page about a run, made of the files in its "
                                     "folder, or one that compares several runs.")
    parser.add_argument("folders", metavar="DIR", nargs="+", help="folder of a run; several: they are compared")
    parser.add_argument("--out", metavar="FILE.html", help="the page (default: report.html in the folder of the run; "
                        "comparison.html here for several)")
    options = parser.parse_args()
    for folder in options.folders:
        if not os.path.isdir(folder):
            parser.error(f"there is no folder '{folder}'")
        if not any(os.path.exists(os.path.join(folder, name)) for name in FILES):
            parser.error(f"'{folder}' holds no results of a run: none of {', '.join(FILES)}")
    return options


def main():
    options = arguments()
    try:
        from report import comparison, page_file, results, run_page
    except ImportError as error:
        package = PACKAGES.get(error.name or "", "")
        sys.exit(f"Error: {error}" + (f"; the Debian package is {package}" if package else ""))
    runs = [results.Results(folder) for folder in options.folders]
    path = options.out or ("comparison.html" if len(runs) > 1 else runs[0].path(page_file.NAME))
    try:
        page_file.write(path, comparison.write(runs) if len(runs) > 1 else run_page.write(runs[0]))
    except OSError as error:
        sys.exit(f"Error: '{path}' cannot be written: {error.strerror or error}")
    print(f"written: {path}")


if __name__ == "__main__":
    main()
