#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What `cmake --install` leaves somewhere else runs from there, also after it has been moved: a scene, one on two ranks, a
tiny study, pictures and documents.

usage: check_install.py BUILD
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import check_documents
import scene_tools

STUDY = """set Scene = {prm}/piston.prm
subsection Settings
  set Time/End     = 0.1
  set Domain/Cells = 8, 2
end
subsection Vary
  subsection step
    subsection Settings
      set Time/Step = 1/20 | 1/40
    end
  end
end
subsection Quantities
  subsection tip
    set Columns = tip displacement x
  end
end
"""


def call(*words, folder, code=0):
    """What a command prints, run in a folder, where nothing points to the sources."""
    environment = {key: value for key, value in scene_tools.environment().items() if "PYTHON" not in key and "UNDINE" not in key}
    result = subprocess.run([str(word) for word in words], cwd=folder, env=environment, capture_output=True, text=True)
    if result.returncode != code:
        sys.exit(f"exit code {result.returncode} of {' '.join(map(str, words))}\n{result.stdout}\n{result.stderr}")
    return result.stdout + result.stderr


def require(holds, what):
    if not holds:
        sys.exit(f"check_install.py: {what}")


def check_documents_there(doc):
    """All links between installed documents lead somewhere; those to sources cannot."""
    pages = list(check_documents.documents(doc))
    require(len(pages) > 10, f"only {len(pages)} documents in {doc}")
    for page in pages:
        for _, reason in check_documents.broken_links(page, check_documents.without_code(page.read_text())):
            require("tests/" in reason or (".md" not in reason and ".png" not in reason), f"{page}: {reason}")


def main():
    build = os.path.abspath(sys.argv[1])
    version = pathlib.Path(scene_tools.ROOT, "VERSION").read_text().strip()
    with tempfile.TemporaryDirectory() as folder:
        call("cmake", "--install", build, "--prefix", os.path.join(folder, "first"), folder=folder)
        prefix = pathlib.Path(folder, "moved here")
        os.rename(os.path.join(folder, "first"), prefix)
        undine, prm = prefix / "bin" / "undine", prefix / "share" / "undine" / "prm"
        require(f"undine {version} " in call(undine, "--version", folder=folder), f"--version does not print {version}")
        require("study STUDY.prm" in call(undine, "--help", folder=folder), "--help does not tell of studies")
        short = ["--set", "Time/Maximum steps=2"]
        call(undine, prm / "cavity.prm", *short, folder=folder)
        call(undine, "-n", 2, prm / "closed_chamber.prm", "--output", "chamber", *short, folder=folder)
        for name, key in (("output/cavity", "Undine " + version), ("chamber", "2 rank(s)")):
            require(key in pathlib.Path(folder, name, "log.txt").read_text(), f"{name}/log.txt lacks '{key}'")
        require("no scene" in call(undine, "--validate", folder=folder, code=2), "an error is not told")

        study = pathlib.Path(folder, "tiny.prm")
        study.write_text(STUDY.format(prm=prm))
        call(undine, "study", study, folder=folder)
        with open(os.path.join(folder, "output", "studies", "tiny", "study.json")) as file:
            require(len(json.load(file)["runs"]) == 2, "the study has not made its two runs")
        call(undine, "read-study", prm / "studies" / "cavity_100.prm", folder=folder)
        require((prm / "studies" / "../../tests/reference/cavity_extrema.csv").exists(), "references of studies are missing")
        require("--compare" in call(prefix / "share/undine/contrib/render", "--help", folder=folder), "render does not start")
        check_documents_there(prefix / "share" / "doc" / "undine")
    print("installed, moved, and run from there")


if __name__ == "__main__":
    main()
