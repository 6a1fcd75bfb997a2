// White, dark and tile, which make reflectances of raw counts.

import { $, MOST_BYTES, names, number } from "./page.js";

// Fields that change how counts are read.
export const COUNTS = ["c-white", "c-dark", "c-subtracted", "c-tile", "c-tile-file", "c-names", "c-full", "c-least"];

// The name of each file, or its names with `#`, where "Spectra in them" chooses some.
function chosen(files, choices) {
  return files.flatMap(({ name }) => {
    const own = choices.filter((choice) => choice.startsWith(`${name}#`));
    return own.length ? own : [name];
  });
}

function one(files, choices, label) {
  const found = chosen(files, choices);
  if (found.length > 1) throw { message: `${label} is one spectrum, found ${found.join(" and ")}`, hint: "leave one of them in \"Spectra in them\"" };
  return found[0] ?? null;
}

// The files to read with, and how the reader names them: `null` without a white. The ids of the fields begin with
// `prefix`.
export function references(prefix = "") {
  const field = (id) => $(`${prefix}${id}`);
  const [white, dark, tile] = ["c-white", "c-dark", "c-tile-file"].map((id) => [...field(id).files]);
  const [even, full, least] = [["c-tile", "Reflectance of the white"], ["c-full", "Largest count"], ["c-least", "Least light"]]
    .map(([id, label]) => number(field(id), label));
  const subtracted = field("c-subtracted").checked;
  if (even !== null && tile.length) {
    throw { message: "the reflectance of the white is a number or a file, found both", hint: "empty one of the two fields" };
  }
  if (subtracted && dark.length) {
    throw { message: "the dark is subtracted already, or there are dark readings: found both", hint: "take one of the two away" };
  }
  const given = [...white, ...dark, ...tile];
  const bytes = given.reduce((sum, file) => sum + file.size, 0);
  if (bytes > MOST_BYTES) {
    throw { message: `${given.map((file) => file.name).join(", ")}: a page reads 256 MB at most`, hint: "use the program impasto" };
  }
  const choices = names(field("c-names").value);
  const stray = choices.find((choice) => !given.some((file) => choice.startsWith(`${file.name}#`)));
  if (stray !== undefined) {
    const files = given.map((file) => `${file.name}#NAME`).join("; ") || "FILE#NAME, of a file that is chosen above";
    throw { message: `\`${stray}\` names a spectrum of no file that is chosen`, hint: `write ${files}` };
  }
  if (!white.length) {
    const needs = { "Dark readings": dark.length, "Dark is subtracted already": subtracted, "Reflectance of the white": even !== null || tile.length,
      "Largest count": full !== null, "Least light": least !== null };
    const label = Object.keys(needs).find((name) => needs[name]);
    if (label) throw { message: `"${label}" needs the white reading of the same counts`, hint: "choose it in \"White reading\"" };
    return { given: [], named: null };
  }
  const named = {
    white: one(white, choices, "White reading"), dark: chosen(dark, choices), subtracted,
    tile: even ?? one(tile, choices, "Reflectance of the white"), full_scale: full, least_light: least,
  };
  return { given, named };
}
