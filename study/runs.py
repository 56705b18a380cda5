# SPDX-License-Identifier: LGPL-2.1-or-later
"""One run of a study: started, measured, and kept so that it need not be made again."""
import ctypes
import functools
import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time

from study import columns, scene_files
from study.cases import Case, of_scene, ranks
from study.description import Study

REPETITIONS = 3
RESULTS = (0, 2, 3)  # exit codes that say something of the case: success, refused, not solved
KEPT_FILES = ("statistics", "summary.json", "timing")


def environment():
    """MPI allowed for root and on few cores; one thread a rank; no pages."""
    return dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                OMPI_MCA_rmaps_base_oversubscribe="1", OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                UNDINE_REPORT="off",  # pages about single runs would cost more than many of them
                OMPI_MCA_hwloc_base_binding_policy="none")  # else runs at the same time would share processors


def digest_of_file(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


def identity(study, case, program_digest):
    """A name for the folder of a case: the same only for the same scene, settings, files that they name, and program."""
    settings = json.dumps(case.settings(study), sort_keys=True)
    parts = [scene_files.all_text(study.scene), settings, str(study.ranks), program_digest]
    parts += scene_files.named_files(study.scene, [f"{key} = {value}" for key, value in case.settings(study).items()])
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:16]


def message_of(text):
    """Why a run has failed, without the advice that follows; of several mistakes all."""
    error = re.search(r"Error: (.*?)(?=\n|\Z)", text, re.S)
    if not error:
        return (text.strip().splitlines() or ["no message"])[-1]
    message = error[1].strip()
    if message.endswith("mistakes in the scene:"):
        mistakes = re.findall(r"^(?:\S+\.prm\S*|command line): .*$", text[error.end():], re.M)
        message += " " + "; ".join(mistake.rstrip(".") for mistake in mistakes)
    return message


def reason(result):
    """Why a run has failed, without which step it was and what else is said of it."""
    step = re.match(r"step \d+, which begins at \S+ s: (?:a step of \S+ s (?:and \d+ shorter one\(s\) )?failed, the last one of \S+ s: )?"
                    r"(?:\S+\.prm: (?:at|by) \S+ s )?(?:body .*?the point that rests at .*?: )?(.*)", result["failure"], re.S)
    if step:
        return re.split(r"[:;] |\.(?: |$)|, at \(", step[1])[0]
    return re.sub(r"\S*/(?=\S+\.prm:)", "", result["failure"])  # whose folder the scene lies in does not matter


def scene_without(study, keys, folder):
    """The path of a copy of the scene without some keys, and what it needs to find other files."""
    path = os.path.join(folder, os.path.basename(study.scene))
    text = scene_files.without(study.scene, keys)
    with open(path, "w") as file:
        file.write(text)
    named = re.search(r"^\s*set\s+Folder of files\s*=([^#\n]*)", text, re.M)
    return path, {"Folder of files": os.path.join(os.path.dirname(os.path.abspath(study.scene)), named[1].strip() if named else "")}


def scene_and_settings(study, case, folder):
    """The scene of a case, in the folder if it lacks keys of the study's scene, and {"Section/Key": value} to set in it."""
    settings = of_scene(case.settings(study))
    left_out = {key for key, value in settings.items() if not value}
    scene, own = scene_without(study, left_out, folder) if left_out else (study.scene, {})
    return scene, {**own, **{key: value for key, value in settings.items() if value}}


def assignments(settings):
    return [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]


def command(program, study, case, folder):
    """To run a case in a folder, with the results in another one within it."""
    scene, settings = scene_and_settings(study, case, folder)
    count = ranks(study, case)
    words = ["mpirun", "-n", str(count)] if count > 1 else []
    return words + [program, scene, "--output", os.path.join(folder, "run")] + assignments(
        {"Output/Interval": "0", "Output/Parts": "statistics", **settings})


def end_with_parent(parent):
    """Ask the system to end this process when the one that has started it (its number) ends, however that happens."""
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG
    if os.getppid() != parent:  # it has ended before it was asked
        os._exit(1)


def wait(process, limit):
    """Seconds of processors of a process, and whether it was stopped at the limit [s]."""
    begin, stopped = time.monotonic(), False
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid:
            process.returncode = os.waitstatus_to_exitcode(status)
            return usage.ru_utime + usage.ru_stime, stopped
        if limit and not stopped and time.monotonic() - begin > limit:
            os.killpg(process.pid, signal.SIGKILL)
            stopped = True
        try:
            time.sleep(0.02)
        except KeyboardInterrupt:  # the run keeps its last state
            os.killpg(process.pid, signal.SIGTERM)
            process.wait()
            raise


def execute(words, limit, printed):
    """Run a program until its end or for `limit` seconds; what it prints goes to a file."""
    begin = time.monotonic()
    process = subprocess.Popen(words, env=environment(), stdout=printed, stderr=printed, stdin=subprocess.DEVNULL,
                               start_new_session=True, preexec_fn=functools.partial(end_with_parent, os.getpid()))
    seconds, stopped = wait(process, limit)
    printed.seek(0)
    failure = "" if process.returncode == 0 else message_of(printed.read())
    return {"failure": f"took longer than {limit:.3g} s" if stopped else failure, "stopped": stopped,
            "core seconds": seconds, "wall seconds": time.monotonic() - begin, "elapsed": time.monotonic() - begin,
            "exit code": process.returncode}


def once(program, study, case, folder, limit):
    """The result of a run as a dictionary; its files stay in the folder."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    with open(os.path.join(folder, "printed"), "w+") as printed:
        result = execute(command(program, study, case, folder), limit, printed)
    return {**result, **summary_of(os.path.join(folder, "run", "summary.json"))}


def single(program, scene, settings, ranks_of_run=1):
    """The result of one run of a scene with other settings, {"Section/Key": value}, and its columns: for scripts that
    measure more than a study does. What has failed has columns as far as it came."""
    study = Study("", "", os.path.abspath(scene), ranks_of_run, 0.0, 0.0, "core seconds", "all", [], settings, [])
    with tempfile.TemporaryDirectory() as folder:
        result = once(program, study, Case(()), folder, 0)
        path = os.path.join(folder, "run", "statistics")
        return result, columns.read(path) if os.path.exists(path) else {}


def summary_of(path):
    """What a run says of itself: costs without those of its start."""
    try:
        with open(path) as file:
            summary = json.load(file)
    except (OSError, ValueError):
        return {}
    cost, certificate = summary["cost"], summary.get("certificate", {})
    splitting = summary.get("stability of splitting", {})
    return {"verdict": certificate.get("verdict", ""), "verdict in words": certificate.get("text", ""),
            "steps redone": certificate.get("steps redone", 0),
            "core seconds": cost["core seconds"], "wall seconds": cost["wall seconds"],
            "memory": cost["peak memory [bytes]"], "steps": summary["steps"],
            "Newton iterations": summary["Newton iterations"], "linear iterations": summary["linear iterations"],
            "foretold growth": splitting.get("growth of the run"),
            "unknowns": sum(summary["unknowns"].values()), "reached": summary["time [s]"]}


def keep(folder, result):
    """Leave what is needed of a run in the folder, and the result as the last file: with it, the case is finished."""
    for name in KEPT_FILES:
        source = os.path.join(folder, "run", name)
        if os.path.exists(source):
            os.replace(source, os.path.join(folder, name))
    shutil.rmtree(os.path.join(folder, "run"), ignore_errors=True)
    path = os.path.join(folder, "result.json")
    with open(path + ".new", "w") as file:
        json.dump(result, file, indent=1)
        file.flush()
        os.fsync(file.fileno())
    os.replace(path + ".new", path)


def finished(folder, limit):
    """The result of a case, or None; a run that was stopped at another limit [s] has none."""
    try:
        with open(os.path.join(folder, "result.json")) as file:
            result = json.load(file)
    except (OSError, ValueError):
        return None
    return None if result["stopped"] and result["limit"] != limit else result


def run(program, study, case, folder, limit):
    """Make a run, three times if it is short: the one of median cost counts, with all its times. Kept are those that
    succeed, that the program refuses or cannot solve, and that are stopped at the limit [s] of the study; not those that
    were stopped otherwise."""
    begin, results = time.monotonic(), []
    folders = [folder] + [f"{folder}.again{number}" for number in range(1, REPETITIONS)]
    while not results or (not results[0]["failure"] and results[0]["core seconds"] < study.repeat_below
                          and len(results) < REPETITIONS):
        left = max(1.0, limit + begin - time.monotonic()) if limit else 0
        again = once(program, study, case, folders[len(results)], left)
        if results and again["failure"]:
            break
        results.append(again)
    middle = sorted(range(len(results)), key=lambda number: results[number]["core seconds"])[(len(results) - 1) // 2]
    if middle > 0:
        shutil.rmtree(folder)
        os.replace(folders[middle], folder)
    for other in folders[1:]:
        shutil.rmtree(other, ignore_errors=True)
    result = results[middle]
    result["elapsed"], result["limit"] = time.monotonic() - begin, study.limit
    result["repetitions"] = len(results)
    result["case"] = case.name(study)
    result["settings"] = case.settings(study)
    at_limit = result["stopped"] and limit == study.limit
    if at_limit or (not result["stopped"] and result["exit code"] in RESULTS):
        keep(folder, result)
    return result
