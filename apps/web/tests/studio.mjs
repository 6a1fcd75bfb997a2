// The acts that tests and figures of the studio share.

import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, afterEach, before } from "node:test";
import { launched, served } from "./browser.mjs";

/** Flags by which Chromium draws WebGL 2 without a graphics card. */
export const WEBGL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"];

/** Flags by which it draws WebGPU too. */
const WEBGPU = [...WEBGL, "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan",
  "--use-vulkan=swiftshader", "--disable-gpu-sandbox"];

/** A page that is built quickly, for tests, has no module for WebGPU. */
const FLAGS = existsSync(new URL("../out/studio/webgpu", import.meta.url)) ? WEBGPU : WEBGL;

/** Serves the studio on this machine. */
export const serve = () => served("studio");

/** Starts Chromium, with other flags than those of the page's module, if given. */
export const launch = (flags = FLAGS) => launched(flags);

/**
 * Sets up a file of tests: `server`, `browser` and an empty `folder` are there from its first test until after its last,
 * and `context` opens a window of the browser. Windows are closed after each test, also after one that failed.
 */
export function setUp() {
  const stage = {
    context: (options = {}) => stage.browser.newContext({ viewport: { width: 1280, height: 800 }, ...options }),
  };
  before(async () => {
    stage.folder = mkdtempSync(join(tmpdir(), "impasto-studio-"));
    stage.server = await serve();
    stage.browser = await launch();
  });
  afterEach(async () => {
    for (const context of stage.browser?.contexts() ?? []) await context.close();
  });
  after(async () => {
    await stage.browser?.close();
    stage.server?.end();
    rmSync(stage.folder, { recursive: true, force: true });
  });
  return stage;
}

/** Opens the studio and waits for its first painting. `faults` takes what goes wrong in the page. */
export async function openStudio(context, url, faults = []) {
  const page = await context.newPage();
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  const begun = Date.now();
  await page.goto(url);
  await opened(page);
  return { page, startMs: Date.now() - begun };
}

/** Waits until a painting is open. */
export const opened = (page) =>
  page.waitForFunction(() => window.impasto?.inspect?.()?.revision != null, null, { timeout: 60_000 });

export const inspect = (page) => page.evaluate(() => window.impasto.inspect());

/** Waits until the painting rests. */
export async function rest(page) {
  await page.waitForFunction(() => {
    const state = window.impasto.inspect();
    return state && !state.stroke_open && state.waiting_substeps === 0;
  }, null, { timeout: 120_000, polling: 100 });
}

/** A stroke of a pen by synthetic events: [x, y, pressure], one each `everyMs`. */
export function penStroke(page, points, { everyMs = 5, tilt = [20, 10] } = {}) {
  return page.evaluate(async ({ points, everyMs, tilt }) => {
    const canvas = document.getElementById("studio");
    const send = (type, [x, y, pressure], buttons) => canvas.dispatchEvent(new PointerEvent(type, {
      bubbles: true, cancelable: true, pointerType: "pen", pointerId: 7, isPrimary: true,
      clientX: x, clientY: y, pressure, tiltX: tilt[0], tiltY: tilt[1], button: type === "pointermove" ? -1 : 0,
      buttons, width: 1, height: 1,
    }));
    send("pointermove", [...points[0].slice(0, 2), 0], 0);
    await new Promise((resolve) => setTimeout(resolve, 60));
    send("pointerdown", points[0], 1);
    const begun = performance.now();
    let next = 1;
    await new Promise((resolve) => {
      const timer = setInterval(() => {
        while (next < points.length && performance.now() - begun >= next * everyMs) {
          send("pointermove", points[next++], 1);
        }
        if (next >= points.length) { clearInterval(timer); resolve(); }
      }, 4);
    });
    send("pointerup", [...points.at(-1).slice(0, 2), 0], 0);
  }, { points, everyMs, tilt });
}

/**
 * A stylus that the browser itself reports, as it does one of the system. `stroke` takes points
 * [x, y, pressure, tiltX, tiltY, twist].
 */
export async function stylus(page) {
  const cdp = await page.context().newCDPSession(page);
  const send = (type, [x, y, force, tiltX = 0, tiltY = 0, twist = 0], buttons) =>
    cdp.send("Input.dispatchMouseEvent", {
      type, x, y, force, tiltX, tiltY, twist, buttons, clickCount: 1, pointerType: "pen",
      button: type === "mouseMoved" ? "none" : "left",
    });
  return {
    async stroke(points) {
      await send("mousePressed", points[0], 1);
      for (const point of points.slice(1)) await send("mouseMoved", point, 1);
      await send("mouseReleased", points.at(-1), 0);
    },
  };
}

/** Fingers: `touch(type, points)` with `touchStart`, `touchMove` and `touchEnd`; points are [x, y]. */
export async function fingers(page) {
  const cdp = await page.context().newCDPSession(page);
  return (type, points = []) =>
    cdp.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
}

/** Places of entries in the File menu of the window of 1280 x 800 pixels. */
const FILE_MENU = { sample: 97, saveRecording: 253 };

/** Chooses an entry of the File menu, in the first trial or a later one: it waits longer for the menu each time. */
export async function fromFileMenu(page, entry, trial = 1) {
  await page.mouse.click(18, 13);
  await page.waitForTimeout(300 * trial);
  await page.mouse.click(60, FILE_MENU[entry]);
}

/** Places of entries in the View menu of that window. */
const VIEW_MENU = { dark: 475, light: 502, touch: 567 };

/** Chooses an entry of the View menu, until `condition` of the state holds: a slow page may miss a click. */
export async function fromViewMenu(page, entry, condition) {
  for (let trial = 0; trial < 4 && !condition(await inspect(page)); trial++) {
    await page.mouse.click(85, 13);
    await page.waitForTimeout(600);
    await page.mouse.click(140, VIEW_MENU[entry]);
    await page.waitForTimeout(600);
    await page.keyboard.press("Escape");
    await page.waitForTimeout(300);
  }
  if (!condition(await inspect(page))) throw new Error(`${entry} of the View menu was not chosen`);
}

/**
 * Opens a dialog by `act` and waits until it has been drawn. A slow page may miss an act: it is done again, and takes
 * the number of the trial.
 */
export async function dialog(page, act) {
  for (let trial = 1; ; trial++) {
    await act(trial);
    const open = page.waitForFunction(() => window.impasto.inspect()?.dialog, null, { timeout: 20_000 });
    const missed = await open.then(() => null, (error) => error);
    if (missed === null) break;
    if (trial === 4) throw missed;
    await page.keyboard.press("Escape");
  }
  await page.waitForTimeout(400);
}

/** Does `act`, which downloads a file, and keeps it in `folder`. Returns its path. */
export async function downloaded(page, folder, act) {
  const download = page.waitForEvent("download", { timeout: 120_000 });
  await act();
  const path = join(folder, (await download).suggestedFilename());
  await (await download).saveAs(path);
  return path;
}

/** Presses Enter in each dialog until none is open: a slow page may open the next one late. */
export async function confirm(page) {
  for (let trial = 0; trial < 40; trial++) {
    await page.keyboard.press("Enter");
    await page.waitForTimeout(700);
    if (!(await inspect(page))?.dialog) return;
  }
  throw new Error("a dialog stays open");
}

/** Saves under the names that the dialogs propose, the first of which `open` opens. Returns the path of the download. */
export const confirmed = (page, folder, open) => downloaded(page, folder, async () => {
  await dialog(page, open);
  await confirm(page);
});

/** Waits until the state of the page fulfils `condition`, a function of it and `value`. */
export async function until(page, condition, value = null, timeout = 30_000) {
  const text = `(value) => { const state = window.impasto.inspect(); return state !== null && (${condition})(state, value); }`;
  await page.waitForFunction(new Function("value", `return (${text})(value)`), value, { timeout, polling: 100 });
}

/** Takes up the painting that the page offers: a slow page may miss a click. */
export async function recover(page) {
  for (let trial = 0; trial < 5; trial++) {
    await page.waitForTimeout(1500);
    // The button Recover of the offer, at the top of the canvas.
    await page.mouse.click(786, 69);
    await until(page, (state) => state.lost === 0, null, 10_000).catch(() => {});
    if ((await inspect(page))?.lost === 0) return;
  }
  throw new Error("the painting that is offered was not taken up");
}

/** Writes preferences to the browser's storage, as the page keeps them, before the studio is opened. */
export async function prepared(context, url, preferences) {
  const page = await context.newPage();
  await page.route("**/favicon.ico", (route) => route.abort());
  // A page of the same host that does nothing.
  await page.goto(new URL("studio.css", url).href);
  await page.evaluate(async (text) => {
    let folder = await navigator.storage.getDirectory();
    for (const name of ["impasto-studio", "settings"]) folder = await folder.getDirectoryHandle(name, { create: true });
    for (const [name, content] of [["f0", text], ["list.json", '{"next":1,"files":{"/settings/preferences.json":"f0"}}']]) {
      const writable = await (await folder.getFileHandle(name, { create: true })).createWritable();
      await writable.write(content);
      await writable.close();
    }
  }, JSON.stringify(preferences));
  await page.close();
}
