// Readings to a library: files, options, the fit and its errors.

import { chart } from "./chart.js";
import { references } from "./counts.js";
import { $, clearNotice, download, element, fits, names, number, remarkList, takesDrops, takesFiles } from "./page.js";
import { listFormats, onReading, readingOptions } from "./reading.js";
import { long, onChange, quick, refuse, shelf, useFitted, useReadings, viewing, work } from "./shelf.js";
import { say, select } from "./tabs.js";

let files = [];
// Ends when the files are read, with the options as they are.
let reading = Promise.resolve();

export function startFit() {
  takesDrops($("readings-drop"), take);
  takesFiles($("readings-files"), take);
  $("readings-sample").addEventListener("click", sample);
  $("fit-start").addEventListener("click", fit);
  $("curves-pigment").addEventListener("change", showCurves);
  const again = () => { if (files.length) read(); };
  onReading(again);
  for (const id of ["o-pigments", "o-recipes"]) $(id).addEventListener("change", again);
  $("fit-options").addEventListener("toggle", () => listFormats());
  onChange(showCurves);
}

async function sample() {
  try {
    const answer = await fetch("van-gogh-oils.csv");
    if (!answer.ok) throw new Error(`van-gogh-oils.csv: ${answer.status}`);
    await take([new File([await answer.blob()], "van-gogh-oils.csv")]);
  } catch (error) {
    refuse(error);
  }
}

// Takes files of readings, and reads them.
export async function take(chosen) {
  clearNotice();
  if (!fits(chosen)) return;
  files = chosen;
  $("fit-result").hidden = true;
  await read();
}

function read() {
  reading = reading.then(readFiles);
  return reading;
}

async function readFiles() {
  // "Fit" stays as it is meanwhile: it may be the press on it that ends the change of a field, and waits.
  const told = await readFilesTold();
  $("fit-start").disabled = !told;
}

async function readFilesTold() {
  $("readings-told").replaceChildren();
  useReadings(null);
  const recipes = $("o-recipes").files[0] ?? null;
  if (recipes && !fits([recipes])) return null;
  const told = await work("reading", () => {
    const { given, named } = references();
    const pigments = names($("o-pigments").value);
    const options = JSON.stringify({ ...readingOptions(), pigments: pigments.length ? pigments : null, references: named });
    return long.make("readings", "read", [files, recipes, given, options]);
  });
  if (!told) return null;
  useReadings(told);
  const count = `${told.samples.length} samples, ${told.readings} readings, ${told.pigments.length} pigments`;
  $("readings-told").replaceChildren(element("p", {}, count), ...remarkList(told.remarks));
  return told;
}

function surface() {
  const text = $("o-surface").value.trim();
  if (text === "") return null;
  if (text === "none") return text;
  const parts = text.split(/[;,\s]+/).map(Number);
  if (parts.length === 2 && parts.every(Number.isFinite)) return parts;
  throw { message: `Surface is k1,k2, found \`${text}\``, hint: "try 0.03,0.6, or none" };
}

// The keys of `FitRequest` (docs/schema/requests.json); the library chooses where a value is null.
function fitRequest() {
  const text = (id) => $(id).value.trim();
  return {
    amounts: text("o-amounts"), method: text("o-method"), reference: text("o-reference") || null,
    surface: surface(), specular: text("o-specular") || null,
    below_surface: text("o-below") || null,
    smoothness: number($("o-smoothness"), "Smoothness"),
    unevenness: number($("o-unevenness"), "Unevenness"),
    exclude: names(text("o-exclude")), viewing: viewing(),
    provenance: { title: text("o-title") || null, licence: text("o-licence") || null, source: text("o-source") || null },
  };
}

async function fit() {
  // A field that is left by pressing the button may have changed how the files are read.
  await reading;
  if (!shelf.readings) return;
  const done = await work("fitting", async (stage) => {
    const options = JSON.stringify(fitRequest());
    const begun = performance.now();
    const found = await long.call("fit", [options, $("o-surface-of").files[0] ?? null, JSON.stringify(viewing())], stage);
    const seconds = (performance.now() - begun) / 1000;
    const stem = files[0].name.replace(/\.[^.]*$/, "") || "library";
    await useFitted(`${stem}.pigments.json`, found);
    return { errors: found.errors, seconds };
  });
  if (done) showFit(done.errors, done.seconds);
}

function showFit(errors, seconds) {
  const { mean, median, p90, max } = errors.delta_e;
  const facts = {
    Samples: errors.samples, Pigments: errors.pigments,
    "Error, CIEDE2000": `mean ${mean.toFixed(2)}, median ${median.toFixed(2)}, 90 % below ${p90.toFixed(2)}, largest ${max.toFixed(2)}`,
    "Error of reflectance": `${(100 * errors.rms).toFixed(2)} % root mean square`,
    Time: `${seconds.toFixed(2)} s`,
  };
  const entries = Object.entries(facts).flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, String(value))]);
  $("fit-facts").replaceChildren(...entries);
  $("fit-facts").dataset.seconds = seconds;
  const warnings = errors.warnings.map((text) => ({ warning: true, text, hint: null }));
  const actions = element("div", { className: "row" });
  const action = (text, does) => {
    const button = element("button", { type: "button" }, text);
    button.addEventListener("click", does);
    actions.append(button);
  };
  action("Download library", saveLibrary);
  action("Mix with it", () => select("mix"));
  action("Find recipes", () => select("recipes"));
  action("Report", () => select("report"));
  $("fit-told").replaceChildren(actions, ...remarkList([...errors.remarks, ...warnings]));
  showErrors(errors.per_sample);
  $("fit-result").hidden = false;
  $("fit-heading").focus();
  say(`The fit is done: ${errors.pigments} pigments, CIEDE2000 ${mean.toFixed(2)} on average`);
}

export function saveLibrary() {
  download(shelf.name, shelf.json, "application/json");
}

function showErrors(samples) {
  const sorted = [...samples].sort((a, b) => b.delta_e - a.delta_e);
  const most = Math.max(sorted[0]?.delta_e ?? 1, 1e-9);
  const rows = sorted.map(({ sample: name, delta_e: error }) => {
    const bar = element("span", { className: "bar", style: `width:${(100 * error) / most}px` });
    return element("tr", {}, element("td", {}, name), element("td", { className: "n" }, error.toFixed(2)), element("td", {}, bar));
  });
  const head = element("tr", {}, element("th", { scope: "col" }, "Sample"), element("th", { scope: "col", className: "n" }, "CIEDE2000"), element("th", {}));
  $("fit-errors").replaceChildren(element("thead", {}, head), element("tbody", {}, ...rows));
}

async function showCurves() {
  const pigments = shelf.about.pigments.map((pigment) => pigment.name);
  const list = $("curves-pigment");
  if (pigments.join() !== [...list.options].map((option) => option.value).join()) {
    list.replaceChildren(...pigments.map((name) => element("option", { value: name }, name)));
  }
  const place = Math.max(list.selectedIndex, 0);
  try {
    const { wavelengths_nm: nm, k, s } = await quick.call("curves", [place]);
    const series = [{ name: "K", values: k, color: "var(--k)" }, { name: "S", values: s, color: "var(--s)", dash: "7 4" }];
    $("curves-chart").replaceChildren(chart({ title: `K and S of ${pigments[place]}`, unit: "K and S, relative to the white's S", nm, series, logarithmic: true }));
  } catch (error) {
    refuse(error);
  }
}
