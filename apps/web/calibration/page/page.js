// Small parts of the page: elements, notices, remarks, files.

export const $ = (id) => document.getElementById(id);

// An element with properties and children.
export function element(name, properties = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(properties)) {
    if (key in made) made[key] = value;
    else made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

// Shows a refusal: message, causes, hint. The focus goes there, so that a screen reader reads it.
export function notice(failure) {
  const close = element("button", { type: "button", textContent: "Close" });
  close.onclick = clearNotice;
  const causes = (failure.causes ?? []).map((text) => element("p", {}, `Because: ${text}`));
  const hint = failure.hint ? [element("p", { className: "hint" }, `Way out: ${failure.hint}`)] : [];
  $("notice").replaceChildren(element("strong", {}, failure.message), close, ...causes, ...hint);
  $("notice").hidden = false;
  $("notice").focus();
}

export function clearNotice() {
  $("notice").hidden = true;
  $("notice").replaceChildren();
}

// Notes that are shown at once; more of them are folded.
const MOST_NOTES = 8;

// A list of remarks; warnings come first.
export function remarkList(remarks) {
  const list = (remarks) => element("ul", {}, ...remarks.map(({ warning, text, hint }) => {
    const item = element("li", { className: warning ? "warning" : "" }, warning ? `Warning: ${text}` : text);
    if (hint) item.append(element("br"), element("small", {}, hint));
    return item;
  }));
  const warnings = remarks.filter(({ warning }) => warning);
  const notes = remarks.filter(({ warning }) => !warning);
  if (notes.length <= MOST_NOTES) return remarks.length ? [list([...warnings, ...notes])] : [];
  const folded = element("details", {}, element("summary", {}, `${notes.length} remarks`), list(notes));
  return warnings.length ? [list(warnings), folded] : [folded];
}

// Bytes of files that are read at once at most. A table takes several times its file's size while it is read,
// and a page has 4 GB at most.
export const MOST_BYTES = 256 * 1024 * 1024;

const mebibytes = (bytes) => `${Math.ceil(bytes / 1024 / 1024)} MB`;

// Refuses files too large for memory, before they are read. Returns whether they may be read.
export function fits(files, most = MOST_BYTES, hint = "use the program impasto, which reads large files in pieces") {
  const bytes = files.reduce((sum, file) => sum + file.size, 0);
  if (bytes <= most) return true;
  const names = files.map((file) => file.name).join(", ");
  notice({
    message: `${names}: ${mebibytes(bytes)}, and a page reads ${mebibytes(most)} at most`,
    hint,
  });
  return false;
}

// Makes `zone` take dropped files.
export function takesDrops(zone, take) {
  zone.addEventListener("dragover", (event) => {
    event.preventDefault();
    zone.classList.add("over");
  });
  zone.addEventListener("dragleave", () => zone.classList.remove("over"));
  zone.addEventListener("drop", (event) => {
    event.preventDefault();
    event.stopPropagation();
    zone.classList.remove("over");
    const files = [...event.dataTransfer.files];
    if (files.length) take(files);
  });
}

// Takes the files of an input. The same file may be chosen again.
export function takesFiles(input, take) {
  input.addEventListener("change", () => {
    const files = [...input.files];
    input.value = "";
    if (files.length) take(files);
  });
}

// A table whose first column names its rows. The first `left` columns hold words, the others numbers.
export function namedTable(heads, rows, left = 1) {
  const side = (place) => (place < left ? "" : "n");
  const cells = (row) => row.map((cell, place) => {
    const properties = place ? {} : { scope: "row" };
    return element(place ? "td" : "th", { className: side(place), ...properties }, cell instanceof Node ? cell : String(cell));
  });
  const head = heads.map((text, place) => element("th", { scope: "col", className: side(place) }, text));
  const body = rows.map((row) => element("tr", {}, ...cells(row)));
  return element("table", {}, element("thead", {}, element("tr", {}, ...head)), element("tbody", {}, ...body));
}

// Shows the result of a part of the page, and tells a screen reader so by the focus.
export function showResult(part) {
  $(`${part}-result`).hidden = false;
  $(`${part}-done`).focus();
}

// Saves text as a file of the browser's downloads.
export function download(name, text, type) {
  const url = URL.createObjectURL(new Blob([text], { type }));
  element("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

// Names between semicolons.
export const names = (text) => text.split(";").map((name) => name.trim()).filter(Boolean);

// A number, or `null` for an empty field. Refuses anything else.
export function number(field, label) {
  const text = field.value.trim().replace(/^(\d*),(\d+)$/, "$1.$2");
  if (text === "") return null;
  const value = Number(text);
  if (Number.isFinite(value)) return value;
  throw { message: `${label} is a number, found \`${field.value}\``, hint: "leave the field empty for the usual value" };
}

// A whole number of `least` and up, or `null` for an empty field.
export function wholeNumber(field, label, least) {
  const value = number(field, label);
  if (value === null || (Number.isInteger(value) && value >= least && value < 2 ** 31)) return value;
  throw { message: `${label} is a whole number from ${least} on, found \`${field.value}\``, hint: "write digits alone" };
}

// Black or white, whichever is seen better on `hex`.
export function inkOn(hex) {
  const [r, g, b] = [1, 3, 5].map((at) => (parseInt(hex.slice(at, at + 2), 16) / 255) ** 2.2);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b > 0.18 ? "#000" : "#fff";
}
