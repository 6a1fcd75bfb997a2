// A library in the fragment of a link: compressed JSON, which no server sees.

import { $, notice } from "./page.js";
import { mixed, setParts } from "./mix.js";
import { refuse, shelf, useLibrary } from "./shelf.js";
import { say, select } from "./tabs.js";

// JSON of a linked library, in bytes, that is unpacked at most: a link may come from anybody.
const MOST = 64 * 1024 * 1024;

async function through(stream, bytes, most = Infinity) {
  const piped = new Blob([bytes]).stream().pipeThrough(stream);
  const pieces = [];
  let size = 0;
  for (const reader = piped.getReader(); ;) {
    const { done, value } = await reader.read();
    if (done) return new Uint8Array(await new Blob(pieces).arrayBuffer());
    pieces.push(value);
    size += value.length;
    if (size > most) {
      await reader.cancel();
      throw new RangeError("too large");
    }
  }
}

function base64url(bytes) {
  let text = "";
  for (let at = 0; at < bytes.length; at += 8192) text += String.fromCharCode(...bytes.subarray(at, at + 8192));
  return btoa(text).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

function bytesOf(text) {
  return Uint8Array.from(atob(text.replace(/-/g, "+").replace(/_/g, "/")), (letter) => letter.charCodeAt(0));
}

// The link to this library and mixture.
async function link() {
  const content = JSON.stringify({ name: shelf.name, library: shelf.json, parts: mixed() });
  const packed = await through(new CompressionStream("deflate-raw"), new TextEncoder().encode(content));
  return `${location.href.split("#")[0]}#library=${base64url(packed)}`;
}

// Opens the library of the link by which the page was opened, if there is one.
async function openLinked() {
  const packed = location.hash.match(/^#library=([A-Za-z0-9_-]+)$/)?.[1];
  if (!packed) return;
  let content;
  try {
    const bytes = await through(new DecompressionStream("deflate-raw"), bytesOf(packed), MOST);
    content = JSON.parse(new TextDecoder().decode(bytes));
    if (typeof content.library !== "string") throw new Error("no library");
  } catch {
    notice({ message: "the link holds no library that can be read", hint: "copy the whole link: some programs cut long ones" });
    return;
  }
  try {
    await useLibrary(String(content.name || "library.json"), new TextEncoder().encode(content.library));
    const pairs = Array.isArray(content.parts) ? content.parts : [];
    const known = new Set(shelf.about.pigments.map((pigment) => pigment.name));
    const parts = pairs.filter((pair) => known.has(pair?.[0]) && pair[1] >= 0).map(([name, part]) => [name, Number(part)]);
    if (parts.length) setParts(parts);
    select("mix", false);
  } catch (error) {
    refuse(error);
  }
}

export function startLink() {
  $("library-link").addEventListener("click", async () => {
    try {
      const text = await link();
      history.replaceState(null, "", text);
      const copied = await navigator.clipboard?.writeText(text).then(() => true, () => false);
      say(copied ? "The link is copied" : "The link is in the address bar");
      $("library-link").textContent = copied ? "Link copied" : "See address bar";
      setTimeout(() => { $("library-link").textContent = "Copy link"; }, 3000);
    } catch (error) {
      refuse(error);
    }
  });
  addEventListener("hashchange", openLinked);
  openLinked();
}
