// How the studio starts where a browser lacks something, and what is told when it ends by an error.

import assert from "node:assert/strict";
import { resolve } from "node:path";
import { after, afterEach, before, test } from "node:test";
import { pictures } from "./browser.mjs";
import { WEBGL, inspect, launch, openStudio, penStroke, prepared, recover, rest, serve, until } from "./studio.mjs";

let server;
const browsers = [];

before(async () => { server = await serve(); });

after(async () => {
  for (const browser of browsers) await browser.close();
  server?.end();
});

// Also of a test that failed.
afterEach(async () => {
  for (const context of browsers.flatMap((browser) => browser.contexts())) await context.close();
});

async function browserWith(flags) {
  const browser = await launch(flags);
  browsers.push(browser);
  return browser;
}

/** Waits until the browser's storage has an autosave of the page. */
async function autosaved(page) {
  const saved = () => page.evaluate(async () => {
    const folder = await (await navigator.storage.getDirectory()).getDirectoryHandle("impasto-studio");
    for await (const [name, handle] of folder) {
      if (!name.startsWith("page-")) continue;
      const list = await (await handle.getFileHandle("list.json")).getFile();
      if (Object.keys(JSON.parse(await list.text()).files).some((path) => path.endsWith(".exr"))) return true;
    }
    return false;
  }).catch(() => false);
  for (let trial = 0; trial < 60 && !(await saved()); trial++) await page.waitForTimeout(500);
  assert.ok(await saved(), "the painting is autosaved");
}

/** Opens the page, which does not start, and returns its text. */
async function told(context, prepare = () => {}) {
  const page = await context.newPage();
  await prepare(page);
  await page.goto(server.address);
  await page.locator("#loading").waitFor({ state: "hidden", timeout: 60_000 });
  assert.ok(await page.locator("#message").isVisible());
  return { page, text: await page.locator("#text").innerText() };
}

test("a browser with neither WebGPU nor WebGL 2 is told what is missing, in its language", async () => {
  const browser = await browserWith(["--disable-3d-apis"]);
  for (const [locale, missing, way] of [
    ["en-GB", "neither WebGPU nor WebGL 2", "hardware acceleration"],
    ["de-AT", "weder WebGPU noch WebGL 2", "Hardwarebeschleunigung"],
  ]) {
    const context = await browser.newContext({ locale });
    const { page, text } = await told(context);
    assert.ok(text.includes(missing) && text.includes(way), text);
    assert.equal(await page.locator("#message").getAttribute("role"), "status", "a screen reader reads it");
    assert.equal(await page.evaluate(() => window.impasto.page), undefined, "the studio did not start");
    await page.screenshot({ path: resolve(pictures, `studio-no-graphics-${locale}.png`) });
    await context.close();
  }
});

test("with WebGL 2 alone the studio opens, paints and shows it", async () => {
  const browser = await browserWith(WEBGL);
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, colorScheme: "light" });
  const faults = [];
  const { page } = await openStudio(context, server.address, faults);
  assert.equal(await page.evaluate(async () => navigator.gpu?.requestAdapter() ?? null), null, "there is no WebGPU");
  const bare = await inspect(page);
  assert.equal(bare.graphics, "WebGL 2");
  assert.deepEqual(bare.notices, []);
  const clip = { x: 400, y: 200, width: 200, height: 100 };
  const before = await page.screenshot({ clip });
  await penStroke(page, Array.from({ length: 40 }, (_, at) => [350 + 8 * at, 250, 0.6]));
  await rest(page);
  await page.mouse.move(640, 5);
  await page.waitForTimeout(400);
  assert.ok(!(await page.screenshot({ clip })).equals(before), "the stroke is seen");
  await page.screenshot({ path: resolve(pictures, "studio-webgl.png") });
  assert.deepEqual(faults, [], "nothing is wrong in the browser's console");
  await context.close();
});

test("a browser that does not know the module, and a module that is not there, are told in plain words", async () => {
  const browser = await browserWith();
  const context = await browser.newContext();
  const given = (answer) => (page) => page.route("**/*.wasm", answer);
  const headers = { "content-type": "application/wasm" };
  // The head of a module, then a section that no browser knows.
  const body = Buffer.from([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0, 0x7f, 1, 0]);
  const unknown = await told(context, given((route) => route.fulfill({ headers, body })));
  assert.match(unknown.text, /does not know the instructions .* Use a newer browser/);
  const missing = await told(context, given((route) => route.fulfill({ status: 404, body: "" })));
  assert.match(missing.text, /^The studio cannot start: .*404/);
  assert.ok(await missing.page.getByRole("button", { name: "Load again" }).isVisible());
  await context.close();
});

test("when the studio ends by an error the painter is told, and the page loaded again offers the painting", async () => {
  const browser = await browserWith();
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  await prepared(context, server.address, { theme: "light", autosave_seconds: 2 });
  const { page } = await openStudio(context, server.address);
  await penStroke(page, Array.from({ length: 40 }, (_, at) => [350 + 8 * at, 250, 0.6]));
  await rest(page);
  await autosaved(page);
  assert.ok(await page.locator("#message").isHidden());
  // The end of an endless turn is beyond all times, so the module panics.
  await page.evaluate(() => setTimeout(() => window.impasto.page.turn(Infinity)));
  await page.locator("#text", { hasText: "has ended by an error" }).waitFor();
  assert.match(await page.locator("#text").innerText(), /What was autosaved is offered when the page is loaded again/);
  await page.screenshot({ path: resolve(pictures, "studio-ended.png") });
  const again = page.getByRole("button", { name: "Load again" });
  assert.ok(await again.evaluate((button) => button === document.activeElement), "the keyboard reaches it");
  await again.click();
  await page.waitForFunction(() => window.impasto?.inspect?.()?.lost === 1, null, { timeout: 60_000 });
  await recover(page);
  // The stroke is there again, once the painting is read.
  await until(page, (state) => state.history?.[0] > 0);
  await context.close();
});
