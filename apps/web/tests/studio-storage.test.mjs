// The browser's storage: denied, full, or cleared while the page is open, the painter is told once and paints on;
// preferences and autosaves outlive a reload.

import assert from "node:assert/strict";
import { test } from "node:test";
import { fromViewMenu, inspect, openStudio, opened, penStroke, prepared, rest, setUp, stylus, until } from "./studio.mjs";

const stage = setUp();
const origin = () => new URL(stage.server.address).origin;

const stroke = (y) => Array.from({ length: 30 }, (_, at) => [300 + 8 * at, y, 0.3 + 0.01 * at, 10, 10]);

/** A page whose autosaves are 2 s apart, and its pen. */
async function autosaving(context, faults) {
  await prepared(context, stage.server.address, { theme: "light", autosave_seconds: 2 });
  const { page } = await openStudio(context, stage.server.address, faults);
  return { page, pen: await stylus(page) };
}

async function paint(page, pen, y) {
  const { revision } = await inspect(page);
  await pen.stroke(stroke(y));
  await rest(page);
  assert.ok((await inspect(page)).revision > revision, "painting goes on");
}

const notices = (page, part) =>
  inspect(page).then((state) => state.notices.filter((text) => text.includes(part)));

test("a storage that is denied or missing is told once, and painting goes on", async () => {
  for (const denied of [
    () => { navigator.storage.getDirectory = () => Promise.reject(new DOMException("denied", "SecurityError")); },
    () => Object.defineProperty(navigator, "storage", { value: undefined }),
    () => Object.defineProperty(navigator, "locks", { value: undefined }),
    () => { delete FileSystemFileHandle.prototype.createWritable; },
  ]) {
    const context = await stage.context();
    const faults = [];
    await context.addInitScript(denied);
    const { page } = await openStudio(context, stage.server.address, faults);
    await until(page, (state) => state.notices.length > 0);
    const pen = await stylus(page);
    await paint(page, pen, 300);
    await page.waitForTimeout(1000);
    const { notices, hints } = await inspect(page);
    assert.deepEqual(notices, ["No autosaves: this browser denies its storage to the page"], String(denied));
    assert.deepEqual(hints, ["save the painting often: it is downloaded"]);
    assert.deepEqual(faults, [], String(denied));
    await context.close();
  }
});

test("a full storage is told once, painting goes on, and autosaves once there is room", async () => {
  const context = await stage.context();
  const faults = [];
  const { page, pen } = await autosaving(context, faults);
  const cdp = await context.newCDPSession(page);
  await cdp.send("Storage.overrideQuotaForOrigin", { origin: origin(), quotaSize: 20_000 });
  await paint(page, pen, 200);
  await until(page, (state) => state.notices.length > 0);
  const full = "No autosaves: the browser's storage is full";
  assert.deepEqual((await inspect(page)).notices, [full]);
  assert.match((await inspect(page)).hints[0], /save the painting/);
  // Longer than the time until the write is tried again.
  await paint(page, pen, 260);
  await page.waitForTimeout(12_000);
  await paint(page, pen, 320);
  assert.deepEqual((await inspect(page)).notices, [full], "told once");
  await cdp.send("Storage.overrideQuotaForOrigin", { origin: origin() });
  await page.waitForTimeout(9000);
  await page.reload();
  await opened(page);
  await until(page, (state) => state.lost === 1);
  assert.deepEqual(faults, []);
  await context.close();
});

test("a storage that is cleared while the page is open is told once and written anew", async () => {
  const context = await stage.context();
  const faults = [];
  const { page, pen } = await autosaving(context, faults);
  await paint(page, pen, 200);
  await page.waitForTimeout(5000);
  const cdp = await context.newCDPSession(page);
  await cdp.send("Storage.clearDataForOrigin", { origin: origin(), storageTypes: "all" });
  await paint(page, pen, 280);
  await until(page, (state) => state.notices.length > 0);
  await paint(page, pen, 360);
  await page.waitForTimeout(5000);
  const emptied = ["The browser's storage was emptied: the autosave is written anew"];
  assert.deepEqual((await inspect(page)).notices, emptied);
  const { history } = await inspect(page);
  await page.reload();
  await opened(page);
  await until(page, (state) => state.lost === 1);
  // The preferences were written anew, too.
  assert.equal((await inspect(page)).theme, "light");
  await page.mouse.click(786, 69);
  await until(page, (state) => state.lost === 0);
  await rest(page);
  assert.ok(history[0] > 0);
  assert.deepEqual(faults, []);
  await context.close();
});

test("autosaves of a page that ended are kept although the storage is full at the next start", async () => {
  const context = await stage.context();
  const { page, pen } = await autosaving(context);
  await paint(page, pen, 200);
  await page.waitForTimeout(5000);
  const cdp = await context.newCDPSession(page);
  await page.goto("about:blank");
  await cdp.send("Storage.overrideQuotaForOrigin", { origin: origin(), quotaSize: 20_000 });
  await page.goto(stage.server.address);
  await opened(page);
  await until(page, (state) => state.lost === 1 && state.notices.some((text) => text.includes("full")));
  await cdp.send("Storage.overrideQuotaForOrigin", { origin: origin() });
  await page.reload();
  await opened(page);
  await until(page, (state) => state.lost === 1);
  assert.deepEqual(await notices(page, "full"), []);
  await context.close();
});

test("preferences outlive a reload, and hold for the next page", async () => {
  const context = await stage.context({ colorScheme: "light" });
  const { page } = await openStudio(context, stage.server.address);
  assert.equal((await inspect(page)).theme, "system");
  const grey = async (page) => {
    const png = await page.screenshot({ clip: { x: 300, y: 5, width: 40, height: 10 } });
    // The menu bar has one colour: its brightness is read from the page itself.
    return page.evaluate(async (base64) => {
      const picture = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob());
      const pen = new OffscreenCanvas(1, 1).getContext("2d");
      pen.drawImage(picture, 0, 0);
      return pen.getImageData(0, 0, 1, 1).data[1];
    }, png.toString("base64"));
  };
  const light = await grey(page);
  await fromViewMenu(page, "dark", (state) => state.theme === "dark");
  await fromViewMenu(page, "touch", (state) => state.touch_targets);
  const dark = await grey(page);
  assert.ok(dark < light - 80, `the window is dark: ${dark}, ${light}`);
  await page.waitForTimeout(2000);
  await page.reload();
  await opened(page);
  const { theme, touch_targets: large } = await inspect(page);
  assert.deepEqual({ theme, large }, { theme: "dark", large: true });
  assert.equal(await grey(page), dark);
  const { page: next } = await openStudio(context, stage.server.address);
  assert.equal((await inspect(next)).theme, "dark");
  await context.close();
});

test("two pages keep each other's settings", async () => {
  const context = await stage.context({ colorScheme: "light" });
  const [{ page: one }, { page: two }] = [await openStudio(context, stage.server.address), await openStudio(context, stage.server.address)];
  const kept = (page) => page.evaluate(async () => {
    let folder = await navigator.storage.getDirectory();
    for (const name of ["impasto-studio", "settings"]) folder = await folder.getDirectoryHandle(name);
    return Object.keys(JSON.parse(await (await (await folder.getFileHandle("list.json")).getFile()).text()).files);
  }).catch(() => []);
  const holds = async (page, name) => {
    for (let trial = 0; trial < 60 && !(await kept(page)).includes(name); trial++) await page.waitForTimeout(250);
    assert.ok((await kept(page)).includes(name), `${name}: ${await kept(page)}`);
  };
  // Another theme in one page, "Keep" of the panel Brush in the other, another theme in the first again.
  await two.bringToFront();
  await fromViewMenu(two, "dark", (state) => state.theme === "dark");
  await holds(two, "/settings/preferences.json");
  await one.bringToFront();
  await one.mouse.click(1244, 146);
  await holds(one, "/settings/swatches.json");
  await two.bringToFront();
  await fromViewMenu(two, "light", (state) => state.theme === "light");
  await two.waitForTimeout(3000);
  await holds(two, "/settings/preferences.json");
  assert.ok((await kept(two)).includes("/settings/swatches.json"), "the mixture of the other page is kept");
  await context.close();
});

/** When the browser's storage took the newest painting of a page, in ms; 0 if it has none. */
const newest = (page) => page.evaluate(async () => {
  let last = 0;
  const folder = await (await navigator.storage.getDirectory()).getDirectoryHandle("impasto-studio");
  for await (const [name, pages] of folder) {
    if (!name.startsWith("page-")) continue;
    const { files } = JSON.parse(await (await (await pages.getFileHandle("list.json")).getFile()).text());
    for (const [path, kept] of Object.entries(files)) {
      if (!path.endsWith(".exr")) continue;
      last = Math.max(last, (await (await pages.getFileHandle(kept)).getFile()).lastModified);
    }
  }
  return last;
}).catch(() => 0);

/** Waits until `condition` of the newest painting holds. */
async function kept(page, condition) {
  for (let trial = 0; trial < 40 && !condition(await newest(page)); trial++) await page.waitForTimeout(500);
  assert.ok(condition(await newest(page)), "an autosave is written");
}

test("an autosave waits for the end of a short stroke, and not for that of a long one", async () => {
  const context = await stage.context({ colorScheme: "light" });
  const { page, pen } = await autosaving(context, []);
  const along = (y) => Array.from({ length: 100 }, (_, at) => [300 + 5 * at, y, 0.5]);
  await paint(page, pen, 200);
  await kept(page, (last) => last > 0);
  for (const [seconds, y, waits] of [[5.5, 300, true], [16, 350, false]]) {
    await page.waitForTimeout(3000);
    const before = await newest(page);
    const stroke = penStroke(page, along(y), { everyMs: 10 * seconds });
    await page.waitForTimeout(1000 * (seconds - 1));
    assert.ok((await inspect(page)).stroke_open, "the pen is down");
    assert.equal((await newest(page)) === before, waits, `in a stroke of ${seconds} s`);
    await stroke;
    await kept(page, (last) => last > before);
  }
  await context.close();
});
