// Curves over wavelength as SVG, drawn from numbers, with the numbers as a table.

import { element } from "./page.js";

const SVG = "http://www.w3.org/2000/svg";
const [LEFT, RIGHT, TOP, BOTTOM] = [46, 18, 26, 36];

function shape(name, attributes, text) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

// A step of 1, 2 or 5 by which `range` has about `count` parts.
function niceStep(range, count) {
  const raw = range / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  return [1, 2, 5, 10].map((unit) => unit * power).find((step) => step >= raw * 0.999);
}

const short = (value) => String(Number(value.toPrecision(4)));

// A value with its standard deviation, if it has one. `null` is a value that nobody knows.
const withDeviation = (value, sd) => (value === null ? "-" : `${short(value)}${sd === undefined ? "" : ` +- ${short(sd)}`}`);

// The runs of places at which a curve is known.
function runs(values) {
  const found = [];
  values.forEach((value, place) => {
    if (value === null) return;
    if (place === 0 || values[place - 1] === null) found.push([]);
    found.at(-1).push(place);
  });
  return found;
}

// A chart of `series` ({ name, values, color, dash, sd }) over `nm`. A value may be null; a band shows the standard
// deviations `sd`. `most` is the top of the axis, or null. With `logarithmic`, the axis has decades.
export function chart({ title, unit, nm, series, most = null, logarithmic = false }) {
  // Letters keep their size on a phone.
  const [WIDTH, HEIGHT] = innerWidth < 560 ? [366, 250] : [560, 300];
  const svg = shape("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "chart", role: "img", tabindex: "0" });
  const all = series.flatMap((one) => one.values.filter((value) => value !== null));
  const [first, last] = [nm[0], nm[nm.length - 1]];
  const x = (value) => LEFT + ((value - first) / (last - first || 1)) * (WIDTH - LEFT - RIGHT);
  const ticks = [];
  let y;
  if (logarithmic) {
    const positive = all.filter((value) => value > 0);
    const high = Math.ceil(Math.log10(Math.max(...positive, 1e-3)));
    const low = Math.max(Math.floor(Math.log10(Math.min(...positive, 10 ** high / 10))), high - 6);
    const clamped = (value) => Math.max(Math.log10(Math.max(value, 1e-300)), low);
    y = (value) => TOP + ((high - clamped(value)) / (high - low || 1)) * (HEIGHT - TOP - BOTTOM);
    for (let power = low; power <= high; power++) ticks.push(10 ** power);
  } else {
    const top = most ?? Math.max(...all, 1e-6) * 1.05;
    const step = niceStep(top, 5);
    y = (value) => TOP + (1 - Math.min(Math.max(value, 0), top) / top) * (HEIGHT - TOP - BOTTOM);
    for (let value = 0; value <= top * 1.0001; value += step) ticks.push(value);
  }
  for (const value of ticks) {
    svg.append(shape("line", { class: "grid", x1: LEFT, x2: WIDTH - RIGHT, y1: y(value), y2: y(value) }));
    svg.append(shape("text", { x: LEFT - 6, y: y(value) + 4, "text-anchor": "end" }, short(value)));
  }
  const step = last - first > 500 ? 100 : 50;
  for (let value = Math.ceil(first / step) * step; value <= last; value += step) {
    svg.append(shape("line", { class: "axis", x1: x(value), x2: x(value), y1: HEIGHT - BOTTOM, y2: HEIGHT - BOTTOM + 4 }));
    svg.append(shape("text", { x: x(value), y: HEIGHT - BOTTOM + 17, "text-anchor": "middle" }, value));
  }
  svg.append(shape("line", { class: "axis", x1: LEFT, x2: WIDTH - RIGHT, y1: HEIGHT - BOTTOM, y2: HEIGHT - BOTTOM }));
  svg.append(shape("text", { x: WIDTH - RIGHT, y: HEIGHT - 4, "text-anchor": "end" }, "wavelength, nm"));
  svg.append(shape("text", { x: 6, y: 15 }, unit));
  let place = WIDTH - RIGHT;
  for (const { name, color, dash } of [...series].reverse()) {
    place -= name.length * 7.2 + 36;
    svg.append(shape("line", { class: "line", x1: place, x2: place + 20, y1: 11, y2: 11, style: `stroke:${color}`, "stroke-dasharray": dash ?? "" }));
    svg.append(shape("text", { x: place + 25, y: 15 }, name));
  }
  for (const { name, values, color, dash, sd } of series) {
    const point = (place, value) => `${x(nm[place]).toFixed(1)},${y(value).toFixed(1)}`;
    const known = runs(values);
    if (sd) {
      for (const run of known) {
        const edge = (sign) => run.map((place) => point(place, values[place] + sign * sd[place]));
        svg.append(shape("polygon", { class: "band", points: [...edge(1), ...edge(-1).reverse()].join(" "), style: `fill:${color}` }));
      }
    }
    const style = { class: "line", style: `stroke:${color}`, "stroke-dasharray": dash ?? "" };
    const [first, ...others] = known.length ? known : [[]];
    const points = (run) => run.map((place) => point(place, values[place])).join(" ");
    svg.append(shape("polyline", { ...style, points: points(first), "data-name": name, "data-values": values.join(" "), ...(sd ? { "data-sd": sd.join(" ") } : {}) }));
    for (const run of others) svg.append(shape("polyline", { ...style, points: points(run) }));
  }
  const told = element("p", { className: "fine" }, "Point at the chart, or press the arrow keys in it, to read a value.");
  told.setAttribute("role", "status");
  reading(svg, { nm, series, x, told, size: [WIDTH, HEIGHT] });
  const ends = series.map(({ name, values }) => {
    const known = values.filter((value) => value !== null);
    if (!known.length) return `${name}: unknown`;
    const peak = values.indexOf(Math.max(...known));
    return `${name}: ${short(Math.min(...known))} to ${short(values[peak])}, greatest at ${nm[peak]} nm`;
  });
  svg.setAttribute("aria-label", `${title}, ${first} to ${last} nm. ${ends.join(". ")}`);
  return element("div", {}, svg, told, numbers({ title, nm, series }));
}

// A line that the pointer or the arrow keys move along the curves.
function reading(svg, { nm, series, x, told, size: [width, height] }) {
  const cursor = shape("line", { class: "cursor", y1: TOP, y2: height - BOTTOM, x1: -10, x2: -10 });
  svg.append(cursor);
  let at = Math.floor(nm.length / 2);
  const show = (index) => {
    at = Math.min(Math.max(index, 0), nm.length - 1);
    cursor.setAttribute("x1", x(nm[at]));
    cursor.setAttribute("x2", x(nm[at]));
    told.textContent = `${nm[at]} nm: ${series.map((one) => `${one.name} ${withDeviation(one.values[at], one.sd?.[at])}`).join(", ")}`;
  };
  svg.addEventListener("pointermove", (event) => {
    const box = svg.getBoundingClientRect();
    const value = ((event.clientX - box.left) / box.width) * width;
    const distances = nm.map((one) => Math.abs(x(one) - value));
    show(distances.indexOf(Math.min(...distances)));
  });
  svg.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1, Home: -1e6, End: 1e6 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    show(at + step);
  });
}

// The numbers of a chart, folded away. The table is made when it is opened.
function numbers({ title, nm, series }) {
  const details = element("details", { className: "numbers" }, element("summary", {}, "Numbers"));
  details.addEventListener("toggle", () => {
    if (!details.open || details.querySelector("table")) return;
    const heads = ["nm", ...series.map((one) => one.name)];
    const rows = nm.map((value, index) => [value, ...series.map((one) => withDeviation(one.values[index], one.sd?.[index]))]);
    details.append(element("div", { className: "table", tabIndex: 0, role: "region", ariaLabel: title }, table(heads, rows)));
  });
  return details;
}

// A table of numbers; the first column is a heading.
export function table(heads, rows) {
  const head = element("tr", {}, ...heads.map((text) => element("th", { scope: "col", className: "n" }, String(text))));
  const body = rows.map((row) => element("tr", {}, ...row.map((cell) => element("td", { className: "n" }, String(cell)))));
  return element("table", {}, element("thead", {}, head), element("tbody", {}, ...body));
}
