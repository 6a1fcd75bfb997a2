// Spectra at points: which pigments are in each, how much and how sure.

import { chart } from "./chart.js";
import { form } from "./forms.js";
import { $, download, element, namedTable, remarkList, showResult } from "./page.js";
import { spectraSets } from "./reading.js";
import { long, scans, shelf, useShipped, work } from "./shelf.js";
import { at } from "./spots.js";
import { say } from "./tabs.js";

let found = null;

export function startPoints() {
  // A file of residuals is an option of the program.
  const options = form("spots", "IdentifyRequest", [["spots-fields", null]], ["residuals"]);
  const settled = spectraSets($("spots-reading"), "spots-", ["spots"], (told) => { $("spots-start").disabled = !told.has("spots"); });
  $("spots-start").addEventListener("click", async () => {
    await settled();
    if (!$("spots-start").disabled) identify(options);
  });
  $("spots-which").addEventListener("change", show);
  $("spots-json").addEventListener("click", () => {
    const { lines, csv, remarks, group_words: words, ...whole } = found;
    download("identified.json", `${JSON.stringify(whole, null, 2)}\n`, "application/json");
  });
  $("spots-csv").addEventListener("click", () => download("identified.csv", found.csv, "text/csv"));
}

async function identify(options) {
  const done = await work("identifying", async (stage) => {
    const request = JSON.stringify(await options());
    if (!shelf.about) await useShipped();
    const spots = await long.call("spots");
    return scans.call("identify", [shelf.name, new TextEncoder().encode(shelf.json), spots, request], stage);
  });
  if (!done) return;
  found = done;
  const groups = found.group_words.map((names) => element("p", { className: "fine" }, `Counted as one: ${names}`));
  $("spots-notes").replaceChildren(element("p", {}, `With the library ${shelf.about.title || shelf.name}.`), ...groups, ...remarkList(found.remarks));
  const rows = found.spectra.map(({ spectrum, result, sets: [best], chi2 }) => [
    spectrum, best ? parts(best) : result, best ? sure(best.probability) : "-", chi2 === null ? "-" : chi2.toFixed(2),
  ]);
  $("spots-table").replaceChildren(namedTable(["Spectrum", "Most probable pigments", "Sure", "Chi-square"], rows, 2));
  $("spots-which").replaceChildren(...found.spectra.map(({ spectrum }, place) => element("option", { value: place }, spectrum)));
  showResult("spots");
  show();
  say(`${found.spectra.length} spectra are identified`);
}

// A share in percent, with a decimal where it is below 1 %.
function percent(share) {
  const value = 100 * share;
  if (value === 0) return "0";
  if (value < 0.05) return "<0.1";
  return value.toFixed(value < 0.95 ? 1 : 0);
}

const sure = (probability) => `${(100 * probability).toFixed(0)} %`;
const parts = (set) => set.pigments.map(({ pigment, share }) => `${pigment} ${percent(share)} %`).join(", ");

// Pigments and sets with a probability that a reader can use.
const LEAST_SHOWN = 0.05;

function show() {
  const place = Number($("spots-which").value);
  const { spectrum, pigments, sets, measured, mapped } = found.spectra[place];
  $("spots-words").textContent = found.lines[place][0];
  const likely = pigments.filter(({ presence }) => presence >= LEAST_SHOWN);
  const rows = likely.map((one) => [one.pigment, `${percent(one.share)} +- ${percent(one.share_sd)} %`, sure(one.presence)]);
  $("spots-pigments").hidden = !rows.length;
  $("spots-pigments").replaceChildren(namedTable(["Pigment", "Share", "There"], rows));
  $("spots-sets").hidden = !sets.length;
  $("spots-sets").replaceChildren(namedTable(["Set of pigments", "Probability", "Chi-square"], sets.map((set) => [parts(set), sure(set.probability), set.chi2.toFixed(2)])));
  const nm = found.measured_nm;
  const series = [{ name: "measured", values: measured, color: "var(--s)" }];
  if (mapped.length) series.push({ name: "best set", values: at(nm, found.mapped_nm, mapped), color: "var(--k)", dash: "6 4" });
  $("spots-chart").replaceChildren(chart({ title: `Spectrum ${spectrum}`, unit: "reflectance", nm, series }));
}
