// Recipes for a colour: typed, of a file, or of a photograph.

import { chart } from "./chart.js";
import { setParts } from "./mix.js";
import { $, clearNotice, element, fits, inkOn, names, number, remarkList, takesDrops, takesFiles, wholeNumber } from "./page.js";
import { openPhotograph } from "./photograph.js";
import { long, refuse, viewing, work } from "./shelf.js";
import { say, select } from "./tabs.js";

// The colours of the chosen file; `null` while the typed colour counts.
let listed = null;

export function startRecipes() {
  $("target-form").addEventListener("submit", (event) => {
    event.preventDefault();
    find();
  });
  $("target-text").addEventListener("input", () => typed($("target-text").value));
  $("target-color").addEventListener("input", () => typed($("target-color").value));
  takesDrops($("target-drop"), ([file]) => open(file));
  takesFiles($("target-file"), ([file]) => open(file));
}

// Takes the colour `code` as the target.
function typed(code) {
  $("target-text").value = code;
  if (/^#[0-9a-f]{6}$/i.test(code)) $("target-color").value = code;
  listed = null;
  for (const radio of document.querySelectorAll("#targets input")) radio.checked = false;
}

async function open(file) {
  clearNotice();
  if (!fits([file])) return;
  if (file.type.startsWith("image/")) {
    try {
      await openPhotograph(file, typed);
      $("targets").hidden = true;
    } catch (error) {
      refuse(error);
    }
    return;
  }
  const told = await work("reading", () => long.make("targets", "of_file", [file]));
  if (!told) return;
  $("photograph").hidden = true;
  $("targets").hidden = false;
  $("targets").replaceChildren(...told.targets.map(({ name, hex }, place) => {
    const radio = element("input", { type: "radio", name: "target", value: String(place) });
    radio.addEventListener("change", () => { listed = { file, place }; });
    const dot = element("span", { className: "dot", style: `background:${hex}` });
    return element("label", {}, radio, dot, name);
  }));
  $("targets").querySelector("input").checked = true;
  listed = { file, place: 0 };
  $("recipes-told").replaceChildren(...remarkList(told.remarks));
  say(`${told.targets.length} colours of ${file.name}`);
}

// The keys of `MatchRequest` (docs/schema/requests.json); the library chooses where a value is null.
function options() {
  const whole = (id, label, least) => wholeNumber($(id), label, least);
  const over = $("r-over").value;
  return {
    conditions: [{ viewing: viewing() }], thickness: number($("r-thickness"), "Thickness"), over: over === "" ? null : Number(over),
    only: names($("r-only").value), with: names($("r-with").value), without: names($("r-without").value),
    at_most: whole("r-most", "Pigments at most", 1), least_share: number($("r-least"), "Least share"),
    whole_parts: whole("r-parts", "Whole parts", 1), tolerance: number($("r-tolerance"), "Tolerance"),
    beyond_measured: $("r-beyond").checked, count: whole("r-count", "Recipes to show", 1),
  };
}

async function find() {
  const found = await work("finding recipes", async () => {
    const settings = JSON.stringify(options());
    if (!listed) {
      await long.make("targets", "typed", [$("target-text").value]);
      return long.call("recipes", [0, settings]);
    }
    await long.make("targets", "of_file", [listed.file]);
    return long.call("recipes", [listed.place, settings]);
  });
  if (found) show(found);
}

function show(found) {
  const unit = found.unit ?? "CIEDE2000";
  const reached = found.reached
    ? `${found.target}: recipes within ${found.tolerance.toFixed(2)} ${unit} are equally near; fewest pigments first.`
    : found.reached_below_least
      ? `${found.target}: reached only with shares below the least one, as in the last recipe; with it the nearest is ${found.nearest.toFixed(2)} ${unit} away.`
      : `${found.target}: out of reach of these paints; the nearest recipe is ${found.nearest.toFixed(2)} ${unit} away`
        + (found.below_least.length ? `, and with smaller shares, as in the last recipe, ${found.below_least[0].distance.toFixed(2)}.` : ".");
  $("recipes-told").replaceChildren(element("p", {}, reached), ...remarkList(found.remarks));
  $("recipes-list").replaceChildren(...[...found.recipes, ...found.below_least].map((recipe, place) => card(found, recipe, place, unit)));
  const colors = ["var(--s)", "var(--k)", "var(--third)"];
  const series = found.recipes.slice(0, 3).map((recipe, place) => ({
    name: `recipe ${place + 1}`, values: recipe.reflectance, color: colors[place], dash: ["", "7 4", "2 4"][place],
  }));
  const nm = found.recipes[0]?.wavelengths_nm;
  $("recipes-chart").replaceChildren(...(nm ? [chart({ title: `Reflectance of recipes for ${found.target}`, unit: "reflectance", nm, series, most: 1 })] : []));
  say(`${found.recipes.length} recipes, the nearest ${found.nearest.toFixed(2)} ${unit} away`);
}

function card(found, recipe, place, unit) {
  const half = (hex, text) => element("span", { style: `background:${hex};color:${inkOn(hex)}` }, text);
  const lines = recipe.pigments.map(({ name, share, parts }) => {
    const amount = parts === undefined ? `${(100 * share).toFixed(share < 0.01 ? 2 : 1)} %` : `${parts} parts`;
    return element("li", {}, element("span", {}, name), element("span", {}, amount));
  });
  const use = element("button", { type: "button" }, "Mix this");
  use.addEventListener("click", () => {
    setParts(recipe.pigments.map(({ name, share, parts }) => [name, parts ?? Number((10 * share).toFixed(3))]));
    if (recipe.thickness) $("mix-film").value = "film";
    select("mix");
  });
  const thick = recipe.thickness ? `, thickness ${recipe.thickness.toPrecision(3)}` : "";
  return element("li", {},
    element("div", { className: "pair", ariaHidden: "true" }, half(found.hex, "wanted"), half(recipe.hex, "recipe")),
    element("div", { className: "body" },
      element("p", {}, element("strong", {}, `Recipe ${place + 1}`), `: ${recipe.distance.toFixed(2)} ${unit}${thick}`),
      element("ul", {}, ...lines), use));
}
