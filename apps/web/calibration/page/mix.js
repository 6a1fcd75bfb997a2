// Mixtures of the library: sliders, colour, spectrum.

import { chart } from "./chart.js";
import { $, element, inkOn, remarkList } from "./page.js";
import { onChange, quick, refuse, shelf, viewing } from "./shelf.js";

// Parts by the name of the pigment.
let parts = new Map();
let known = "";
let busy = false;
let again = false;

export function startMix() {
  $("mix-clear").addEventListener("click", () => setParts([]));
  $("mix-film").addEventListener("change", mix);
  $("mix-thickness").addEventListener("input", mix);
  onChange(libraryChanged);
}

function libraryChanged() {
  const { pigments, amounts, reference } = shelf.about;
  const names = pigments.map((pigment) => pigment.name);
  $("mix-film").options[0].disabled = amounts === "absolute";
  if (amounts === "absolute") $("mix-film").value = "film";
  if (names.join() !== known) {
    known = names.join();
    const white = reference ?? names[0];
    const other = pigments.find((pigment) => pigment.name !== white && pigment.identified)?.name;
    parts = new Map([[white, 9], ...(other ? [[other, 1]] : [])]);
  }
  drawSliders();
  mix();
}

// Puts these parts on the sliders: pairs of name and parts.
export function setParts(pairs) {
  parts = new Map(pairs);
  drawSliders();
  mix();
}

// The parts that are not 0.
export const mixed = () => [...parts].filter(([, part]) => part > 0);

function drawSliders() {
  const rows = shelf.about.pigments.map(({ name, hex, identified, guessed, colour_index: index }, place) => {
    const id = `part-${place}`;
    const part = parts.get(name) ?? 0;
    const slider = element("input", { type: "range", min: 0, max: 10, step: 0.1, value: Math.min(part, 10), ariaLabel: `${name}, slider` });
    const field = element("input", { type: "number", id, min: 0, max: 1e6, step: "any", value: part });
    const take = (from, to) => () => {
      const value = Number(from.value);
      if (!(value >= 0)) return;
      parts.set(name, value);
      to.value = Math.min(value, Number(to.max));
      mix();
    };
    slider.addEventListener("input", take(slider, field));
    field.addEventListener("input", take(field, slider));
    const notes = [index, guessed ? "guessed" : "", identified ? "" : "S unknown"].filter(Boolean).join(", ");
    const label = element("label", { htmlFor: id }, element("span", {}, name, notes ? " " : "", element("small", {}, notes)));
    const dot = element("span", { className: "dot", style: `background:${hex ?? "transparent"}`, ariaHidden: "true" });
    return element("div", { className: "slider" }, dot, label, slider, field);
  });
  $("mix-pigments").replaceChildren(...rows);
}

function thickness() {
  const film = $("mix-film").value === "film";
  $("mix-thickness-label").hidden = !film;
  const value = Number((10 ** Number($("mix-thickness").value)).toPrecision(3));
  $("mix-thickness-told").textContent = value;
  return film ? value : null;
}

// Mixes, unless that is already done; then once more afterwards, so that the last change is shown.
async function mix() {
  if (!shelf.about) return;
  if (busy) {
    again = true;
    return;
  }
  busy = true;
  try {
    await mixOnce();
  } catch (error) {
    refuse(error);
  } finally {
    busy = false;
  }
  if (again) {
    again = false;
    mix();
  }
}

async function mixOnce() {
  const recipe = mixed();
  const thick = thickness();
  if (!recipe.length) {
    $("mix-told").textContent = "Move a slider to begin.";
    $("mix-patch").hidden = true;
    $("mix-chart").replaceChildren();
    $("mix-notes").replaceChildren();
    return;
  }
  const grounds = thick === null ? [1] : [1, 0];
  const mixtures = grounds.map((over) => ({ parts: recipe, thickness: thick, over, viewing: viewing() }));
  const colors = await quick.call("mix", [mixtures]);
  show(colors, thick, recipe);
}

function show(colors, thick, recipe) {
  const [white, black] = colors;
  $("mix-patch").hidden = false;
  for (const [place, span] of [...$("mix-patch").children].entries()) {
    const color = colors[place];
    span.hidden = !color;
    if (!color) continue;
    span.style.background = color.hex;
    span.style.color = inkOn(color.hex);
    span.textContent = black ? `over ${place ? "black" : "white"} ${color.hex}` : color.hex;
  }
  const lab = (color) => `L* ${color.lab[0].toFixed(1)}, a* ${color.lab[1].toFixed(1)}, b* ${color.lab[2].toFixed(1)}`;
  const gamut = (color) => (color.in_gamut ? "" : " (outside sRGB: the screen shows the nearest)");
  const told = colors.map((color, place) => `${black ? (place ? "Over black: " : "Over white: ") : ""}${color.hex}, ${lab(color)}${gamut(color)}`);
  $("mix-told").textContent = told.join(". ");
  $("mix-patch").setAttribute("aria-label", `Colour of the mixture. ${told.join(". ")}`);
  $("mix-notes").replaceChildren(...remarkList(white.remarks));
  const series = [{ name: black ? "over white" : "reflectance", values: white.reflectance, color: "var(--s)" }];
  if (black) series.push({ name: "over black", values: black.reflectance, color: "var(--k)", dash: "7 4" });
  const title = `Reflectance of ${recipe.map(([name, part]) => `${part} ${name}`).join(", ")}`;
  $("mix-chart").replaceChildren(chart({ title, unit: "reflectance", nm: white.wavelengths_nm, series, most: 1 }));
}
