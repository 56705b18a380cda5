# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages made of the templates in this folder; what comes from files is escaped, and nothing is fetched from elsewhere."""
import json
import os
import re
from dataclasses import dataclass, field

import jinja2
from markupsafe import Markup

GENERATOR = "undine report"
FOLDER = os.path.dirname(os.path.abspath(__file__))


@dataclass
class Section:
    """`figures`: of its plots, if it is made of plots."""
    name: str
    anchor: str = ""
    remark: str = ""
    figures: list = field(default_factory=list)

    def __post_init__(self):
        self.anchor = self.anchor or re.sub(r"\W+", "-", self.name.lower())


@dataclass
class PlotOfPage:
    """`identifier`: of the drawing on its page; `data`: what hover.js shows."""
    identifier: str
    title: str
    unit: str
    svg: Markup
    data: dict


ENVIRONMENT = jinja2.Environment(loader=jinja2.FileSystemLoader(FOLDER), autoescape=True, undefined=jinja2.StrictUndefined,
                                 trim_blocks=True, lstrip_blocks=True)


def own_file(name):
    """A style or a script, which is trusted."""
    with open(os.path.join(FOLDER, name), encoding="utf-8") as file:
        return Markup(file.read())


def json_for_script(data):
    """JSON that no text in it can end early: HTML knows nothing of strings in scripts."""
    return Markup(json.dumps(data, allow_nan=False, separators=(",", ":")).replace("<", "\\u003c"))


def page(name, sections, **values):
    """HTML of the template `name`; `plots` on it, and `frames`, if there are any, are also data of its script."""
    data = {figure.identifier: figure.data for section in sections for figure in section.figures}
    if values.get("frames"):
        data["frames"] = values["frames"]
    return ENVIRONMENT.get_template(name).render(
        sections=sections, plots=json_for_script(data), style=own_file("style.css"), script=own_file("hover.js"),
        generator=GENERATOR, **values)
