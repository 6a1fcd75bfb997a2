// Maps of scans: files, options, and what the maps tell.

import { $, clearNotice, download, element, fits, namedTable, names, number, remarkList, takesDrops, takesFiles, wholeNumber } from "./page.js";
import { refuse, scans, shelf, useShipped, work } from "./shelf.js";
import { showMaps, startSpots } from "./spots.js";
import { say } from "./tabs.js";

// Bytes of a scan and its readings at most. They are read slice by slice.
const MOST_BYTES = 1024 * 1024 * 1024;
const READING = ["s-values", "s-white", "s-white-files", "s-dark-files", "s-tile", "s-full", "s-subtracted"];
// Pixels from which a hint tells of fewer.
const MANY = 200_000;
// Part of the searched pixels below which a pigment is not named.
const NAMED = 0.001;

let files = [];
let told = null;
let mapped = null;

export const isScan = (dropped) => dropped.some((file) => /\.hdr$/i.test(file.name));

export function startScan() {
  takesDrops($("scan-drop"), takeScan);
  takesFiles($("scan-files"), takeScan);
  $("scan-start").addEventListener("click", map);
  // The module is loaded while the user looks for files.
  $("tab-scan").addEventListener("click", () => scans.call("begin").catch(refuse), { once: true });
  for (const id of READING) $(id).addEventListener("change", () => files.length && open());
  $("scan-json").addEventListener("click", () => download(`${stem()}-maps.json`, `${JSON.stringify(mapped.json, null, 2)}\n`, "application/json"));
  $("scan-csv").addEventListener("click", () => download(`${stem()}-maps.csv`, csv(), "text/csv"));
  startSpots();
}

const stem = () => told.name.replace(/\.hdr$/i, "");

// Takes the files of a scan: its header and its data.
export async function takeScan(chosen) {
  clearNotice();
  files = [];
  forget();
  const twice = chosen.map((file) => file.name).find((name, place, all) => all.indexOf(name) !== place);
  if (twice) return refuse({ message: `two files are named ${twice}`, hint: "choose the header and the data of one scan" });
  files = chosen;
  await open();
}

function forget() {
  told = mapped = null;
  $("scan-start").disabled = true;
  $("scan-result").hidden = true;
  $("scan-told").replaceChildren();
}

const header = (chosen) => (chosen.find((file) => /\.hdr$/i.test(file.name)) ?? chosen[0])?.name ?? null;

// The options of reading, and all files with those of white and dark.
function reading() {
  const [white, dark] = ["s-white-files", "s-dark-files"].map((id) => [...$(id).files]);
  const subtracted = $("s-subtracted").checked;
  const options = {
    scale: number($("s-white"), "A white reads") ?? $("s-values").value,
    full_scale: number($("s-full"), "Largest count of the detector"),
    white_reading: header(white),
    dark_reading: header(dark) ?? (subtracted ? "0" : null),
    tile: number($("s-tile"), "Reflectance of the white"),
  };
  if (subtracted && dark.length) {
    throw { message: "the dark is subtracted already, or there is a dark reading: found both", hint: "take one of the two away" };
  }
  return [[...files, ...white, ...dark], options];
}

async function open() {
  forget();
  const found = await work("opening the scan", async () => {
    const [all, options] = reading();
    if (!fits(all, MOST_BYTES, "use the program impasto or its Python package, which read scans of any size in pieces")) return undefined;
    return scans.make("scan", "open", [all, JSON.stringify(options)]);
  });
  if (!found) return;
  told = found;
  const { name, lines, samples, wavelengths_nm: nm, remarks } = told;
  const line = `${name}: ${lines} x ${samples} pixels, ${nm.length} ${nm.length === 1 ? "band" : "bands"} from ${nm[0]} to ${nm.at(-1)} nm`;
  const notes = [...remarks];
  if (lines * samples > MANY) notes.push({ warning: false, text: `${(lines * samples).toLocaleString("en")} pixels take minutes`, hint: "map some rows and columns, or every n-th pixel, in \"Pixels and pigments\"" });
  $("scan-told").replaceChildren(element("p", {}, line), ...remarkList(notes));
  $("scan-start").disabled = false;
}

function region() {
  const text = $("s-region").value.trim();
  if (!text) return null;
  const sides = /^(\d+)\s*\.\.\s*(\d+)\s*,\s*(\d+)\s*\.\.\s*(\d+)$/.exec(text);
  if (sides) return text;
  throw { message: `Rows and columns takes both, found \`${text}\``, hint: "write them from 0 and without the last, such as 0..512,100..300" };
}

async function map() {
  const done = await work("mapping the scan", async (stage) => {
    const request = { at_most: Number($("s-most").value), palette: names($("s-only").value), apart: $("s-apart").checked, region: region() };
    const every = wholeNumber($("s-every"), "Map every n-th pixel", 1) ?? 1;
    if (!shelf.about) await useShipped();
    $("scan-result").hidden = true;
    const bytes = new TextEncoder().encode(shelf.json);
    return scans.call("map", [shelf.name, bytes, JSON.stringify(request), every], stage);
  });
  if (!done) return;
  mapped = done.about;
  const { words, groups, remarks, unmapped, json } = mapped;
  const named = json.palette.filter((found) => found.survey_part >= NAMED);
  $("scan-words").textContent = words;
  $("scan-notes").replaceChildren(...[...groups, ...unmapped].map((text) => element("p", { className: "fine" }, text)), ...remarkList(remarks));
  fillTable(named);
  $("scan-result").hidden = false;
  showMaps(done, named);
  $("scan-heading").focus();
  say(`The scan is mapped: ${named.length} pigments or groups`);
}

function fillTable(found) {
  const part = (value) => `${(100 * value).toFixed(1)} %`;
  const rows = found.map((one) => [one.pigment, part(one.survey_part), part(one.present), part(one.mean_share)]);
  $("scan-table").replaceChildren(namedTable(["pigment", "survey", "present", "mean share"], rows));
}

// The table of `impasto map --csv`.
function csv() {
  const cell = (value) => (/[",\n]/.test(value) ? `"${String(value).replaceAll('"', '""')}"` : value);
  const heads = ["pigment", "survey_part", "present", "mean_share"];
  return [heads, ...mapped.json.palette.map((row) => heads.map((name) => cell(row[name])))].map((row) => `${row.join(",")}\n`).join("");
}
