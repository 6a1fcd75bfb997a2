// The studio in a real browser: paints with a pen, undoes, relights, saves, reloads and recovers.
//
//   node web/studio/tests/studio.test.mjs PAGE OUT
//
// PAGE is the built page, OUT a folder for the painting, the recording and the screenshots. What was
// saved is compared with the program's own replay by
//   cargo run -p impasto-session --example same_paint -- OUT/pen.json OUT/pen.exr

import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { inspect, launch, openStudio, penStroke, rest, serve } from "./browser.mjs";

const [folder, out] = [process.env.PAGE ?? process.argv[2], process.env.OUT ?? process.argv[3]];
mkdirSync(out, { recursive: true });
const server = await serve(folder);
const browser = await launch();
const size = { width: 1280, height: 800 };

const wave = (y, count = 60) => Array.from({ length: count }, (_, at) =>
  [330 + 6 * at, y + 30 * Math.sin(at / 6), 0.25 + 0.6 * Math.abs(Math.sin(at / 9))]);

async function saved(page, act, name) {
  const download = page.waitForEvent("download", { timeout: 120_000 });
  await act();
  const path = join(out, name);
  await (await download).saveAs(path);
  return path;
}

test("a pen paints with pressure, undo takes a stroke back, and a reload loses nothing", async () => {
  const context = await browser.newContext({ viewport: size, colorScheme: "light" });
  const { page, startMs } = await openStudio(context, server.url);
  console.log("graphics", (await inspect(page)).graphics, "| painting after", startMs, "ms | first frame",
    await page.evaluate(() => Math.round(window.impasto.firstFrame)), "ms after the script");
  await page.keyboard.press("Escape");
  const bare = await inspect(page);
  await penStroke(page, wave(250));
  await rest(page);
  const one = await inspect(page);
  assert.ok(one.revision > bare.revision, "the stroke has changed the painting");
  await penStroke(page, wave(400));
  await rest(page);
  const two = await inspect(page);
  await page.keyboard.press("Control+z");
  await page.waitForFunction((before) => window.impasto.inspect().revision > before, two.revision);
  await page.screenshot({ path: join(out, "light.png") });
  await saved(page, async () => {
    await page.keyboard.press("Control+s");
    await page.waitForFunction(() => window.impasto.inspect().dialog);
    await page.waitForTimeout(300);
    await page.keyboard.press("Enter");
  }, "pen.exr");
  // Painted on, and left without saving.
  await penStroke(page, wave(520));
  await rest(page);
  await page.waitForTimeout(16_000);
  await page.reload();
  await page.waitForFunction(() => window.impasto?.inspect?.()?.revision != null, null, { timeout: 60_000 });
  const after = await inspect(page);
  await page.screenshot({ path: join(out, "recovered.png") });
  assert.equal(after.lost, 1, "the autosave is offered");
  await context.close();
});

test("the page is dark where the system is", async () => {
  const context = await browser.newContext({ viewport: size, colorScheme: "dark" });
  const { page } = await openStudio(context, server.url);
  await page.screenshot({ path: join(out, "dark.png") });
  await context.close();
});

test.after(async () => {
  await browser.close();
  server.close();
});
