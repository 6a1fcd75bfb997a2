// A stylus with pressure, tilt and rotation paints in the page; the program replays the recording to the same bits.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { test } from "node:test";
import { pictures, program } from "./browser.mjs";
import { confirmed, fromFileMenu, inspect, openStudio, rest, setUp, stylus, until } from "./studio.mjs";

const stage = setUp();

/** A wavy stroke `y` px below the top, whose pressure, tilt and rotation change. */
const wave = (y, phase) => Array.from({ length: 50 }, (_, at) => [
  250 + 9 * at, y + 25 * Math.sin(at / 5), 0.2 + 0.7 * Math.abs(Math.sin(at / 9 + phase)),
  Math.round(40 * Math.sin(at / 11)), Math.round(30 * Math.cos(at / 7 + phase)), (3 * at) % 360,
]);

/** The canvas as it is shown, with the pointer away from it. */
async function seen(page) {
  await page.mouse.move(640, 5);
  await page.waitForTimeout(400);
  const clip = { x: 95, y: 55, width: 840, height: 400 };
  // The last parts of the picture may come after the paint rests.
  for (let last, tries = 0; ; tries++) {
    const shot = (await page.screenshot({ clip })).toString("base64");
    if (shot === last || tries === 20) return shot;
    last = shot;
    await page.waitForTimeout(300);
  }
}

test("strokes with pressure, tilt and rotation, undo, redo and light: the program replays them to the bit", async () => {
  const context = await stage.context({ colorScheme: "light" });
  const faults = [];
  const { page } = await openStudio(context, stage.server.address, faults);
  // The first stroke ends the first steps.
  const pen = await stylus(page);
  await pen.stroke(wave(180, 0));
  await rest(page);
  const one = await seen(page);
  const done = (await inspect(page)).history[0];
  await pen.stroke(wave(300, 1));
  await rest(page);
  const two = await seen(page);
  assert.notEqual(one, two, "the second stroke is seen");
  assert.deepEqual((await inspect(page)).history, [done + 1, done + 1]);

  await page.keyboard.press("Control+z");
  await until(page, (state, done) => state.history[0] === done, done);
  await rest(page);
  assert.equal(await seen(page), one, "undo shows the canvas before the stroke, to the pixel");
  await page.keyboard.press("Control+y");
  await until(page, (state, done) => state.history[0] === done + 1, done);
  await rest(page);
  assert.equal(await seen(page), two, "redo shows the stroke again");
  await page.keyboard.press("Control+z");
  await until(page, (state, done) => state.history[0] === done, done);
  await pen.stroke(wave(380, 2));
  await rest(page);

  // The list of lights in the panel Light.
  const daylight = await seen(page);
  await page.mouse.click(1130, 590);
  await page.waitForTimeout(400);
  await page.keyboard.type("A");
  await page.waitForTimeout(200);
  await page.keyboard.press("Enter");
  await until(page, (state) => state.light === "A");
  await rest(page);
  assert.notEqual(await seen(page), daylight, "the light changes the picture");
  await page.screenshot({ path: resolve(pictures, "studio-lamp.png") });

  const painting = await confirmed(page, stage.folder, () => page.keyboard.press("Control+s"));
  const recording = await confirmed(page, stage.folder, (trial) => fromFileMenu(page, "saveRecording", trial));
  const script = JSON.parse(readFileSync(recording));
  const strokes = script.actions.flatMap((action) => action.stroke ?? []);
  assert.equal(strokes.length, 3, "the stroke that was undone is recorded as well");
  for (const { samples } of strokes) {
    // Time, x, y, pressure, tilt along x and y, rotation.
    const different = [3, 4, 5, 6].map((column) => new Set(samples.map((sample) => sample[column])).size);
    assert.ok(different.every((count) => count > 10), `samples have all that the stylus tells: ${different}`);
  }
  // Both files are written by the program from its own memory, so that bytes can be compared.
  program(stage.folder, "relight", painting, "-o", "page.exr");
  program(stage.folder, "paint", recording, "-o", "native.exr");
  const [page_, native] = ["page.exr", "native.exr"].map((name) => readFileSync(join(stage.folder, name)));
  assert.ok(page_.equals(native), "the painting of the page is the one that the program replays, byte for byte");
  assert.deepEqual(faults, [], "nothing is wrong in the browser's console");
  await context.close();
});

test("while a stylus paints, its stroke is shown between frames by a small part, and by frames when it ends", async () => {
  const context = await stage.context({ colorScheme: "light" });
  const faults = [];
  const { page } = await openStudio(context, stage.server.address, faults);
  await page.keyboard.press("Escape");
  await page.waitForTimeout(1000);
  const parts = await page.evaluate(async () => {
    const canvas = document.getElementById("studio");
    const part = document.getElementById("between");
    const send = (type, x, pressure) => canvas.dispatchEvent(new PointerEvent(type, {
      bubbles: true, cancelable: true, pointerType: "pen", pointerId: 7, isPrimary: true, clientX: x, clientY: 250,
      pressure, button: type === "pointermove" ? -1 : 0, buttons: pressure > 0 ? 1 : 0,
    }));
    const frame = () => new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
    send("pointermove", 300, 0);
    await frame();
    send("pointerdown", 300, 0.6);
    let seen = 0;
    let box = null;
    for (let x = 300; x < 600; x += 3) {
      send("pointermove", x, 0.6);
      await frame();
      if (part.hidden) continue;
      seen += 1;
      box = part.getBoundingClientRect().toJSON();
    }
    send("pointerup", 600, 0);
    return { seen, box };
  });
  assert.ok(parts.seen > 20, `it was seen ${parts.seen} times`);
  assert.ok(parts.box.width <= 640 && parts.box.height <= 384, `it is small: ${JSON.stringify(parts.box)}`);
  await rest(page);
  await until(page, (state) => !state.stroke_open);
  await page.waitForFunction(() => document.getElementById("between").hidden);
  assert.ok((await inspect(page)).history[0] > 0);
  assert.deepEqual(faults, [], "nothing is wrong in the browser's console");
  await context.close();
});

test("a browser that reports the pressure 0.5 for every pen: it follows from the speed, and that is told once", async () => {
  const context = await stage.context({ colorScheme: "light" });
  const { page } = await openStudio(context, stage.server.address);
  const pen = await stylus(page);
  for (const y of [200, 300]) {
    // Ever faster, with the constant pressure and an upright pen.
    await pen.stroke(Array.from({ length: 40 }, (_, at) => [200 + 0.4 * at * at, y, 0.5]));
    await rest(page);
  }
  const told = "This browser reports no pressure of the pen: it follows from the speed, as with a mouse";
  assert.deepEqual((await inspect(page)).notices, [told], "told once");
  await page.screenshot({ path: resolve(pictures, "studio-no-pressure.png") });
  const recording = await confirmed(page, stage.folder, (trial) => fromFileMenu(page, "saveRecording", trial));
  const strokes = JSON.parse(readFileSync(recording)).actions.flatMap((action) => action.stroke ?? []);
  for (const { samples } of strokes) {
    const pressures = samples.map((sample) => sample[3]);
    assert.ok(new Set(pressures).size > 5, `the pressure follows from the speed: ${pressures}`);
  }
  await context.close();
});
