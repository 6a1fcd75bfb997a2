// The page around the studio: starts it, gives its worker turns, passes pens and files on.

import { Overlay } from "./between.js";
import { Storage } from "./storage.js";
import { said } from "./words.js";

const canvas = document.getElementById("studio");
const message = document.getElementById("message");

/** Longest turn of the worker between two frames, in ms. */
const TURN_MS = 8;

/** Shows a text in place of the studio; with a button that loads the page again, if that may help. */
function show(text, again = false) {
  message.hidden = false;
  document.getElementById("loading").hidden = true;
  document.getElementById("text").textContent = text;
  const button = document.getElementById("again");
  button.hidden = !again;
  button.textContent = said("Load again");
  button.onclick = () => location.reload();
  if (again) button.focus();
}

/** Tells that the studio has ended where an error of the module ends it. */
function watchForItsEnd() {
  const seen = (error) => {
    if (!(error instanceof WebAssembly.RuntimeError)) return;
    show(said("The studio has ended by an error in it. What was autosaved is offered when the page is loaded again."), true);
  };
  window.addEventListener("error", (event) => seen(event.error));
  window.addEventListener("unhandledrejection", (event) => seen(event.reason));
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

/** Shows strokes of a stylus between frames. `ask` is to be called when the stylus has moved, `afterFrame` after each frame. */
function showStrokes(page) {
  const overlay = new Overlay();
  let asked = false;
  let shows = false;
  const show = () => {
    asked = false;
    const part = page.between();
    shows = part !== undefined;
    if (!shows) return;
    overlay.show(part);
    ask();
  };
  const ask = () => {
    if (!asked) {
      asked = true;
      requestAnimationFrame(show);
    }
  };
  return { ask, afterFrame: () => overlay.clear(), shows: () => shows };
}

/** Time until a write to the browser's storage that failed is tried again, in ms. */
const RETRY_MS = 5000;

/** Keeps changes in the browser's storage, one batch after the other, and offers saved files. */
function keepFiles(page, storage) {
  let waiting = new Map();
  // Adopted files are written at once.
  let owes = storage !== null && storage.owed.length > 0;
  let busy = false;
  let told = false;
  const write = async () => {
    if (busy || (waiting.size === 0 && !owes)) return;
    busy = true;
    const batch = waiting;
    waiting = new Map();
    try {
      const cleared = await storage.apply([...batch], () => page.kept());
      owes = false;
      told = false;
      if (cleared) page.storage_problem("cleared", "");
    } catch (error) {
      // What is newer stays.
      waiting = new Map([...batch, ...waiting]);
      if (!told) {
        told = true;
        console.warn("the browser's storage cannot be written", error);
        const kind = error.name === "QuotaExceededError" ? "full" : "failed";
        page.storage_problem(kind, String(error.message ?? error));
      }
      await new Promise((resolve) => setTimeout(resolve, RETRY_MS));
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
      page.unreadable(file.name, String(error.message ?? error));
    }
  }
}

/** Passes styluses on: every event that the browser has, also those between two frames. */
function listenToPens(page, strokes, askTurn) {
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
    let taken = false;
    for (const part of all.length > 0 ? all : [event]) taken = page.pen(1, numbers(part, now));
    if (!taken) return;
    askTurn();
    strokes.ask();
  }, options);
  // The studio would draw a frame for each.
  window.addEventListener("mousemove", (event) => strokes.shows() && event.stopImmediatePropagation(), options);
  canvas.addEventListener("pointerup", (event) => {
    if (isPen(event)) page.pen(2, numbers(event, performance.now()));
  }, options);
  for (const name of ["pointercancel", "pointerleave"]) {
    canvas.addEventListener(name, (event) => {
      if (isPen(event)) page.pen(3, numbers(event, performance.now()));
    }, options);
  }
  // Fingers reach the studio as touches. Their pointer events would begin a stroke as a mouse before.
  for (const name of ["pointerdown", "pointerup"]) {
    window.addEventListener(name, (event) => {
      if (event.pointerType !== "touch" || event.target !== canvas) return;
      event.stopImmediatePropagation();
      if (document.activeElement === document.body) canvas.focus({ preventScroll: true });
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
    show(said("This browser has neither WebGPU nor WebGL 2, one of which the studio draws with. Turn on hardware acceleration in its settings, or use a newer browser."));
    return;
  }
  const [{ Page, memory }, storage] = await Promise.all([load(folder), opening]);
  const page = new Page(navigator.language, matchMedia("(pointer: coarse)").matches);
  for (const [path, content] of storage?.taken ?? []) page.put(path, content);
  const keep = keepFiles(page, storage);
  let first = true;
  const ask = giveTurns(page, keep);
  const strokes = showStrokes(page);
  const chooser = document.createElement("input");
  chooser.type = "file";
  chooser.addEventListener("change", () => open(page, [...chooser.files]));
  await page.start(canvas, () => {
    if (first) {
      first = false;
      message.hidden = true;
      window.impasto.firstFrame = performance.now() - begun;
    }
    strokes.afterFrame();
    ask();
    queueMicrotask(() => {
      const wanted = page.wanted();
      if (wanted === undefined) return;
      chooser.value = "";
      chooser.accept = wanted;
      // A browser opens its dialog only soon after a key or a press: a slow frame may come too late.
      if (navigator.userActivation?.isActive ?? true) chooser.click();
      else window.addEventListener("pointerup", () => chooser.click(), { once: true, capture: true });
    });
  });
  listenToPens(page, strokes, ask);
  window.addEventListener("drop", (event) => open(page, [...(event.dataTransfer?.files ?? [])]), true);
  document.addEventListener("visibilitychange", () => {
    if (!document.hidden) return;
    page.leave();
    keep();
  });
  if (!storage) {
    page.storage_problem("denied", "");
  }
  window.impasto.page = page;
  window.impasto.memory = memory;
  window.impasto.inspect = () => JSON.parse(page.inspect());
  window.impasto.openFiles = (files) => open(page, files);
}

window.impasto = {};
document.getElementById("text").textContent = said("The studio is loading.");
watchForItsEnd();
start().catch((error) => {
  console.error(error);
  if (error instanceof WebAssembly.CompileError) {
    show(said("This browser does not know the instructions that the studio is made of (WebAssembly with SIMD). Use a newer browser."));
  } else {
    show(`${said("The studio cannot start")}: ${error.message ?? error}`, true);
  }
});
