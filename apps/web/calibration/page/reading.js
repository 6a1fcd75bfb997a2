// Files of spectra: how they are read, and the parts of the page that take them.

import { COUNTS, references } from "./counts.js";
import { Cancelled } from "./engine.js";
import { $, clearNotice, element, fits, remarkList, takesDrops, takesFiles } from "./page.js";
import { long, quick, refuse, work } from "./shelf.js";

// Fields of Fit that say how a file is read.
const FIELDS = ["o-percent", "o-values", "o-wavelengths", "o-format", "o-transmittance"];

// Lists the formats in the field of `prefix`, when they are first seen.
export async function listFormats(prefix = "") {
  const list = $(`${prefix}o-format`);
  if (list.options.length > 1) return;
  try {
    const formats = await quick.call("formats");
    list.append(...formats.map((name) => element("option", { value: name }, name)));
  } catch (error) {
    refuse(error);
  }
}

// How the fields of `prefix` read files.
export function readingOptions(prefix = "") {
  const field = (id) => $(`${prefix}${id}`);
  const percent = field("o-percent").value;
  return {
    format: field("o-format").value || null,
    percent: percent === "" ? null : percent === "true",
    transmittance: field("o-transmittance").checked,
    values: field("o-values").value || null,
    wavelengths: field("o-wavelengths").value.trim() || null,
  };
}

// Calls `changed` when one of the fields of `prefix` changes how files are read.
export function onReading(changed, prefix = "") {
  for (const id of [...FIELDS, ...COUNTS]) $(`${prefix}${id}`).addEventListener("change", changed);
}

// Copies the fields of Fit into the folded `box`, with ids that begin with `prefix`.
function copyFields(box, prefix) {
  const labels = FIELDS.map((id) => $(id).closest("label").cloneNode(true));
  const copies = [element("div", { className: "fields" }, ...labels), $("fit-counts").cloneNode(true)];
  for (const copy of copies) {
    for (const one of [copy, ...copy.querySelectorAll("[id]")]) if (one.id) one.id = `${prefix}${one.id}`;
  }
  box.append(...copies);
  box.addEventListener("toggle", () => listFormats(prefix));
}

// Makes the parts `sets` of the page take files of spectra, which the fields in `box` say how to read. A set is the
// name of an object of the native part, and of the elements NAME-drop, NAME-files and NAME-told. `changed` hears
// which sets are read. Returns how to wait for the reading of files.
export function spectraSets(box, prefix, sets, changed) {
  copyFields(box, prefix);
  const files = new Map();
  const told = new Map();
  let reading = Promise.resolve();
  const readOne = async (name) => {
    const { given, named } = references(prefix);
    const options = JSON.stringify({ ...readingOptions(prefix), references: named });
    const found = await long.make(name, "spectra", [name, files.get(name), given, options]);
    told.set(name, found);
    const count = `${found.readings} ${found.readings === 1 ? "spectrum" : "spectra"}, ${found.grid}`;
    $(`${name}-told`).replaceChildren(element("p", {}, count), ...remarkList(found.remarks));
  };
  const readAll = async (names) => {
    for (const name of names) {
      told.delete(name);
      $(`${name}-told`).replaceChildren();
    }
    await work("reading", async () => {
      // A set that is refused does not keep the others from being read.
      let refused = null;
      for (const name of names) {
        try {
          await readOne(name);
        } catch (error) {
          if (error instanceof Cancelled) throw error;
          refused ??= error;
        }
      }
      if (refused) throw refused;
    });
    changed(told);
  };
  const queue = (names) => {
    if (names.length) reading = reading.then(() => readAll(names));
    return reading;
  };
  for (const name of sets) {
    const take = (chosen) => {
      clearNotice();
      if (!fits(chosen)) return;
      files.set(name, chosen);
      queue([name]);
    };
    takesDrops($(`${name}-drop`), take);
    takesFiles($(`${name}-files`), take);
  }
  onReading(() => queue([...files.keys()]), prefix);
  return () => reading;
}
