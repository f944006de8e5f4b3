// SPDX-License-Identifier: GPL-2.0-or-later
// Draws fields on the moved mesh from the JSON beside each canvas (app/page/page.hpp).
"use strict";

// Viridis, and blue over white to red for what has both signs: both keep their order without colour.
const sequential = ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"];
const diverging = ["#2166ac", "#67a9cf", "#d1e5f0", "#f7f7f7", "#fddbc7", "#ef8a62", "#b2182b"];

function parts(colour) {
  return [1, 3, 5].map((k) => parseInt(colour.slice(k, k + 2), 16));
}

function colourAt(stops, share) {
  const place = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const k = Math.min(Math.floor(place), stops.length - 2);
  const low = parts(stops[k]);
  const high = parts(stops[k + 1]);
  return `rgb(${low.map((value, i) => Math.round(value + (place - k) * (high[i] - value))).join(",")})`;
}

// The pictures of a page: runs that are compared have one scale of colours for a field.
const pictures = [];

// The range of a field over all frames of all pictures, so that colours mean the same everywhere; round zero where both
// signs are there.
function scaleOf(name) {
  let least = Infinity;
  let most = -Infinity;
  for (const content of pictures) {
    const field = content.fields.findIndex((of) => of.name === name);
    if (field < 0) continue;
    for (const frame of content.frames) {
      for (const value of frame.values[field]) {
        if (value === null) continue;
        least = Math.min(least, value);
        most = Math.max(most, value);
      }
    }
  }
  if (!(least <= most)) return { least: 0, most: 1, stops: sequential };
  if (least < 0 && most > 0) {
    const size = Math.max(-least, most);
    return { least: -size, most: size, stops: diverging };
  }
  return { least, most: most > least ? most : least + 1, stops: sequential };
}

function element(name, attributes, parent) {
  const made = Object.assign(document.createElement(name), attributes);
  parent.appendChild(made);
  return made;
}

function labelled(text, control, parent) {
  const label = element("label", { textContent: text + " " }, parent);
  label.appendChild(control);
  return control;
}

function showMesh(figure, content) {
  const canvas = figure.querySelector("canvas");
  const controls = document.createElement("div");
  controls.className = "controls";
  figure.insertBefore(controls, canvas);
  const field = labelled("", document.createElement("select"), controls);
  content.fields.forEach((of, k) => element("option", { value: k, textContent: of.name }, field));
  const last = content.frames.length - 1;
  const frame = document.createElement("input");
  Object.assign(frame, { type: "range", min: 0, max: last, step: 1, value: last, ariaLabel: "frame" });
  controls.appendChild(frame);
  const play = element("button", { type: "button", textContent: "play" }, controls);
  const factor = document.createElement("input");
  Object.assign(factor, { type: "number", value: 1, step: "any" });
  labelled("displacement times", factor, controls);
  const caption = element("figcaption", {}, figure);

  const dim = content.dimension;
  const space = dim === 3;
  let turn = -0.6; // of a body in space about x3, and its tilt towards the eye, rad
  let tilt = 0.35;
  let scale = scaleOf(content.fields[0].name);
  let shown = []; // numbers and paths of the outlines in the order drawn last

  // Where a node is on the plane of the picture, and how far from the eye.
  function seen(node, moved, times) {
    const [x, y, z] = [0, 1, 2].map((i) =>
      i < dim ? content.nodes[dim * node + i] + times * moved[dim * node + i] : 0);
    if (!space) return [x, y, 0];
    const across = Math.cos(turn) * x + Math.sin(turn) * y;
    const away = Math.cos(turn) * y - Math.sin(turn) * x;
    return [across, Math.cos(tilt) * z + Math.sin(tilt) * away, Math.cos(tilt) * away - Math.sin(tilt) * z];
  }

  // The room of the body in the picture over all frames, so that it does not jump from one to the next.
  function bounds(times) {
    const found = [Infinity, -Infinity, Infinity, -Infinity];
    for (const of of content.frames) {
      for (let node = 0; node < content.nodes.length / dim; ++node) {
        const [x, y] = seen(node, of.moved, times);
        found[0] = Math.min(found[0], x);
        found[1] = Math.max(found[1], x);
        found[2] = Math.min(found[2], y);
        found[3] = Math.max(found[3], y);
      }
    }
    return found;
  }

  function draw() {
    const ratio = window.devicePixelRatio || 1;
    const width = canvas.clientWidth;
    const height = canvas.clientHeight;
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    const now = content.frames[frame.value];
    const times = Number(factor.value) || 0;
    const [left, right, low, high] = bounds(times);
    const bar = 90;
    const size = Math.min((width - bar - 20) / (right - left || 1), (height - 20) / (high - low || 1));
    const offset = (width - bar - size * (right - left)) / 2;
    const place = (node) => {
      const [x, y] = seen(node, now.moved, times);
      return [offset + size * (x - left), 10 + size * (high - y)];
    };
    // Far faces first, so that near ones hide them.
    const hidden = new Set(now.hidden);
    const order = content.outlines.map((nodes, e) => e).filter((e) => !hidden.has(e));
    if (space) {
      const far = content.outlines.map((nodes) =>
        nodes.reduce((sum, node) => sum + seen(node, now.moved, times)[2], 0) / nodes.length);
      order.sort((a, b) => far[b] - far[a]);
    }
    const values = now.values[field.value];
    const lines = content.outlines.length < 5000;
    shown = order.map((e) => {
      const path = new Path2D();
      content.outlines[e].forEach((node, k) => (k === 0 ? path.moveTo(...place(node)) : path.lineTo(...place(node))));
      path.closePath();
      const value = values[e];
      context.fillStyle =
        value === null ? colourOf("--faint") : colourAt(scale.stops, (value - scale.least) / (scale.most - scale.least));
      context.fill(path);
      context.strokeStyle = lines ? "rgba(0,0,0,.35)" : context.fillStyle;
      context.lineWidth = 0.5;
      context.stroke(path);
      return [e, path];
    });
    // As high as the picture, unless that leaves no room for its numbers.
    const tall = Math.max(size * (high - low), 60);
    for (let k = 0; k < 100; ++k) {
      context.fillStyle = colourAt(scale.stops, 1 - k / 99);
      context.fillRect(width - bar + 10, 10 + (tall * k) / 100, 14, tall / 100 + 1);
    }
    context.fillStyle = colourOf("--text");
    context.font = "12px sans-serif";
    for (const share of [0, 0.25, 0.5, 0.75, 1])
      context.fillText(short(scale.least + share * (scale.most - scale.least)), width - bar + 28,
                       14 + tall * (1 - share));
    say();
  }

  function say(number) {
    const of = content.fields[field.value];
    const unit = of.unit && of.unit !== "1" ? ", " + of.unit : "";
    const now = content.frames[frame.value];
    caption.textContent =
      `${content.title}: ${of.name}${unit}, ${now.name}` +
      (number === undefined ? "" : `; element ${content.elements[number]}: ${now.values[field.value][number]}`);
  }

  canvas.addEventListener("pointermove", (event) => {
    const box = canvas.getBoundingClientRect();
    const ratio = window.devicePixelRatio || 1;
    const context = canvas.getContext("2d");
    const found = shown.findLast(([, path]) =>
      context.isPointInPath(path, (event.clientX - box.left) * ratio, (event.clientY - box.top) * ratio));
    say(found === undefined ? undefined : found[0]);
    if (space && event.buttons === 1) {
      turn += 0.01 * event.movementX;
      tilt = Math.min(Math.max(tilt + 0.01 * event.movementY, -1.5), 1.5);
      draw();
    }
  });
  field.addEventListener("change", () => {
    scale = scaleOf(content.fields[field.value].name);
    draw();
  });
  frame.addEventListener("input", draw);
  factor.addEventListener("input", draw);
  let timer = null;
  play.addEventListener("click", () => {
    if (timer !== null) {
      clearInterval(timer);
      timer = null;
      play.textContent = "play";
      return;
    }
    play.textContent = "stop";
    timer = setInterval(() => {
      frame.value = Number(frame.value) >= last ? 0 : Number(frame.value) + 1;
      draw();
    }, 300);
  });
  new ResizeObserver(draw).observe(canvas);
}

const figures = [...document.querySelectorAll("figure.mesh")];
for (const figure of figures) pictures.push(JSON.parse(figure.querySelector("script").textContent));
figures.forEach((figure, k) => showMesh(figure, pictures[k]));
