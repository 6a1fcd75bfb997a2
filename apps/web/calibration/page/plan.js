// Plans of swatches, with the form to fill in and the names of the readings.

import { form } from "./forms.js";
import { $, download, element, namedTable, names, remarkList, showResult, wholeNumber } from "./page.js";
import { long, onChange, shelf, work } from "./shelf.js";
import { say } from "./tabs.js";

let found = null;

export function startPlan() {
  const boxes = [["plan-fields", ["minutes", "swatches", "black"]], ["plan-options", null]];
  const options = form("plan", "PlanRequest", boxes);
  $("plan-start").addEventListener("click", () => plan(options));
  $("plan-form").addEventListener("click", () => download("plan.csv", found.form, "text/csv"));
  $("plan-recipes").addEventListener("click", () => download("plan-recipes.csv", found.recipes, "text/csv"));
  onChange(() => { $("plan-library").disabled = false; });
}

function grid() {
  const parts = $("plan-grid").value.split(",").map((part) => (part.trim() ? Number(part) : NaN));
  if (parts.length === 3 && parts.every(Number.isFinite)) return parts;
  throw { message: `Wavelengths of the form are first, last and step in nm, found \`${$("plan-grid").value}\``, hint: "try 400,700,10" };
}

async function plan(options) {
  const done = await work("choosing swatches", async (stage) => {
    const pigments = names($("plan-pigments").value);
    const white = $("plan-white").value.trim();
    if (!pigments.length) throw { message: "no pigment is named", hint: "name those to plan for in \"Pigments\"" };
    if (!white) throw { message: "a plan needs a white", hint: "name it in \"White of the plan\"" };
    const replicates = wholeNumber($("plan-replicates"), "Readings of each", 1) ?? 2;
    const wanted = { pigments, white, request: await options(), grid: grid(), replicates };
    return long.call("plan", [JSON.stringify(wanted), shelf.about !== null && $("plan-library").checked], stage);
  });
  if (!done) return;
  found = done;
  show();
  say(`${found.swatches.length} swatches are planned`);
}

const grams = (amounts, between) => Object.entries(amounts).map(([name, mass]) => `${mass} g ${name}`).join(between);

function show() {
  const { swatches, totals_g: totals, unknowns, prior, remarks } = found;
  const count = `${swatches.length} ${swatches.length === 1 ? "swatch" : "swatches"} for ${unknowns} unknowns per wavelength; every pigment is identified.`;
  $("plan-words").textContent = `${count} Paint for all of them: ${grams(totals, ", ")}.`;
  $("plan-notes").replaceChildren(...remarkList(remarks));
  const rows = swatches.map((swatch) => [swatch.sample, grams(swatch.grams, " + "), swatch.why]);
  $("plan-table").replaceChildren(namedTable(["Swatch", "Recipe", "Why"], rows, 3));
  $("plan-forecast").replaceChildren(...(prior ? forecast(prior) : []));
  showResult("plan");
}

// Deviations that the library predicts.
function forecast({ usual_efficiency: usual, noise, relative_deviations: own, usual_relative_deviations: others }) {
  const percent = (value) => {
    if (value === null) return "unit";
    return 100 * value > 999 ? ">999" : (100 * value).toFixed(1);
  };
  const pair = ({ absorption, scattering }) => [percent(absorption), percent(scattering)];
  const rows = Object.keys(own).map((name) => [name, ...pair(own[name]), ...pair(others[name])]);
  const said = `The usual plan with as many swatches has ${(100 * usual).toFixed(0)} % of the information of this one (D-efficiency). Predicted standard deviations in percent of K and S, median over wavelength, with noise ${noise.constant}, ${noise.even.toFixed(3)}:`;
  const table = namedTable(["Paint", "K", "S", "usual K", "usual S"], rows);
  return [element("p", {}, said), element("div", { className: "table", tabIndex: 0, role: "region", ariaLabel: "Predicted deviations" }, table)];
}
