// SPDX-License-Identifier: LGPL-2.1-or-later
// Values where the mouse is, curves that can be hidden, and the film. Without scripts the page shows all but these.
"use strict";
(function () {
  const plots = JSON.parse(document.getElementById("plots").textContent);
  const names = "http://www.w3.org/2000/svg";

  function element(name, attributes, parent) {
    const made = document.createElementNS(names, name);
    for (const key in attributes) made.setAttribute(key, attributes[key]);
    return parent.appendChild(made);
  }

  // The index of the value next to x in an ascending list.
  function nearest(list, x) {
    let low = 0, high = list.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (list[middle] < x) low = middle; else high = middle;
    }
    return Math.abs(list[high] - x) < Math.abs(list[low] - x) ? high : low;
  }

  function text(value) {
    return Number.isInteger(value) && Math.abs(value) < 1e9 ? String(value) : Number(value.toPrecision(7)).toString();
  }

  function place(plot, time, value) {
    const [left, top, width, height] = plot.box, [x0, x1, y0, y1] = plot.limits;
    const scale = plot.logarithmic ? Math.log : (y) => y;
    return [left + width * (time - x0) / (x1 - x0), top + height * (1 - (scale(value) - scale(y0)) / (scale(y1) - scale(y0)))];
  }

  function watch(drawing, plot, hidden) {
    const svg = drawing.querySelector("svg"), [left, top, width, height] = plot.box, [x0, x1] = plot.limits;
    const marks = element("g", {"pointer-events": "none"}, svg);
    const tip = drawing.appendChild(document.createElement("div"));
    tip.className = "tip";
    tip.hidden = true;

    function leave() {
      marks.replaceChildren();
      tip.hidden = true;
    }

    function move(event) {
      const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
      const time = x0 + (x1 - x0) * (at.x - left) / width;
      leave();
      if (at.x < left - 4 || at.x > left + width + 4) return;
      const shown = plot.curves.map((curve, number) => ({curve, number})).filter((each) => !hidden.has(each.number));
      if (!shown.length) return;
      const table = document.createElement("table");
      let x = at.x, said = null;
      for (const {curve} of shown) {
        const times = plot.times[curve.times], row = nearest(times, time), value = curve.values[row];
        const [px, py] = place(plot, times[row], value);
        if (said === null) {
          said = times[row];
          x = px;
        }
        const line = table.insertRow(), mark = document.createElement("i");
        mark.style.background = curve.colour;
        line.insertCell().append(mark, curve.name);
        line.insertCell().append(text(value) + (plot.unit ? " " + plot.unit : ""));
        if (times[row] !== said) line.insertCell().append("at " + text(times[row]) + " s");
        if (plot.kind !== "stack" && isFinite(py) && py >= top - 1 && py <= top + height + 1)
          element("circle", {cx: px, cy: py, r: 3, fill: curve.colour, stroke: "#fff", "stroke-width": 0.8}, marks);
      }
      element("line", {x1: x, x2: x, y1: top, y2: top + height, stroke: "#555", "stroke-width": 0.6}, marks);
      tip.replaceChildren("t = " + text(said) + " s", table);
      tip.hidden = false;
      const box = drawing.getBoundingClientRect(), mouse = event.clientX - box.left;
      tip.style.left = (mouse + 16 + tip.offsetWidth > box.width ? Math.max(0, mouse - 16 - tip.offsetWidth) : mouse + 16) + "px";
      tip.style.top = Math.max(0, event.clientY - box.top - tip.offsetHeight / 2) + "px";
    }

    svg.addEventListener("mousemove", move);
    svg.addEventListener("mouseleave", leave);
  }

  // A curve of a drawing appears or vanishes.
  function show_curve(drawing, number, shown) {
    if (shown) drawing.hidden.delete(number); else drawing.hidden.add(number);
    for (const part of ["", "a", "b"]) {
      const curve = document.getElementById(drawing.identifier + "_curve" + number + part);
      if (curve) curve.style.display = shown ? "" : "none";
    }
  }

  function on_click(button, act) {
    button.addEventListener("click", () => act(!button.classList.toggle("off")));
  }

  const drawings = Array.from(document.querySelectorAll(".drawing"), (place) => {
    const identifier = place.dataset.plot, drawing = {identifier, plot: plots[identifier], hidden: new Set()};
    watch(place, drawing.plot, drawing.hidden);
    for (const button of place.closest("figure").querySelectorAll("button[data-curve]"))
      on_click(button, (shown) => show_curve(drawing, Number(button.dataset.curve), shown));
    return drawing;
  });

  // Of several runs: all curves of one.
  for (const button of document.querySelectorAll("button[data-group]"))
    on_click(button, (shown) => {
      for (const drawing of drawings)
        drawing.plot.curves.forEach((curve, number) => {
          if (curve.group === Number(button.dataset.group)) show_curve(drawing, number, shown);
        });
    });

  const film = document.querySelector(".film");
  if (film) {
    const frames = plots.frames, image = film.querySelector("img"), slider = film.querySelector("input");
    const button = film.querySelector("button");
    let timer = null;
    const show = () => { image.src = frames[slider.value]; };
    slider.addEventListener("input", show);
    button.addEventListener("click", () => {
      if (timer) {
        clearInterval(timer);
        timer = null;
      } else
        timer = setInterval(() => {
          slider.value = (Number(slider.value) + 1) % frames.length;
          show();
        }, 100);
      button.textContent = timer ? "stop" : "play";
    });
  }
})();
