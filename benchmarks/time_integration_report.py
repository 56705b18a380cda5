# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables and pictures of benchmarks/time_integration.py from its runs."""
import csv
import math
import os
import sys
from dataclasses import dataclass

import accuracy

WANTED = 0.01  # relative error
STYLES = ("-", "--", ":", "-.")  # of lines, one for each setting of Newton's method


@dataclass
class Result:
    """The runs of a case by (integrator, Newton, steps per second), the name of the reference's integrator and its
    runs with the finest step and twice that."""
    name: str
    case: object
    steps: tuple
    runs: dict
    reference: str
    finest: list

    def finest_step(self):
        """Steps per second of the reference."""
        return round((len(self.finest[0].columns["Time"]) - 1) / self.case.end)

    def reference_series(self, quantity):
        return self.finest[0].series(self.case, quantity, self.reference)

    def uncertainty(self, quantity):
        """Relative difference between the two runs of the reference."""
        return accuracy.errors(self.finest[1].series(self.case, quantity, self.reference),
                               self.reference_series(quantity))[0]

    def errors(self, key, quantity):
        """(over time, largest) of a run; (nan, nan) if it did not reach the end."""
        run = self.runs[key]
        if run.complaint:
            return math.nan, math.nan
        return accuracy.errors(run.series(self.case, quantity, key[0]), self.reference_series(quantity))

    def own_order(self, integrator, newton, quantity):
        """From the three shortest steps."""
        runs = [self.runs[integrator, newton, per_second] for per_second in self.steps[-3:]]
        if any(run.complaint for run in runs):
            return math.nan
        return accuracy.own_order([run.series(self.case, quantity, integrator) for run in runs])

    def order(self, integrator, newton, quantity):
        """Against the reference, from the two shortest steps."""
        return accuracy.order(*(self.errors((integrator, newton, per_second), quantity)[0]
                                for per_second in self.steps[-2:]))

    def pressure_share(self, integrator, newton):
        """At which share of the shortest step the pressure fits the reference best."""
        run = self.runs[integrator, newton, self.steps[-1]]
        if run.complaint:
            return math.nan
        return accuracy.fitted_share(run.columns["Time"], run.columns[self.case.quantities["pressure"]],
                                     self.reference_series("pressure"))

    def cheapest(self, integrator, newton, quantity):
        """(core seconds, corrections, steps per second) of the longest step that is accurate enough and has no shorter
        one that is not: errors that cancel by chance do not count. None without any."""
        found = None
        for step in self.steps[::-1]:
            if not self.errors((integrator, newton, step), quantity)[0] <= WANTED:
                break
            run = self.runs[integrator, newton, step]
            found = run.seconds, run.corrections(), step
        return found

    def methods(self):
        return list(dict.fromkeys(key[:2] for key in self.runs))


def need_matplotlib():
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        sys.exit("time_integration.py: this Debian package is needed: python3-matplotlib")


def number(value, form):
    return "" if math.isnan(value) else format(value, form)


def row(cells):
    return "| " + " | ".join(map(str, cells)) + " |"


def heading(cells):
    return [row(cells), "|---" * len(cells) + "|"]


def cell(result, key, quantity):
    """Both errors of a run, or where it stopped."""
    if result.runs[key].complaint:
        return f"stops at {result.runs[key].until():.3g} s"
    return "{:.1e} ({:.1e})".format(*result.errors(key, quantity))


def error_table(result, quantity):
    """A row for each integrator and setting of Newton's method, a column for each step."""
    pressure = quantity == "pressure"
    lines = heading(["integrator", "Newton"] + [f"1/{step} s" for step in result.steps] +
                    ["own order", "order"] + ["fits at"] * pressure)
    for method in result.methods():
        lines.append(row([*method] + [cell(result, (*method, step), quantity) for step in result.steps] +
                         [number(result.own_order(*method, quantity), ".2f"),
                          number(result.order(*method, quantity), ".2f")] +
                         ([number(result.pressure_share(*method), ".2f")] if pressure else [])))
    return lines


def cost(seconds, corrections, per_second):
    return f"{seconds:.2f} s, {corrections} (1/{per_second})"


def cheapest_table(result):
    """Core seconds, corrections and step of the shortest step, and of the longest within the wanted error."""
    quantities = list(result.case.quantities)
    lines = heading(["integrator", "Newton", "shortest step"] + [name for name in quantities])
    for method in result.methods():
        shortest = result.runs[(*method, result.steps[-1])]
        cells = [*method, "" if shortest.complaint else
                 cost(shortest.seconds, shortest.corrections(), result.steps[-1])]
        for quantity in quantities:
            found = result.cheapest(*method, quantity)
            cells.append(cost(*found) if found else "–")
        lines.append(row(cells))
    return lines


def section(result):
    case = result.case
    lines = [f"## {result.name}: {case.title}", "",
             f"`{case.scene}`, {case.end} s" + "".join(f", `{setting}`" for setting in case.settings) +
             f". Reference: {result.reference}, 1/{result.finest_step()} s; "
             "with twice that step it differs by " +
             ", ".join(f"{result.uncertainty(name):.1e} ({name})" for name in case.quantities) + ".", ""]
    for quantity, column in case.quantities.items():
        lines += [f"**{quantity.capitalize()}** (`{column}`)", ""] + error_table(result, quantity) + [""]
    lines += [f"**Cheapest run with an error of at most {WANTED:.0%}, as have all shorter steps** "
              "(core seconds, corrections by Newton's method, step in s)", ""] + cheapest_table(result) + [""]
    return lines + [f"- {why}" for why in stops(result)] + [""]


def stops(result):
    """Which integrators stopped, and what the program said."""
    said = {}
    for key, run in result.runs.items():
        if run.complaint:
            said.setdefault(run.complaint, {})[key[0]] = None
    return [f"{', '.join(names)}: {why}" for why, names in said.items()]


def write_csv(results, file):
    """A line for every run and quantity."""
    with open(file, "w", newline="") as stream:
        writer = csv.writer(stream)
        writer.writerow(["case", "integrator", "newton", "step [s]", "core seconds", "corrections", "until [s]",
                         "quantity", "error over time", "largest error", "complaint"])
        for result in results:
            for key, run in result.runs.items():
                for quantity in result.case.quantities:
                    errors = (number(error, ".4e") for error in result.errors(key, quantity))
                    writer.writerow([result.name, *key[:2], 1 / key[2], f"{run.seconds:.4f}", run.corrections(),
                                     run.until(), quantity, *errors, run.complaint])


def looks(result):
    """Colours of integrators and styles of Newton's settings, by name."""
    integrators, newtons = (list(dict.fromkeys(names)) for names in zip(*result.methods()))
    return {name: f"C{k}" for k, name in enumerate(integrators)}, dict(zip(newtons, STYLES))


def plot_curves(axis, result, quantity):
    from matplotlib.ticker import LogLocator
    colours, styles = looks(result)
    for integrator, newton in result.methods():
        points = [(result.runs[integrator, newton, step].seconds,
                   result.errors((integrator, newton, step), quantity)[0]) for step in result.steps]
        axis.loglog(*zip(*points), styles[newton], color=colours[integrator], marker="o", ms=2.5, lw=0.9)
    axis.axhline(WANTED, color="grey", lw=0.6)
    axis.axhline(result.uncertainty(quantity), color="grey", lw=0.6, ls="-.")
    axis.set_title(quantity, fontsize=10)
    axis.set_xlabel("core seconds")
    axis.xaxis.set_minor_locator(LogLocator(subs=(2, 5)))
    axis.xaxis.set_major_formatter("{x:g}")
    axis.xaxis.set_minor_formatter("{x:g}")
    axis.set_ylim(top=2)
    axis.grid(alpha=0.3, which="both", lw=0.4)


def plot(result, file):
    """Error over core seconds, one panel for each quantity; grey: the wanted error, and how sure the reference is."""
    import matplotlib
    matplotlib.use("Agg")
    from PIL import Image
    from matplotlib import pyplot
    from matplotlib.lines import Line2D
    figure, axes = pyplot.subplots(1, len(result.case.quantities), figsize=(11, 3.6), squeeze=False)
    for axis, quantity in zip(axes[0], result.case.quantities):
        plot_curves(axis, result, quantity)
    axes[0][0].set_ylabel("relative error")
    colours, styles = looks(result)
    figure.legend(handles=[Line2D([], [], color=colour, label=name) for name, colour in colours.items()] +
                  [Line2D([], [], color="k", ls=style, label=f"Newton {name}") for name, style in styles.items()],
                  loc="center left", bbox_to_anchor=(0.86, 0.5), fontsize=8)
    figure.tight_layout(rect=(0, 0, 0.86, 1))
    figure.savefig(file, dpi=75)
    pyplot.close(figure)
    Image.open(file).convert("RGB").quantize(256).save(file, optimize=True)


def show(result):
    """Prints orders and the cheapest runs."""
    print(f"\n{result.name}: own orders of " + ", ".join(result.case.quantities))
    for method in result.methods():
        orders = [number(result.own_order(*method, quantity), ".2f") for quantity in result.case.quantities]
        print(f"  {', Newton '.join(method)}: " + ", ".join(one or "none" for one in orders))
    print("\n".join(cheapest_table(result)), flush=True)


def write(results, folder):
    """All files."""
    lines = [line for result in results for line in section(result)]
    with open(os.path.join(folder, "time_integration.md"), "w") as file:
        file.write("\n".join(lines).rstrip() + "\n")
    write_csv(results, os.path.join(folder, "time_integration.csv"))
    for result in results:
        plot(result, os.path.join(folder, f"time_integration_{result.name}.png"))
