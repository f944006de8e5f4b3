// SPDX-License-Identifier: GPL-2.0-or-later
// Draws the charts of a page from the JSON beside each canvas (app/page/page.hpp) with Chart.js.
"use strict";

const palette = ["#3a7ca5", "#d1603d", "#4f9d69", "#8e5ea2", "#b8902e", "#5b6770", "#c2477f", "#2a9d8f"];

function colourOf(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

function short(value) {
  const rounded = Number(value.toPrecision(4));
  const size = Math.abs(rounded);
  return size > 0 && (size < 1e-4 || size >= 1e6) ? rounded.toExponential().replace("e+", "e") : String(rounded);
}

// Curves that begin at zero, or beside it, begin at the axis: no room behind zero.
function beginsAtZero(values) {
  const least = values.reduce((one, other) => Math.min(one, other), Infinity);
  const most = values.reduce((one, other) => Math.max(one, other), -Infinity);
  const near = 0.1 * (most - least);
  return (least >= 0 && least <= near) || (most <= 0 && most >= -near);
}

// Ends of a logarithmic axis: the nearest of 1, 1.1, ... 2, 3, ... 9 times a power of ten that leave all values inside.
function logarithmicEnds(values) {
  const positive = values.filter((value) => value > 0);
  if (positive.length === 0) return {};
  const rounded = (value, round) => {
    const power = 10 ** Math.floor(Math.log10(value));
    const fine = value < 2 * power ? 10 : 1; // tenths from 1 to 2
    return (round((fine * value) / power) * power) / fine;
  };
  const least = positive.reduce((one, other) => Math.min(one, other), Infinity);
  const most = positive.reduce((one, other) => Math.max(one, other), 0);
  return {
    suggestedMin: rounded(0.95 * least, Math.floor),
    suggestedMax: rounded(1.05 * most, Math.ceil),
    bounds: "data",
    afterBuildTicks(scale) { // Chart.js begins with those of the whole decade
      scale.ticks = scale.ticks.filter(({ value }) => value >= 0.999 * scale.min && value <= 1.001 * scale.max);
    },
  };
}

function axisOf(axis, values) {
  const shown = (value) => (axis.percent ? short(100 * value) + " %" : short(value));
  return {
    type: axis.logarithmic ? "logarithmic" : "linear",
    grace: axis.logarithmic ? 0 : "3%",
    beginAtZero: !axis.logarithmic && beginsAtZero(values),
    ...(axis.logarithmic ? logarithmicEnds(values) : {}),
    title: { display: true, text: axis.unit ? `${axis.title}, ${axis.unit}` : axis.title, color: colourOf("--text") },
    grid: { color: colourOf("--faint") },
    ticks: {
      color: colourOf("--text"),
      // Counts have no halves.
      ...(values.every(Number.isInteger) ? { precision: 0 } : {}),
      callback(value) {
        // A logarithmic axis of more than a decade marks 1, 2 and 5 of each.
        if (axis.logarithmic && this.max > 10 * this.min && ![1, 2, 5].includes(Math.round(value / 10 ** Math.floor(Math.log10(value) + 1e-9))))
          return null;
        return shown(value);
      },
    },
    shown,
  };
}

// Chart.js forgets the dashes of lines whose points have a style.
function withDashes(chart) {
  return Chart.defaults.plugins.legend.labels.generateLabels(chart).map((item) =>
    ({ ...item, lineDash: chart.data.datasets[item.datasetIndex].borderDash }));
}

// Behind the last colour they begin anew, with another dash each time: 24 lines can be told apart.
const dashes = [[], [8, 3], [2, 3]];

function datasetOf(series, number) {
  const colour = series.colour === "text" ? colourOf("--text") : series.colour || palette[number % palette.length];
  const dash = series.colour ? [] : dashes[Math.floor(number / palette.length) % dashes.length];
  return {
    label: series.name,
    data: series.points.map(([x, y]) => ({ x, y })),
    showLine: series.line,
    borderColor: series.line ? colour : colourOf("--text"),
    backgroundColor: colour,
    borderWidth: series.line ? 2 : 1,
    borderDash: series.dashed ? [6, 4] : dash,
    pointStyle: series.line ? "line" : series.square ? "rect" : "circle",
    pointRadius: series.line ? 0 : series.size,
    pointHitRadius: 6,
    named: series.named,
  };
}

// Names beside points, each where it covers no other name and no point: right or left, below and above in turns, ever farther.
const names = {
  id: "names",
  afterDatasetsDraw(chart) {
    const context = chart.ctx;
    const taken = [];
    chart.data.datasets.forEach((dataset, number) => {
      if (dataset.showLine || !chart.isDatasetVisible(number)) return;
      const size = dataset.pointRadius;
      for (const { x, y } of chart.getDatasetMeta(number).data)
        taken.push({ left: x - size, right: x + size, top: y - size, bottom: y + size });
    });
    context.save();
    context.font = "12px sans-serif";
    context.fillStyle = colourOf("--text");
    chart.data.datasets.forEach((dataset, number) => {
      const point = chart.getDatasetMeta(number).data[0];
      if (!dataset.named || !point || !chart.isDatasetVisible(number)) return;
      const area = chart.chartArea;
      if (point.x < area.left - 1 || point.x > area.right + 1 || point.y < area.top - 1 || point.y > area.bottom + 1)
        return;
      const width = context.measureText(dataset.label).width;
      const gap = (dataset.pointRadius || 0) + 4;
      const sides = [point.x + gap, point.x - gap - width].filter((left) => left > area.left && left + width < chart.width);
      let place = null;
      // Not on its own line.
      for (let k = dataset.showLine ? 1 : 0; k < 12 && !place; ++k) {
        const y = point.y + 13 * (k % 2 === 0 ? k / 2 : -(k + 1) / 2);
        const boxes = sides.map((left) => ({ left, right: left + width, top: y - 6, bottom: y + 6 }));
        place = boxes.find((box) => !taken.some((other) => box.left < other.right && box.right > other.left &&
          box.top < other.bottom && box.bottom > other.top));
      }
      if (!place) return; // the mouse shows it
      taken.push(place);
      context.fillText(dataset.label, place.left, place.top + 10);
    });
    context.restore();
  },
};

// A rectangle drawn with the mouse is enlarged; a double click shows all again.
function makeZoomable(chart) {
  const canvas = chart.canvas;
  const frame = document.createElement("div");
  frame.style.cssText = "position:absolute;border:1px dashed currentColor;pointer-events:none;display:none";
  canvas.parentNode.appendChild(frame);
  let start = null;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.pointerType !== "touch") start = place(event); // fingers scroll
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!start) return;
    const now = place(event);
    frame.style.display = "block";
    frame.style.left = Math.min(start.x, now.x) + "px";
    frame.style.top = Math.min(start.y, now.y) + "px";
    frame.style.width = Math.abs(now.x - start.x) + "px";
    frame.style.height = Math.abs(now.y - start.y) + "px";
  });
  window.addEventListener("pointerup", (event) => {
    if (!start) return;
    const now = place(event);
    for (const key of ["x", "y"]) {
      if (Math.abs(now.x - start.x) < 8 || Math.abs(now.y - start.y) < 8) break;
      const scale = chart.scales[key];
      const ends = [scale.getValueForPixel(start[key]), scale.getValueForPixel(now[key])];
      chart.options.scales[key].min = Math.min(...ends);
      chart.options.scales[key].max = Math.max(...ends);
    }
    start = null;
    frame.style.display = "none";
    chart.update("none");
  });
  canvas.addEventListener("dblclick", () => {
    for (const key of ["x", "y"]) {
      delete chart.options.scales[key].min;
      delete chart.options.scales[key].max;
    }
    chart.update("none");
  });
}

// Titles for the rows that a narrow page shows as lists (page.css).
for (const table of document.querySelectorAll("table.text")) {
  const titles = [...table.querySelectorAll("th")].map((cell) => cell.textContent);
  for (const row of table.rows)
    [...row.cells].forEach((cell, k) => {
      if (cell.tagName === "TD" && titles[k] && row.cells.length === titles.length) cell.dataset.title = titles[k];
    });
}

for (const figure of document.querySelectorAll("figure.chart")) {
  const content = JSON.parse(figure.querySelector("script").textContent);
  // A long legend gets room of its own; the curves keep theirs.
  if (content.legend && content.series.length > 6)
    figure.style.height = `calc(${getComputedStyle(figure).height} + ${Math.ceil(content.series.length / 2) * 1.2}em)`;
  // Long enough in the legend to show their dashes; marks would be drawn out.
  const sampleWidth = content.series.every((series) => series.line) ? 34 : undefined;
  const along = (k) => content.series.flatMap((series) => series.points.map((point) => point[k]));
  const scales = { x: axisOf(content.x, along(0)), y: axisOf(content.y, along(1)) };
  const chart = new Chart(figure.querySelector("canvas"), {
    type: "scatter",
    data: { datasets: content.series.map(datasetOf) },
    plugins: [names],
    options: {
      animation: false,
      maintainAspectRatio: false,
      scales,
      plugins: {
        legend: { display: content.legend, position: "bottom", labels: { color: colourOf("--text"), usePointStyle: true, pointStyleWidth: sampleWidth, boxHeight: 7, generateLabels: withDashes } },
        tooltip: {
          callbacks: {
            label: (item) =>
              `${item.dataset.label}: ${scales.x.shown(item.parsed.x)}, ${scales.y.shown(item.parsed.y)}`,
          },
        },
      },
    },
  });
  makeZoomable(chart);
}
