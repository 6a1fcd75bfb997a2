// A browser, a server for the built page, and the acts that tests of the studio share.

import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { extname, join } from "node:path";
import { chromium } from "playwright-core";

const KINDS = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };

/** Flags by which Chromium draws WebGPU without a graphics card. */
export const FLAGS = ["--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan",
  "--use-vulkan=swiftshader", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
  "--ignore-gpu-blocklist", "--disable-gpu-sandbox", "--no-sandbox"];

/** Serves a folder on this machine. */
export async function serve(folder) {
  const server = createServer(async (request, response) => {
    const path = new URL(request.url, "http://localhost").pathname;
    const name = path === "/" ? "index.html" : path.slice(1);
    try {
      const content = await readFile(join(folder, name));
      response.writeHead(200, { "content-type": KINDS[extname(name)] ?? "application/octet-stream" });
      response.end(content);
    } catch {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  return { url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

/** Starts Chromium. */
export function launch(options = {}) {
  const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";
  return chromium.launch({ executablePath, headless: true, args: FLAGS, ...options });
}

/** Opens the studio and waits for its first painting. Errors of the page end the test. */
export async function openStudio(context, url) {
  const page = await context.newPage();
  page.on("pageerror", (error) => { console.error("page error:", error.message); process.exitCode = 1; });
  page.on("console", (message) => {
    if (message.type() === "error") console.error("console:", message.text());
  });
  const begun = Date.now();
  await page.goto(url);
  await page.waitForFunction(() => window.impasto?.inspect?.()?.revision != null, null, { timeout: 60_000 });
  return { page, startMs: Date.now() - begun };
}

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
