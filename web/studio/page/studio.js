// The page around the studio: starts it, gives its worker turns, passes pens and files on.

import { Storage } from "./storage.js";

const canvas = document.getElementById("studio");
const message = document.getElementById("message");

/** Longest turn of the worker between two frames, in ms. */
const TURN_MS = 8;

/** Shows a text in place of the studio. */
function show(text) {
  message.hidden = false;
  document.getElementById("loading").hidden = true;
  document.getElementById("text").textContent = text;
}

/** What the browser can draw with: the folder of the module for it, null if there is none. */
async function drawing() {
  try {
    if (navigator.gpu && (await navigator.gpu.requestAdapter())) return "webgpu";
  } catch { /* WebGL 2 may still do. */ }
  return document.createElement("canvas").getContext("webgl2") && "webgl";
}

/** Loads the module of a folder: its class Page and its memory. */
async function load(folder) {
  const module = await import(`./${folder}/impasto_web_studio.js`);
  const file = new URL(`${folder}/impasto_web_studio_bg.wasm`, import.meta.url);
  const { memory } = await module.default({ module_or_path: file });
  return { Page: module.Page, memory };
}

/** Lets the worker work between frames, as long as it has something to do. */
function giveTurns(page, afterTurn) {
  const channel = new MessageChannel();
  let asked = false;
  let timer;
  const turn = () => {
    asked = false;
    const wait = page.turn(TURN_MS);
    afterTurn();
    clearTimeout(timer);
    if (wait === 0) ask();
    else if (wait > 0) timer = setTimeout(ask, wait);
  };
  // A message is handled after input and frames that wait, unlike a chain of promises.
  const ask = () => {
    if (!asked) {
      asked = true;
      channel.port2.postMessage(null);
    }
  };
  channel.port1.onmessage = turn;
  return ask;
}

/** Keeps changes in the browser's storage, one batch after the other, and offers saved files. */
function keepFiles(page, storage) {
  let waiting = new Map();
  let busy = false;
  let told = false;
  const write = async () => {
    if (busy || waiting.size === 0) return;
    busy = true;
    const batch = waiting;
    waiting = new Map();
    try {
      await storage.apply([...batch]);
      told = false;
    } catch (error) {
      // What is newer stays.
      waiting = new Map([...batch, ...waiting]);
      if (!told) {
        told = true;
        const full = error.name === "QuotaExceededError";
        const text = full ? "the browser's storage is full" : `the browser's storage: ${error.message}`;
        page.report(`the autosave cannot be kept: ${text}`, "save the painting: it is downloaded");
      }
      await new Promise((resolve) => setTimeout(resolve, 5000));
    }
    busy = false;
    write();
  };
  return () => {
    for (const [path, content] of page.changes()) {
      if (path.startsWith("/files/")) {
        const kept = path.includes(".revisions/");
        if (content !== null && !kept) download(path, content);
      } else if (storage) {
        waiting.set(path, content);
      }
    }
    write();
  };
}

/** Offers a file for download. */
function download(path, content) {
  const url = URL.createObjectURL(new Blob([content]));
  const link = document.createElement("a");
  link.href = url;
  link.download = path.split("/").pop();
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

/** Reads files and opens them; one that is too large is refused before it is read. */
async function open(page, files) {
  for (const file of files) {
    if (!page.takes(file.name, file.size)) continue;
    try {
      page.open(file.name, new Uint8Array(await file.arrayBuffer()));
    } catch (error) {
      page.report(`${file.name}: cannot be read: ${error.message ?? error}`, "choose it again");
    }
  }
}

/** Passes styluses on: every event that the browser has, also those between two frames. */
function listenToPens(page) {
  const numbers = (event, now) => {
    const box = canvas.getBoundingClientRect();
    const { clientX, clientY, pressure, tiltX, tiltY, twist, buttons, timeStamp } = event;
    const age = Math.max(0, now - timeStamp);
    return new Float64Array(
      [clientX - box.left, clientY - box.top, pressure, tiltX, tiltY, twist, buttons, age]);
  };
  const isPen = (event) => event.pointerType === "pen";
  const options = { capture: true };
  canvas.addEventListener("pointerdown", (event) => {
    if (!isPen(event)) return;
    try { canvas.setPointerCapture(event.pointerId); } catch { /* It is gone already. */ }
    page.pen(0, numbers(event, performance.now()));
  }, options);
  canvas.addEventListener("pointermove", (event) => {
    if (!isPen(event)) return;
    const all = event.getCoalescedEvents?.() ?? [];
    const now = performance.now();
    for (const part of all.length > 0 ? all : [event]) page.pen(1, numbers(part, now));
  }, options);
  canvas.addEventListener("pointerup", (event) => {
    if (isPen(event)) page.pen(2, numbers(event, performance.now()));
  }, options);
  for (const name of ["pointercancel", "pointerleave"]) {
    canvas.addEventListener(name, (event) => {
      if (isPen(event)) page.pen(3, numbers(event, performance.now()));
    }, options);
  }
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
}

async function start() {
  const begun = performance.now();
  const opening = Storage.open().catch((error) => {
    console.warn("the browser's storage cannot be used", error);
    return null;
  });
  const folder = await drawing();
  if (!folder) {
    show("This browser has neither WebGPU nor WebGL 2, one of which the studio draws with. " +
      "Turn on hardware acceleration in its settings, or use a newer browser.");
    return;
  }
  const [{ Page, memory }, storage] = await Promise.all([load(folder), opening]);
  const page = new Page(navigator.language);
  for (const [path, content] of storage?.taken ?? []) page.put(path, content);
  const keep = keepFiles(page, storage);
  let first = true;
  const ask = giveTurns(page, keep);
  const chooser = document.createElement("input");
  chooser.type = "file";
  chooser.addEventListener("change", () => open(page, [...chooser.files]));
  await page.start(canvas, () => {
    if (first) {
      first = false;
      message.hidden = true;
      window.impasto.firstFrame = performance.now() - begun;
    }
    ask();
    queueMicrotask(() => {
      const wanted = page.wanted();
      if (wanted === undefined) return;
      chooser.value = "";
      chooser.accept = wanted;
      chooser.click();
    });
  });
  listenToPens(page);
  window.addEventListener("drop", (event) => open(page, [...(event.dataTransfer?.files ?? [])]), true);
  document.addEventListener("visibilitychange", () => {
    if (!document.hidden) return;
    page.leave();
    keep();
  });
  if (!storage) {
    page.report("this browser keeps no autosaves: it denies its storage to this page",
      "save the painting often: it is downloaded");
  }
  window.impasto.page = page;
  window.impasto.memory = memory;
  window.impasto.inspect = () => JSON.parse(page.inspect());
  window.impasto.openFiles = (files) => open(page, files);
}

window.impasto = {};
start().catch((error) => {
  console.error(error);
  show(`The studio cannot start: ${error.message ?? error}`);
});
