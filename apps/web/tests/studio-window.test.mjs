// The studio in a browser: paints with a pen, undoes, saves, is reloaded and offers what was not saved. The program
// shows the painting under another light.

import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { join, resolve } from "node:path";
import { test } from "node:test";
import { pictures, program } from "./browser.mjs";
import { inspect, openStudio, opened, penStroke, rest, setUp } from "./studio.mjs";

const stage = setUp();

/** A wavy stroke of a pen whose pressure changes, `y` px below the top. */
const wave = (y, count = 60) => Array.from({ length: count }, (_, at) =>
  [330 + 6 * at, y + 30 * Math.sin(at / 6), 0.25 + 0.6 * Math.abs(Math.sin(at / 9))]);

/** Does `act`, which downloads a file, and keeps the file as `name`. */
async function saved(page, act, name) {
  const download = page.waitForEvent("download", { timeout: 120_000 });
  await act();
  const path = join(stage.folder, name);
  await (await download).saveAs(path);
  return path;
}

const shown = (page, name) => page.screenshot({ path: resolve(pictures, `studio-${name}.png`) });

test("a pen paints with pressure, undo takes a stroke back, and a reload loses nothing", async () => {
  const context = await stage.context({ colorScheme: "light" });
  const faults = [];
  const { page } = await openStudio(context, stage.server.address, faults);
  await page.keyboard.press("Escape");
  const bare = await inspect(page);
  await penStroke(page, wave(250));
  await rest(page);
  const one = await inspect(page);
  assert.ok(one.revision > bare.revision, "the stroke has changed the painting");
  await penStroke(page, wave(400));
  await rest(page);
  const two = await inspect(page);
  assert.ok(two.revision > one.revision, "and so has the second");
  await page.keyboard.press("Control+z");
  await page.waitForFunction((before) => window.impasto.inspect().revision > before, two.revision);
  await rest(page);
  await shown(page, "light");
  const painting = await saved(page, async () => {
    await page.keyboard.press("Control+s");
    await page.waitForFunction(() => window.impasto.inspect().dialog);
    await page.waitForTimeout(300);
    await page.keyboard.press("Enter");
  }, "pen.exr");
  program(stage.folder, "relight", painting, "--illuminant", "A", "-o", "pen.png");
  assert.ok(statSync(join(stage.folder, "pen.png")).size > 10_000, "the program shows it under another light");
  // Painted on, and left without saving.
  await penStroke(page, wave(520));
  await rest(page);
  await page.waitForTimeout(16_000);
  await page.reload();
  await opened(page);
  await page.waitForFunction(() => window.impasto.inspect().lost === 1, null, { timeout: 30_000 });
  await shown(page, "lost");
  // The button Recover of the offer, at the top of the canvas.
  await page.mouse.click(786, 69);
  await page.waitForFunction(() => window.impasto.inspect().lost === 0, null, { timeout: 60_000 });
  await rest(page);
  await shown(page, "recovered");
  assert.deepEqual(faults, [], "nothing is wrong in the browser's console");
  await context.close();
});

test("the page is dark where the system is", async () => {
  const context = await stage.context({ colorScheme: "dark" });
  const { page } = await openStudio(context, stage.server.address);
  await shown(page, "dark");
  await context.close();
});

test("a window as narrow as a phone shows the canvas, and the panels where they are asked for", async () => {
  const context = await stage.context({ viewport: { width: 390, height: 844 }, colorScheme: "light" });
  const { page } = await openStudio(context, stage.server.address);
  await page.keyboard.press("Escape");
  const { corners: [[left, top], [right, bottom]] } = await inspect(page);
  assert.ok(right - left > 0.6 * 390, `the canvas is ${right - left} px wide`);
  assert.ok(left >= 0 && right <= 390 && top >= 0 && bottom <= 844, "and within the window");
  const seen = () => page.screenshot({ clip: { x: 60, y: 60, width: 320, height: 300 } });
  const canvas = await seen();
  await page.mouse.click(368, 13);
  await page.waitForTimeout(1000);
  assert.ok(!(await seen()).equals(canvas), "the panels cover the canvas");
  await shown(page, "phone-panels");
  const { revision } = await inspect(page);
  await penStroke(page, Array.from({ length: 20 }, (_, at) => [left + 20 + 6 * at, (top + bottom) / 2, 0.6]));
  await rest(page);
  assert.equal((await inspect(page)).revision, revision, "nothing is painted through them");
  await page.mouse.click(368, 13);
  await page.waitForTimeout(1000);
  await penStroke(page, Array.from({ length: 20 }, (_, at) => [left + 20 + 6 * at, (top + bottom) / 2, 0.6]));
  await rest(page);
  assert.ok((await inspect(page)).revision > revision, "the canvas is painted");
  await shown(page, "phone");
  await context.close();
});
