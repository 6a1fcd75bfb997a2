// The readings of the oils as other files: a workbook, UTF-16, CGATS with recipes apart, and raw counts.

import { crc32, deflateRawSync } from "node:zlib";

// Rows of a CSV, whose quoted cells may hold commas.
function rowsOf(csv) {
  const cells = (line) => [...line.matchAll(/("(?:[^"]|"")*"|[^,]*)(,|$)/g)]
    .slice(0, -1)
    .map(([, cell]) => cell.replace(/^"(.*)"$/, "$1").replaceAll('""', '"'));
  return csv.trim().split(/\r?\n/).map((line) => cells(`${line},`));
}

// A ZIP archive of named texts.
function zip(files) {
  const [parts, entries] = [[], []];
  let offset = 0;
  for (const [name, text] of Object.entries(files)) {
    const [bytes, path] = [Buffer.from(text), Buffer.from(name)];
    const packed = deflateRawSync(bytes);
    const head = Buffer.alloc(30);
    head.writeUInt32LE(0x04034b50, 0);
    head.writeUInt16LE(20, 4);
    head.writeUInt16LE(8, 8);
    head.writeUInt32LE(crc32(bytes), 14);
    head.writeUInt32LE(packed.length, 18);
    head.writeUInt32LE(bytes.length, 22);
    head.writeUInt16LE(path.length, 26);
    const entry = Buffer.alloc(46);
    entry.writeUInt32LE(0x02014b50, 0);
    entry.writeUInt16LE(20, 4);
    head.copy(entry, 6, 4, 28);
    entry.writeUInt16LE(path.length, 28);
    entry.writeUInt32LE(offset, 42);
    parts.push(head, path, packed);
    entries.push(entry, path);
    offset += 30 + path.length + packed.length;
  }
  const index = Buffer.concat(entries);
  const end = Buffer.alloc(22);
  end.writeUInt32LE(0x06054b50, 0);
  end.writeUInt16LE(Object.keys(files).length, 8);
  end.writeUInt16LE(Object.keys(files).length, 10);
  end.writeUInt32LE(index.length, 12);
  end.writeUInt32LE(offset, 16);
  return Buffer.concat([...parts, index, end]);
}

const letters = (column) => (column < 26 ? "" : letters(Math.floor(column / 26) - 1)) + String.fromCharCode(65 + (column % 26));
const escaped = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");

// A workbook with the cells of a CSV.
export function workbook(csv) {
  const [main, office, packages] = ["spreadsheetml/2006/main", "officeDocument/2006/relationships", "package/2006/relationships"]
    .map((path) => `http://schemas.openxmlformats.org/${path}`);
  const cell = (text, row, column) => {
    if (text === "") return "";
    const place = `r="${letters(column)}${row}"`;
    return Number.isFinite(Number(text)) ? `<c ${place}><v>${text}</v></c>` : `<c ${place} t="str"><v>${escaped(text)}</v></c>`;
  };
  const rows = rowsOf(csv).map((cells, at) => `<row r="${at + 1}">${cells.map((text, column) => cell(text, at + 1, column)).join("")}</row>`);
  const declared = '<?xml version="1.0" encoding="UTF-8"?>';
  return zip({
    "[Content_Types].xml": `${declared}<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"/>`,
    "_rels/.rels": `${declared}<Relationships xmlns="${packages}"><Relationship Id="a" Type="${office}/officeDocument" Target="xl/workbook.xml"/></Relationships>`,
    "xl/workbook.xml": `${declared}<workbook xmlns="${main}" xmlns:r="${office}"><sheets><sheet name="Readings" sheetId="1" r:id="b"/></sheets></workbook>`,
    "xl/_rels/workbook.xml.rels": `${declared}<Relationships xmlns="${packages}"><Relationship Id="b" Type="${office}/worksheet" Target="worksheets/one.xml"/></Relationships>`,
    "xl/worksheets/one.xml": `${declared}<worksheet xmlns="${main}"><sheetData>${rows.join("")}</sheetData></worksheet>`,
  });
}

// The text in UTF-16 with its mark.
export const utf16 = (text) => Buffer.from(`\ufeff${text}`, "utf16le");

// The readings as CGATS, and their recipes as CSV.
export function apart(csv) {
  const [head, ...rows] = rowsOf(csv);
  const first = head.indexOf("400");
  const quoted = (cells) => cells.map((cell) => `"${cell}"`).join(",");
  const sets = rows.map((row, at) => `"reading ${at + 1}" ${row.slice(first).join(" ")}`);
  const fields = `SAMPLE_ID ${head.slice(first).map((nm) => `SPECTRAL_NM${nm}`).join(" ")}`;
  const cgats = `CGATS.17\nBEGIN_DATA_FORMAT\n${fields}\nEND_DATA_FORMAT\nNUMBER_OF_SETS ${rows.length}\nBEGIN_DATA\n${sets.join("\n")}\nEND_DATA\n`;
  const recipes = [`reading,${quoted(head.slice(0, first))}`, ...rows.map((row, at) => `reading ${at + 1},${quoted(row.slice(0, first))}`)];
  return { cgats, recipes: `${recipes.join("\n")}\n` };
}

// The readings of the mixtures of some pigments as a spectrometer counts them, a file each, with their recipes, the
// readings of white and dark, and the reflectance of the white as a file.
export function counts(csv, pigments) {
  const [head, ...rows] = rowsOf(csv);
  const first = head.indexOf("400");
  const nm = head.slice(first).map(Number);
  const own = [...head.keys()].filter((at) => at < 3 || pigments.includes(head[at]));
  const amounts = [...head.keys()].filter((at) => at >= 3 && at < first);
  // Bare grounds have the sample's name and no amounts.
  const painted = rows.filter((row) => row[1] === "paint" && amounts.every((at) => !Number(row[at]) || own.includes(at)));
  const samples = new Set(painted.map(([sample]) => sample));
  const [dark, tile] = [210, 0.98];
  const white = (at) => 30_000 + 40 * at;
  const lines = (values) => values.map((value, at) => `${nm[at]} ${value}\n`).join("");
  const files = rows.filter(([sample]) => samples.has(sample)).map((row, at) => ({
    name: `reading-${at + 1}.txt`, row,
    bytes: lines(row.slice(first).map((percent, at) => (dark + ((white(at) - dark) * percent) / 100 / tile).toFixed(3))),
  }));
  const quoted = (cells) => cells.map((cell) => `"${cell}"`).join(",");
  const recipes = [`reading,${quoted(own.map((at) => head[at]))}`,
    ...files.map(({ name, row }) => `${name.replace(".txt", "")},${quoted(own.map((at) => row[at]))}`)];
  return {
    files, tile, recipes: `${recipes.join("\n")}\n`,
    references: {
      "white.txt": lines(nm.map((_, at) => white(at))), "dark.txt": lines(nm.map(() => dark)),
      "tile.csv": `nm,reflectance\n${nm.map((value) => `${value},${tile}`).join("\n")}\n`,
    },
  };
}
