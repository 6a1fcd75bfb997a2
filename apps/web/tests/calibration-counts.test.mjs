// Raw counts in the calibration page: white, dark and tile make the program's library of them, and are refused as there.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, afterEach, before, beforeEach, test } from "node:test";
import { launched, pictures, program, root, served } from "./browser.mjs";
import { dropped, same, savedBy } from "./calibration.mjs";
import { counts } from "./files.mjs";

const PIGMENTS = ["Zinc White", "Cobalt Blue", "Ultramarine", "Prussian Blue"];
const given = counts(readFileSync(resolve(root, "measurements/van-gogh-oils.csv"), "utf8"), PIGMENTS);
const names = given.files.map((file) => file.name);

let server, browser, context, page, folder, faults;

before(async () => {
  server = await served("calibration");
  browser = await launched();
  folder = mkdtempSync(join(tmpdir(), "impasto-counts-"));
  const texts = [...given.files.map(({ name, bytes }) => [name, bytes]), ...Object.entries(given.references), ["recipes.csv", given.recipes]];
  for (const [name, text] of texts) writeFileSync(join(folder, name), text);
});

after(async () => {
  await browser?.close();
  server?.end();
  rmSync(folder, { recursive: true, force: true });
});

beforeEach(async () => {
  context = await browser.newContext({ viewport: { width: 1280, height: 1000 } });
  page = await context.newPage();
  page.setDefaultTimeout(60_000);
  faults = [];
  page.on("pageerror", (error) => faults.push(String(error)));
  await page.goto(server.address);
  await page.locator("#fit-options summary").click();
  await page.locator("#fit-counts summary").click();
  await page.locator("#o-recipes").setInputFiles(join(folder, "recipes.csv"));
  await page.locator("#o-method").evaluate((list) => { list.value = "weighted"; });
});

afterEach(async () => {
  assert.deepEqual(faults, []);
  await context.close();
});

const choose = (label, ...files) => page.locator("#fit").getByLabel(label, { exact: true }).setInputFiles(files.map((name) => join(folder, name)));
const notice = () => page.locator("#notice").innerText();

/** What the program refuses: its message. */
function refused(...words) {
  try {
    program(folder, "fit", ...words);
  } catch (error) {
    return String(error).match(/error: (.*)/)[1];
  }
  return assert.fail("the program takes it");
}

async function library() {
  await page.locator("#fit-start:enabled").click();
  await page.locator("#fit-result").waitFor();
  return (await savedBy(page, page.getByRole("button", { name: "Download library" }))).text;
}

const reads = (count) => page.locator("#readings-told", { hasText: `${count} readings` }).waitFor();

test("raw counts give the program's library, byte for byte, with the tile as a number and as a file", async () => {
  await choose("White reading", "white.txt");
  await choose("Dark readings", "dark.txt");
  await page.locator("#fit").getByLabel("Reflectance of the white", { exact: true }).fill(String(given.tile));
  await page.locator("#fit").getByLabel("Reflectance of the white", { exact: true }).press("Tab");
  await dropped(page, "#readings-drop", given.files);
  await reads(names.length);
  const words = ["--recipes", "recipes.csv", "--method", "weighted", "--white-reading", "white.txt", "--dark-reading", "dark.txt"];
  assert.ok(await page.locator("#readings-told li").first().isHidden(), "a remark on each file is folded");
  await page.locator("#readings-told summary").click();
  assert.equal(await page.locator("#readings-told li").count(), names.length);
  assert.ok(await page.locator("#readings-told li").first().isVisible());
  await page.locator("#readings-told summary").click();
  program(folder, "fit", ...names, ...words, "--tile", String(given.tile), "-o", "number.json");
  same(await library(), readFileSync(join(folder, "number.json"), "utf8"));
  await page.screenshot({ path: resolve(pictures, "calibration-counts.png"), fullPage: true });

  await page.locator("#fit").getByLabel("Reflectance of the white", { exact: true }).fill("");
  await choose("or its file", "tile.csv");
  await dropped(page, "#readings-drop", given.files);
  await page.locator("#fit-result").waitFor({ state: "hidden" });
  await reads(names.length);
  program(folder, "fit", ...names, ...words, "--tile", "tile.csv", "-o", "file.json");
  same(await library(), readFileSync(join(folder, "file.json"), "utf8"));
});

test("counts are refused as the program refuses them, in the words of the page", async () => {
  const start = [...names, "--recipes", "recipes.csv"];
  await dropped(page, "#readings-drop", given.files);
  await page.locator("#notice").waitFor();
  assert.ok((await notice()).includes(refused(...start)), await notice());
  assert.match(await notice(), /"White reading" "Dark readings"/, "the way out names the fields");

  // A dark alone.
  await choose("Dark readings", "dark.txt");
  await page.locator("#notice", { hasText: "needs the white reading of the same counts" }).waitFor();
  refused(...start, "--dark-reading", "dark.txt");

  // A white that is no file of an instrument.
  writeFileSync(join(folder, "note.txt"), "a shopping list\n");
  await choose("White reading", "note.txt");
  await page.locator("#notice", { hasText: "note.txt" }).waitFor();
  const message = refused(...start, "--white-reading", "note.txt", "--dark-reading", "dark.txt");
  assert.ok((await notice()).includes(message), `${message}: ${await notice()}`);

  // A white without light, and counts of a saturated detector.
  for (const [name, count] of [["weak.txt", 211], ["full.txt", 65_535]]) {
    writeFileSync(join(folder, name), given.references["white.txt"].replaceAll(/ .*/g, ` ${count}`));
    await choose("White reading", name);
    const message = refused(...start, "--white-reading", name, "--dark-reading", "dark.txt");
    await page.locator("#notice", { hasText: message }).waitFor();
    assert.doesNotMatch(await notice(), /\[|--/, "the way out is one of the page");
  }

  await choose("White reading", "white.txt");
  for (const tile of ["0", "1.3"]) {
    await page.locator("#fit").getByLabel("Reflectance of the white", { exact: true }).fill(tile);
    await page.locator("#fit").getByLabel("Reflectance of the white", { exact: true }).press("Tab");
    const message = refused(...start, "--white-reading", "white.txt", "--dark-reading", "dark.txt", "--tile", tile);
    await page.locator("#notice", { hasText: message }).waitFor();
  }
  await page.locator("#fit").getByLabel("Reflectance of the white", { exact: true }).fill("");
  await page.locator("#fit").getByLabel("Reflectance of the white", { exact: true }).press("Tab");
  await reads(names.length);
});

test("one of several spectra in a file is the white, by its name", async () => {
  const both = given.references["white.txt"].trim().split("\n").map((line, at) => {
    const [nm, white] = line.split(" ");
    return `${nm},${given.references["dark.txt"].trim().split("\n")[at].split(" ")[1]},${white}`;
  });
  writeFileSync(join(folder, "both.csv"), `nm,dark,white\n${both.join("\n")}\n`);
  const words = ["--recipes", "recipes.csv", "--method", "weighted", "--white-reading"];
  await choose("White reading", "both.csv");
  await choose("Dark readings", "dark.txt");
  await dropped(page, "#readings-drop", given.files);
  const message = refused(...names, ...words, "both.csv", "--dark-reading", "dark.txt");
  await page.locator("#notice", { hasText: message }).waitFor();
  const field = page.locator("#fit").getByLabel("Spectra in them");
  await field.fill("other.csv#white");
  await field.press("Tab");
  await page.locator("#notice", { hasText: "names a spectrum of no file" }).waitFor();
  await field.fill("both.csv#white");
  await field.press("Tab");
  await reads(names.length);
  program(folder, "fit", ...names, ...words, "both.csv#white", "--dark-reading", "dark.txt", "-o", "named.json");
  same(await library(), readFileSync(join(folder, "named.json"), "utf8"));
});
