// Pictures of maps, and the spectra of spots on them.

import { chart } from "./chart.js";
import { $, element } from "./page.js";
import { refuse, scans } from "./shelf.js";

let maps = null;
let urls = [];
// Picture on the canvas, and the square of it that the spot lies in.
let picture = null;
let point = { x: 0, y: 0 };

export function startSpots() {
  const canvas = $("scan-map");
  canvas.addEventListener("click", (event) => {
    const box = canvas.getBoundingClientRect();
    move(((event.clientX - box.left) / box.width) * canvas.width, ((event.clientY - box.top) / box.height) * canvas.height);
    compare();
  });
  canvas.addEventListener("keydown", (event) => {
    const step = event.shiftKey ? 10 : 1;
    const by = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] }[event.key];
    if (by) move(point.x + by[0], point.y + by[1]);
    else if (event.key === "Enter" || event.key === " ") compare();
    else return;
    event.preventDefault();
  });
  $("scan-which").addEventListener("change", show);
  $("scan-size").addEventListener("change", compare);
}

// Shows the pictures of the maps `about`; those of the pigments `named` alone.
export function showMaps({ about, pictures }, named) {
  for (const url of urls) URL.revokeObjectURL(url);
  const files = new Map(pictures.map(({ name, bytes }) => [name, URL.createObjectURL(new Blob([bytes], { type: "image/png" }))]));
  urls = [...files.values()];
  maps = about;
  const seen = about.pictures.filter(({ pigment }) => named.some((one) => one.pigment === pigment));
  const all = seen.flatMap(({ pigment, presence, share }) => [[`Presence of ${pigment}`, presence], [`Share of ${pigment}`, share]]);
  all.push(["Chi-square", "chi2.png"], ["Residual", "residual.png"]);
  $("scan-maps").replaceChildren(...all.map(([title, file]) => {
    const image = element("img", { src: files.get(file), alt: title, width: about.width, height: about.height });
    return element("figure", {}, image, element("figcaption", {}, `${title} `, element("a", { href: files.get(file), download: file, ariaLabel: `Download ${file}` }, "PNG")));
  }));
  $("scan-which").replaceChildren(...all.map(([title, file]) => element("option", { value: files.get(file) }, title)));
  $("scan-spots").classList.toggle("tall", about.height > about.width);
  point = { x: about.width >> 1, y: about.height >> 1 };
  $("scan-spot").textContent = "Point at a spot.";
  $("scan-chart").replaceChildren();
  show();
}

// Puts the chosen map on the canvas.
async function show() {
  const image = new Image();
  image.src = $("scan-which").value;
  await image.decode().catch(() => {});
  if (image.src !== $("scan-which").value) return;
  picture = image;
  [$("scan-map").width, $("scan-map").height] = [maps.width, maps.height];
  draw();
}

// Rows and columns of the scan that the spot holds.
function square() {
  const [side, scale] = [Number($("scan-size").value), maps.step * maps.every];
  const ends = (at, [first, end]) => {
    const from = Math.max(first + at * scale + (scale >> 1) - (side >> 1), first);
    return [Math.min(from, end - 1), Math.min(from + side, end)];
  };
  return [...ends(point.y, maps.rows), ...ends(point.x, maps.columns)];
}

function move(x, y) {
  point = { x: Math.min(Math.max(Math.floor(x), 0), maps.width - 1), y: Math.min(Math.max(Math.floor(y), 0), maps.height - 1) };
  const [top, , left] = square();
  $("scan-spot").textContent = `row ${top}, column ${left}`;
  draw();
}

function draw() {
  const area = $("scan-map").getContext("2d");
  const { width, height } = $("scan-map");
  area.clearRect(0, 0, width, height);
  area.drawImage(picture, 0, 0, width, height);
  const [left, top] = [(point.x + 0.5) / width, (point.y + 0.5) / height];
  $("scan-cross").style.cssText = `left:${100 * left}%;top:${100 * top}%`;
}

// A curve of `values` over `from`, read at the wavelengths `nm`.
export function at(nm, from, values) {
  return nm.map((one) => {
    const next = Math.min(Math.max(from.findIndex((other) => other >= one), 1), from.length - 1);
    const way = (one - from[next - 1]) / (from[next] - from[next - 1]);
    return values[next - 1] + Math.min(Math.max(way, 0), 1) * (values[next] - values[next - 1]);
  });
}

async function compare() {
  try {
    const spot = await scans.call("spot", square());
    $("scan-spot").textContent = spot.words;
    const nm = spot.measured_nm;
    const series = [
      { name: "measured", values: spot.measured, color: "var(--s)" },
      { name: "mapped", values: at(nm, spot.mapped_nm, spot.mapped), color: "var(--k)", dash: "6 4" },
    ];
    const drawn = chart({ title: `Spectra of ${spot.words}`, unit: "reflectance", nm, series });
    $("scan-chart").replaceChildren(drawn);
    $("scan-chart").dataset.spot = JSON.stringify(spot);
  } catch (error) {
    refuse(error);
  }
}
