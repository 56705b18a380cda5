# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mutations of the command line. Each takes a random generator, the case and the Stock of scenes."""
import odd_values
import scene_reader

FORMS = ("/=1", "=1", "=", "", "/", "//", "Time//End=1", "Time/=1", "/Time/End=1", "Time/End", "Time/End=", "Time/End==1",
         "Time/End=1=2", " Time / End = 1 ", "Time/ End=1", "Time", "Time=1", "Title=", "Title=a#b", "Title=a\\", "Title=a\\\\",
         "Title=a\nset Dimension = 3", "Title=\n", "Time/End=1\n", "Title=\t", "Title=\x01", "Title=a\"b<c>&d", "Title=é",
         "Title=\udcff", "é=1", "é/é=1", "Bodies/new/Density=1", "Bodies/a b/Density=1", "Bodies/a\"b<c/Density=1",
         "Effects/convection/=1", "Dimension=3", "Dimension=2", "Dimension=1,5", "Time/End=1,5", "Time/Step=1,5e-1",
         "Time/Step=rand()", "Time/Step=t", "time/end=1", "Time/Stepp=1", "Folder of files=nowhere", "Scheme=particle",
         "Scheme=time_splitting", "Title=" + "a" * 100000, "a" * 5000 + "=1", "/" * 5000 + "=1", "# comment", "Title=#", "--help",
         "Output/Parts=vtu, vtu", "Output/Parts=", "Output/Parts=xdmf", "Output/Parts=xdmf, vtu, checkpoint, statistics",
         "Output/Interval=1e-300", "Output/Interval=1e300", "Time/End=1e300", "Time/Step=1e-300", "Time/Step=1e300",
         "Time/End=5e-324", "Time/Maximum steps=0", "Output/checkpoint/Interval=0", "Output/Budget=true",
         "Output/vtu/Bodies=deformed", "Output/vtu/Cells of bodies=high-order")
OUTPUTS = ("a#b", "a b", "é", "a\\b", "a\\", "a\"b<c>&d", "a'b", "a%sb", "{0}", "a/b/c", "a//b/", "./a", "a/../b", "-a", "a\nb",
           "\udcff", "a=b", "a;b", "$HOME", "*", "名前", "a.prm", "solution.pvd", "a" * 200, "a" * 300)
WORDS = (["--validate"], ["--overwrite"], ["--reference"], ["--version"], ["--no-such-option"], ["--"], ["--set"], ["--output"],
         ["extra.prm"], [""], ["-h"], ["--help"], ["resume"], ["resume", "nowhere"], ["--set=Time/End=1"], ["-1"], ["@file"],
         ["--validate=maybe"], ["--Validate"], ["\udcff"], ["--output=a", "--output=b"])


def setting_by_form(rng, case, stock):
    for _ in range(rng.choice((1, 1, 2, 3))):
        case.assignments.append(rng.choice(FORMS))


def setting_of_a_key(rng, case, stock):
    """A key that the scene has, with another value."""
    values = scene_reader.read_scene(case.files, case.scene).values
    if not values:
        return setting_by_form(rng, case, stock)
    path = rng.choice(sorted(values))
    value = odd_values.changed_value(rng, values[path], stock.values).replace("\x00", "")
    case.assignments.append(f"{path}={value[:100000]}")
    return None


def output(rng, case, stock):
    case.output = rng.choice(OUTPUTS)
    if case.output.startswith("-"):
        case.output = "./" + case.output


def words(rng, case, stock):
    case.words = case.words + rng.choice(WORDS)


MUTATIONS = {  # name: (function, weight)
    "setting by form": (setting_by_form, 6), "setting of a key": (setting_of_a_key, 8), "output": (output, 5),
    "words": (words, 1)}
