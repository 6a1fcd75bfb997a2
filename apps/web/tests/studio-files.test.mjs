// Files in the page: dropped, chosen, refused, exported.

import assert from "node:assert/strict";
import { closeSync, ftruncateSync, openSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { test } from "node:test";
import { program, root } from "./browser.mjs";
import { confirmed, dialog, inspect, openStudio, rest, setUp, stylus, until } from "./studio.mjs";

const stage = setUp();

/** Drops files of this machine on the page, as a hand does. */
async function drop(page, ...files) {
  const cdp = await page.context().newCDPSession(page);
  const data = { items: [], files, dragOperationsMask: 1 };
  for (const type of ["dragEnter", "dragOver", "drop"]) {
    await cdp.send("Input.dispatchDragEvent", { type, x: 500, y: 300, data });
  }
}

/** A small painting that the program made. */
function painting() {
  const script = {
    format: "strokes", version: 1, title: "A study", licence: "CC0-1.0",
    canvas: { width_mm: 24, height_mm: 16, cell_mm: 0.2, ground: { kind: "linen" } },
    palette: ["Zinc White", "Prussian Blue"], brushes: { big: { shape: "flat", size_mm: 8 } },
    actions: [
      { load: { brush: "big", recipe: { "Prussian Blue": 1 }, amount_mm: 0.3 } },
      { stroke: { brush: "big", samples: [[0, 4, 8, 0.6], [1, 20, 8, 0.6]] } },
    ],
  };
  writeFileSync(join(stage.folder, "study.json"), JSON.stringify(script));
  program(stage.folder, "paint", "study.json", "-o", "study.exr");
  return join(stage.folder, "study.exr");
}

test("a painting that is dropped on the page is opened, and exported as the program's PNG", async () => {
  const context = await stage.context({ colorScheme: "light" });
  const faults = [];
  const { page } = await openStudio(context, stage.server.address, faults);
  await drop(page, painting());
  await until(page, (state) => state.title === "study");
  assert.deepEqual((await inspect(page)).cells, [120, 80]);
  assert.equal(page.url(), stage.server.address, "the browser itself did not open it");
  const png = await confirmed(page, stage.folder, () => page.keyboard.press("Control+e"));
  program(stage.folder, "relight", "study.exr", "-o", "native.png");
  assert.ok(readFileSync(png).equals(readFileSync(join(stage.folder, "native.png"))), "the same PNG, byte for byte");
  assert.deepEqual(faults, []);
  await context.close();
});

test("a library that is dropped on the page begins a painting with its pigments", async () => {
  const context = await stage.context();
  const faults = [];
  const { page } = await openStudio(context, stage.server.address, faults);
  const before = await inspect(page);
  const library = JSON.parse(readFileSync(resolve(root, "measurements/van-gogh-oils.pigments.json")));
  writeFileSync(join(stage.folder, "mine.json"), JSON.stringify({ ...library, title: "My oils" }));
  await drop(page, join(stage.folder, "mine.json"));
  await until(page, (state) => state.pigments === "My oils");
  assert.notEqual(before.pigments, "My oils");
  assert.deepEqual((await inspect(page)).history, [0, 0], "a bare canvas");
  assert.deepEqual(faults, []);
  await context.close();
});

test("bad files are refused with the way out, and painting goes on", async () => {
  const context = await stage.context();
  const faults = [];
  const { page } = await openStudio(context, stage.server.address, faults);
  writeFileSync(join(stage.folder, "cut.exr"), readFileSync(painting()).subarray(0, 3000));
  writeFileSync(join(stage.folder, "list.txt"), "a shopping list");
  for (const [name, part] of [["cut.exr", "cut.exr"], ["list.txt", "list.txt"]]) {
    await drop(page, join(stage.folder, name));
    await until(page, (state, part) => state.notices.some((text) => text.includes(part)), part);
  }
  const { notices, hints } = await inspect(page);
  assert.equal(notices.length, 2, String(notices));
  assert.equal(hints.length, 2, "each with the way out");
  const pen = await stylus(page);
  const { revision } = await inspect(page);
  await pen.stroke([[300, 400, 0.5], [400, 420, 0.6], [500, 400, 0.5]]);
  await rest(page);
  assert.ok((await inspect(page)).revision > revision);
  assert.deepEqual(faults, []);
  await context.close();
});

test("a file too large for the memory of a page is refused before it is read", async () => {
  const context = await stage.context();
  await context.addInitScript(() => {
    window.filesRead = 0;
    for (const name of ["arrayBuffer", "bytes", "text", "stream"]) {
      const reads = Blob.prototype[name];
      if (reads) Blob.prototype[name] = function (...given) { window.filesRead += 1; return reads.apply(this, given); };
    }
  });
  const { page } = await openStudio(context, stage.server.address);
  const sparse = (name, bytes) => {
    const file = openSync(join(stage.folder, name), "w");
    ftruncateSync(file, bytes);
    closeSync(file);
    return join(stage.folder, name);
  };
  const before = await page.evaluate(() => window.filesRead);
  await drop(page, sparse("huge.exr", 513 * 2 ** 20));
  await until(page, (state) => state.notices.length === 1);
  await drop(page, sparse("huge.json", 257 * 2 ** 20));
  await until(page, (state) => state.notices.length === 2);
  const { notices, hints } = await inspect(page);
  assert.deepEqual(notices, ["Huge.exr: has 537.9 MB; a page takes at most 536.9 MB", "Huge.json: has 269.5 MB; a page takes at most 268.4 MB"]);
  assert.deepEqual(new Set(hints), new Set(["open it in the program impasto-studio"]));
  assert.equal(await page.evaluate(() => window.filesRead), before, "no byte was read");
  // One that fits is read.
  await drop(page, painting());
  await until(page, (state) => state.title === "study");
  assert.ok((await page.evaluate(() => window.filesRead)) > before);
  await context.close();
});

test("the browser's own dialog opens a file", async () => {
  const context = await stage.context();
  const faults = [];
  const { page } = await openStudio(context, stage.server.address, faults);
  const choosing = page.waitForEvent("filechooser", { timeout: 60_000 });
  // The browser must know first that the test takes its dialog.
  await page.evaluate(() => document.hasFocus());
  await dialog(page, () => page.keyboard.press("Control+o"));
  // Where the frame came too late for the browser, its dialog opens at the next press.
  await page.mouse.click(640, 5);
  const chooser = await choosing;
  assert.match(await chooser.element().getAttribute("accept"), /\.exr/);
  await chooser.setFiles(painting());
  await until(page, (state) => state.title === "study" && !state.dialog);
  assert.deepEqual(faults, []);
  await context.close();
});
