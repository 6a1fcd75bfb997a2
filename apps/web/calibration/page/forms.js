// Fields of a request, made of its schema. `requests.json` holds what docs/schema/requests.json says of the requests
// that the page lists in the file `requests`.

import { $, element, names, number, wholeNumber } from "./page.js";
import { refuse } from "./shelf.js";

let schemas = null;

async function schemaOf(request) {
  schemas ??= fetch("requests.json").then((answer) => answer.json());
  return [(await schemas)[request].properties, await schemas];
}

// `thickness_mm` as a label.
function words(key) {
  const text = key.replace(/_mm$/, ", mm").replaceAll("_", " ");
  return text[0].toUpperCase() + text.slice(1);
}

// The description without its marks: the usual value is a sentence of its own.
function help(description) {
  const text = description.replace(/\s+/g, " ").replaceAll("`", "").replace("; may be repeated", "");
  const [, said, usual] = /^(.*?)(?: \[default: (.*)\])?$/.exec(text);
  return usual ? `${said}. If empty: ${usual}.` : `${said}.`;
}

// The control of one key, and how to read it: `undefined` leaves the key out.
function control(id, key, property, all) {
  const choices = property.$ref && all[property.$ref.split("/").at(-1)].oneOf?.map((choice) => choice.const);
  const kind = [property.type].flat()[0];
  if (choices) {
    const list = element("select", { id }, ...choices.map((name) => element("option", { selected: name === property.default }, name)));
    return [list, () => list.value];
  }
  if (kind === "boolean") {
    const box = element("input", { id, type: "checkbox", checked: property.default });
    return [box, () => box.checked];
  }
  const field = element("input", { id, spellcheck: false, autocomplete: "off", placeholder: kind === "array" ? "names; with semicolons" : String(property.default ?? "") });
  if (kind === "array") return [field, () => names(field.value)];
  if (kind === "integer") return [field, () => wholeNumber(field, words(key), 0) ?? undefined];
  if (kind === "number") {
    field.inputMode = "decimal";
    return [field, () => number(field, words(key)) ?? undefined];
  }
  return [field, () => field.value.trim() || undefined];
}

// Fills each box of `boxes` (pairs of a box and the keys of its fields; `null` for all keys that are left) with the
// fields of `request`. Returns how to read them. The id of a field is KEY-of-`part`.
export function form(part, request, boxes, without = []) {
  const readers = [];
  const made = schemaOf(request).then(([properties, all]) => {
    const named = [...without, ...boxes.flatMap(([, keys]) => keys ?? [])];
    for (const [box, keys] of boxes) {
      for (const key of keys ?? Object.keys(properties).filter((one) => !named.includes(one))) {
        const id = `${key}-of-${part}`;
        const [field, read] = control(id, key, properties[key], all);
        field.setAttribute("aria-describedby", `${id}-help`);
        const label = element("label", { htmlFor: id, className: field.type === "checkbox" ? "check" : "" }, ...(field.type === "checkbox" ? [field, words(key)] : [words(key), field]));
        $(box).append(element("div", { className: "field" }, label, element("small", { id: `${id}-help` }, help(properties[key].description))));
        readers.push([key, read]);
      }
    }
  });
  made.catch(refuse);
  return async () => {
    await made;
    return Object.fromEntries(readers.map(([key, read]) => [key, read()]));
  };
}
