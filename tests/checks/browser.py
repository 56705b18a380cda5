# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages in a headless browser: what its console says, how the page looks, and what it does under the mouse."""
import html
import json
import os
import re
import shutil
import subprocess

NAMES = ("chromium", "chromium-headless-shell", "chromium-browser", "google-chrome")
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--enable-logging=stderr", "--v=0",
         "--virtual-time-budget=4000", "--disable-dev-shm-usage"]
PROBE = """<script>
window.addEventListener("load", () => {
  const boxes = (name) => Array.from(document.querySelectorAll(name), (each) => {
    const box = each.getBoundingClientRect();
    return {text: each.innerText, left: box.left, right: box.right, top: box.top, bottom: box.bottom};
  });
  const seen = {overflow: document.documentElement.scrollWidth - document.documentElement.clientWidth, tips: {},
                verdicts: boxes(".verdict"), titles: boxes("h1"), drawings: boxes(".drawing svg"),
                broken: Array.from(document.images).filter((each) => !each.naturalWidth).length};
  for (const drawing of document.querySelectorAll(".drawing")) {
    const svg = drawing.querySelector("svg"), box = svg.getBoundingClientRect(), tip = drawing.querySelector(".tip");
    svg.dispatchEvent(new MouseEvent("mousemove", {clientX: box.left + 0.6 * box.width, clientY: box.top + 0.5 * box.height}));
    seen.tips[drawing.dataset.plot] = [tip.firstChild.textContent, ...Array.from(tip.querySelectorAll("tr"),
      (row) => Array.from(row.cells, (cell) => cell.textContent))];
    svg.dispatchEvent(new MouseEvent("mouseleave"));
  }
  const out = document.createElement("pre");
  out.id = "seen";
  out.textContent = JSON.stringify(seen);
  document.body.append(out);
});
</script></body>"""


def find():
    """The path of a browser, or None."""
    return next((found for found in map(shutil.which, NAMES) if found), None)


def call(program, page, *options, width=1280, height=900):
    """What the browser has printed, and the lines of its console."""
    done = subprocess.run([program, *FLAGS, f"--window-size={width},{height}", *options, f"file://{os.path.abspath(page)}"],
                          capture_output=True, text=True, timeout=120)
    return done.stdout, [line for line in done.stderr.splitlines() if "CONSOLE" in line]


def screenshot(program, page, picture, **size):
    """Lines of the console; the picture is a PNG."""
    return call(program, page, f"--screenshot={os.path.abspath(picture)}", **size)[1]


def seen(program, page, **size):
    """What PROBE has seen of a page, and the lines of the console."""
    with open(page, encoding="utf-8") as file:
        text = file.read()
    probed = f"{page}.probed.html"
    with open(probed, "w", encoding="utf-8") as file:
        file.write(text.replace("</body>", PROBE))
    printed, console = call(program, probed, "--dump-dom", **size)
    os.remove(probed)
    found = re.search(r'<pre id="seen">(.*?)</pre>', printed, re.S)
    if not found:
        raise RuntimeError(f"the browser has not run the page {page}: {console} {printed[-300:]}")
    return json.loads(html.unescape(found[1])), console
