# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reading a page about a run as a browser does, without one."""
import html.parser
import json


class Page(html.parser.HTMLParser):
    """What a browser would see: text by section, links, and the data of scripts."""

    VOID = {"meta", "link", "img", "input", "br"}

    def __init__(self, text):
        super().__init__()
        self.sections, self.links, self.scripts, self.tags, self.styles = {"": ""}, [], [], [], ""
        self.open, self.section, self.first = [], "", ""
        self.feed(text)
        self.plots = json.loads(self.scripts[0])

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.tags.append(tag)
        self.links += [attributes[key] for key in ("src", "href", "xlink:href", "data", "action") if key in attributes]
        if tag == "section":
            self.section = attributes.get("id", "first")
            self.sections.setdefault(self.section, "")
        if tag == "script":
            self.scripts.append("")
        if tag in ("td", "th", "dd"):
            self.sections[self.section] += " "  # as far apart as they are seen
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        while self.open and self.open.pop() != tag:
            pass
        if tag == "section":
            self.section = ""

    def handle_data(self, data):
        if self.open[-1:] == ["script"]:
            self.scripts[-1] += data
        elif self.open[-1:] == ["style"]:
            self.styles += data
        else:
            self.sections[self.section] += data
