// Figures of the studio in Chromium: how fast it opens and paints, and what memory it takes.
//
//   apps/web/build studio && node apps/web/tests/studio-figures.mjs
//
// The window has 1280 x 800 pixels, the canvas 1920 x 1080 cells. The round brush, 60 cells wide, paints
// at 95 mm/s, once by a pen's events every 5 ms.

import { inspect, launch, openStudio, penStroke, rest, serve } from "./studio.mjs";

const server = await serve();
const browser = await launch();
const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
const { page, startMs } = await openStudio(context, server.address);
const begin = await inspect(page);
const firstFrame = await page.evaluate(() => window.impasto.firstFrame);
const paint = await page.evaluate(() => performance.getEntriesByType("paint").map((entry) => [entry.name, entry.startTime]));
console.log({ graphics: begin.graphics, cells: begin.cells, startMs, firstFrame, paint });
await page.keyboard.press("Escape");
await page.waitForTimeout(1500);

const [[left, top], [right, bottom]] = begin.corners;
const pxPerMm = (right - left) / (begin.cells[0] * begin.cell_mm);
const speed = 95 * pxPerMm; // pixels a second
const everyMs = 5;
// Along ellipses on the canvas.
const [cx, cy, rx, ry] = [(left + right) / 2, (top + bottom) / 2, 0.3 * (right - left), 0.25 * (bottom - top)];
const seconds = 6;
const points = [];
let angle = 0;
for (let at = 0; at < (seconds * 1000) / everyMs; at++) {
  points.push([cx + rx * Math.cos(angle), cy + ry * Math.sin(angle), 0.55]);
  angle += (speed * everyMs) / 1000 / Math.hypot(rx * Math.sin(angle), ry * Math.cos(angle));
}
const watching = page.evaluate((ms) => new Promise((resolve) => {
  const seen = [];
  const begun = performance.now();
  const first = window.impasto.inspect().frames;
  const timer = setInterval(() => {
    const state = window.impasto.inspect();
    seen.push([state.waiting_substeps, state.mean_latency_ms, state.max_latency_ms, state.substeps_per_second]);
    if (performance.now() - begun > ms) {
      clearInterval(timer);
      resolve({ seen, fps: (1000 * (state.frames - first)) / (performance.now() - begun) });
    }
  }, 100);
}), seconds * 1000 - 300);
const stroke = penStroke(page, points, { everyMs });
const { seen, fps } = await watching;
await stroke;
const column = (index) => seen.slice(8).map((row) => row[index]).sort((a, b) => a - b);
const of = (list) => ({ median: list[list.length >> 1], most: list.at(-1) });
console.log({ framesPerSecond: fps.toFixed(1), behind: of(column(0)), meanLatencyMs: of(column(1)),
  maxLatencyMs: of(column(2)), substepsPerSecond: of(column(3)) });
await rest(page);
const cdp = await context.newCDPSession(page);
await cdp.send("Performance.enable");
const wasm = await page.evaluate(() => window.impasto.memory?.buffer.byteLength);
console.log({ wasmMemoryMB: wasm / 1e6 });
await browser.close();
server.end();
