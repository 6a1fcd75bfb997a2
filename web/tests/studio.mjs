// The acts that tests and figures of the studio share.

import { launched, served } from "./browser.mjs";

/** Flags by which Chromium draws WebGPU without a graphics card. */
const FLAGS = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan",
  "--use-vulkan=swiftshader", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
  "--ignore-gpu-blocklist", "--disable-gpu-sandbox"];

/** Serves the studio on this machine. */
export const serve = () => served("studio");

/** Starts Chromium. */
export const launch = () => launched(FLAGS);

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
