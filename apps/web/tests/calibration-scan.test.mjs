// Maps of scans in the calibration page, compared with those of the program.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, afterEach, before, beforeEach, test } from "node:test";
import { launched, pictures, program, root, served } from "./browser.mjs";
import { dropped, freshPage, savedBy } from "./calibration.mjs";
import { envi, painted } from "./scans.mjs";

const library = resolve(root, "measurements/van-gogh-oils.pigments.json");

let server, browser, context, page, folder, faults, asked, simulated;

before(async () => {
  server = await served("calibration");
  browser = await launched();
  folder = mkdtempSync(join(tmpdir(), "impasto-scan-"));
  simulated = painted();
});

after(async () => {
  await browser?.close();
  server?.end();
  rmSync(folder, { recursive: true, force: true });
});

beforeEach(async () => {
  ({ context, page, faults } = await freshPage(browser, 900, 60_000));
  asked = [];
  page.on("request", (request) => asked.push(new URL(request.url()).pathname));
  await page.goto(server.address);
});

afterEach(async () => {
  assert.deepEqual(faults, [], "nothing is wrong in the browser's console");
  await context.close();
});

const notice = () => page.locator("#notice");
const drop = (files) => dropped(page, "#scan-drop", files);
const ready = () => page.locator("#scan-start:enabled").waitFor();

// Writes a scan for the program, and returns the same files for the page.
function scan(name, options, of = simulated) {
  const { header, data } = envi(of, options);
  const files = [{ name: `${name}.hdr`, bytes: header }, { name: `${name}.img`, bytes: data }];
  for (const file of files) writeFileSync(join(folder, file.name), file.bytes);
  return files;
}

async function map() {
  await page.locator("#scan-start").click();
  await page.locator("#scan-result").waitFor();
  await page.locator("#busy").waitFor({ state: "hidden" });
}

// The error and the way out that the program tells.
function refused(...words) {
  const ended = spawnSync(process.env.IMPASTO ?? resolve(root, "target/debug/impasto"), words, { cwd: folder, encoding: "utf8" });
  assert.notEqual(ended.status, 0, words.join(" "));
  return ended.stderr.match(/error: (.*)/)[1];
}

const rounded = (value) => (typeof value === "number" ? Number(value.toPrecision(6)) : value);
const near = (value) => JSON.parse(JSON.stringify(value), (_, one) => rounded(one));

test("maps, pictures and spots of a small scan are the program's, and its module comes when it is asked for", async (t) => {
  assert.ok(!asked.some((path) => path.includes("/maps/")), "the page loads without the module of scans");
  await page.locator("#tab-scan").click();
  const files = scan("small", { type: 4, more: ["data ignore value = -1"] });
  await drop(files);
  await ready();
  assert.match(await page.locator("#scan-told").innerText(), /small\.hdr: 48 x 64 pixels, \d+ bands from 400 to \d+ nm/);
  const begun = performance.now();
  await map();
  t.diagnostic(`mapped in ${((performance.now() - begun) / 1000).toFixed(1)} s`);
  assert.ok(asked.some((path) => path.endsWith("/maps/impasto_web_scan_bg.wasm")));
  const text = program(folder, "map", "small.hdr", library, "-o", "small.zarr", "--pictures", "small", "--spot", "10..13,9..12", "--json");
  const wanted = JSON.parse(text);
  const found = JSON.parse((await savedBy(page, page.getByRole("button", { name: "Download JSON" }))).text);
  const [spot] = wanted.spots;
  for (const key of ["truth", "spots"]) {
    delete wanted[key];
    delete found[key];
  }
  assert.deepEqual(found, wanted, "value for value, and the survey by its hash");
  const links = page.locator("#scan-maps a");
  assert.ok((await links.count()) >= 8, "pictures of several pigments");
  for (const link of await links.all()) {
    const name = await link.getAttribute("download");
    const url = `data:image/png;base64,${readFileSync(join(folder, "small", name)).toString("base64")}`;
    const apart = await page.evaluate(async ([found, wanted]) => {
      const drawn = await Promise.all([found, wanted].map(async (src) => {
        const image = Object.assign(new Image(), { src });
        await image.decode();
        const area = new OffscreenCanvas(image.width, image.height).getContext("2d");
        area.drawImage(image, 0, 0);
        return [image.width, image.height, ...area.getImageData(0, 0, image.width, image.height).data];
      }));
      return drawn[0].filter((value, place) => value !== drawn[1][place]).length + Math.abs(drawn[0].length - drawn[1].length);
    }, [await link.getAttribute("href"), url]);
    assert.equal(apart, 0, `${name}, pixel for pixel`);
  }
  const [download] = await Promise.all([page.waitForEvent("download"), links.nth(2).click()]);
  const name = download.suggestedFilename();
  assert.ok(readFileSync(await download.path()).equals(readFileSync(join(folder, "small", name))), `${name}, byte for byte`);
  // Table and words.
  const lines = program(folder, "map", "small.hdr", library, "-o", "again.zarr").split("\n");
  assert.equal(await page.locator("#scan-words").innerText(), lines[0]);
  const table = (await page.locator("#scan-result").innerText()).replace(/\s+/g, " ");
  const named = lines.filter((line) => / %/.test(line));
  for (const line of [...named, ...lines.filter((line) => /^(mapped as one|not mapped): /.test(line))]) {
    assert.ok(table.includes(line.replace(/\s+/g, " ").trim()), `${line}\n${table}`);
  }
  assert.ok(named.length >= 4 && lines.some((line) => /^not mapped: 1 of 3072 pixels, ignored/.test(line)), lines.join("\n"));
  const csv = await savedBy(page, page.getByRole("button", { name: "Download CSV" }));
  const rows = program(folder, "map", "small.hdr", library, "-o", "third.zarr", "--csv").trim().split("\n");
  assert.equal(csv.text.trim().split("\n").length, rows.length);
  assert.equal(csv.text.split("\n")[0], rows[0]);
  // The spot by keys: from the middle of the map to row 11, column 10.
  const canvas = page.locator("#scan-map");
  await canvas.focus();
  for (const [key, times] of [["Shift+ArrowUp", 1], ["ArrowUp", 3], ["Shift+ArrowLeft", 2], ["ArrowLeft", 2]]) {
    for (let step = 0; step < times; step++) await canvas.press(key);
  }
  await canvas.press("Enter");
  await page.locator("#scan-chart svg").waitFor();
  const { words, ...told } = JSON.parse(await page.locator("#scan-chart").getAttribute("data-spot"));
  assert.deepEqual(near(told), near(spot));
  assert.match(words, /^rows 10\.\.13, columns 9\.\.12: .* \+- \d+ %/);
  const values = (await page.locator('#scan-chart polyline[data-name="measured"]').getAttribute("data-values")).split(" ").map(Number);
  assert.deepEqual(near(values), near(spot.measured));
  // The pixel without data, by itself.
  for (const [key, times] of [["Shift+ArrowUp", 2], ["ArrowLeft", 5]]) {
    for (let step = 0; step < times; step++) await canvas.press(key);
  }
  await page.locator("#scan-size").selectOption("1");
  await notice().waitFor();
  assert.match(await notice().innerText(), /rows 0\.\.1, columns 5\.\.6: none of these pixels can be mapped[^]*choose another spot of the map/);
});

test("all orders and types of numbers give the same maps; rows, distance and pigments are the user's", async () => {
  await page.locator("#tab-scan").click();
  await page.locator("#scan-options summary").click();
  await page.locator("#scan").getByLabel("Rows and columns").fill("4..20,8..40");
  await page.locator("#scan").getByLabel("Pigments of a pixel at most").selectOption("2");
  await page.locator("#scan").getByLabel("Only these pigments").fill("Zinc White; Cobalt Blue; Viridian; Vermilion; Lead White");
  const palette = ["Zinc White", "Cobalt Blue", "Viridian", "Vermilion", "Lead White"].flatMap((name) => ["--palette", name]);
  const factor = "reflectance scale factor = 10000";
  const ignored = "data ignore value = -10000";
  const bbl = `bbl = {${simulated.nm.map((_, band) => (band === 2 ? 0 : 1)).join(", ")}}`;
  const cases = [
    ["bsq", { interleave: "bsq", type: 2, order: 1, scale: 10000, more: [factor, ignored] }],
    ["bip", { interleave: "bip", type: 5, order: 1, more: [bbl] }],
    ["bil", { interleave: "bil", type: 2, scale: 10000, more: [factor, bbl] }],
  ];
  for (const [name, options] of cases) {
    await drop(scan(name, options));
    await ready();
    await map();
    const found = JSON.parse((await savedBy(page, page.getByRole("button", { name: "Download JSON" }))).text);
    const words = ["map", `${name}.hdr`, library, "-o", `${name}.zarr`, "--region", "4..20,8..40", "--at-most", "2", ...palette, "--json"];
    const wanted = JSON.parse(program(folder, ...words));
    assert.deepEqual(found.palette, wanted.palette, name);
    assert.deepEqual(found.pixels, wanted.pixels, name);
    assert.equal(found.survey_sha256, wanted.survey_sha256, name);
  }
  // Raw counts with readings of white and dark.
  const one = (value) => ({ ...simulated, samples: 1, lines: 1, pixels: [simulated.nm.map(() => value)] });
  const [white, dark] = [["white", 1], ["dark", 0.01]].map(([name, value]) => scan(name, { type: 12, scale: 4000 }, one(value)));
  await page.locator("#scan-reading summary").click();
  for (const [id, files] of [["#s-white-files", white], ["#s-dark-files", dark]]) {
    await page.locator(id).setInputFiles(files.map(({ name }) => join(folder, name)));
  }
  await drop(scan("counts", { type: 12, scale: 4000 }, { ...simulated, pixels: simulated.pixels.map((pixel) => pixel.map((value) => Math.max(value, 0))) }));
  await ready();
  await map();
  const ofCounts = JSON.parse((await savedBy(page, page.getByRole("button", { name: "Download JSON" }))).text);
  const told = program(folder, "map", "counts.hdr", library, "-o", "counts.zarr", "--white-reading", "white.hdr", "--dark-reading", "dark.hdr",
    "--region", "4..20,8..40", "--at-most", "2", ...palette, "--json");
  assert.deepEqual(ofCounts.palette, JSON.parse(told).palette);
  assert.equal(ofCounts.survey_sha256, JSON.parse(told).survey_sha256);
  await page.locator("#scan").getByLabel("Map every n-th pixel").fill("3");
  await map();
  const found = JSON.parse((await savedBy(page, page.getByRole("button", { name: "Download JSON" }))).text);
  assert.equal(Object.values(found.pixels).reduce((sum, count) => sum + count, 0), 6 * 11);
  assert.equal(found.every, 3);
});

test("refusals are the program's, in the words of the page", async () => {
  await page.locator("#tab-scan").click();
  const rest = { ...simulated, lines: 4, pixels: simulated.pixels.slice(128, 128 + 64 * 4) };
  const cases = [
    ["dark", { more: [] }, { ...rest, pixels: rest.pixels.map((pixel) => pixel.map(() => 0)) }, /scan again with light/],
    ["counts", { type: 12, scale: 4000 }, rest, /reflectance/],
    ["units", { more: [] }, { ...rest, nm: rest.nm.map((nm) => nm * 100) }, /nm/],
    ["far", { more: [] }, { ...rest, nm: rest.nm.map((nm) => nm + 1000) }, /nm/],
  ];
  for (const [name, options, of] of cases) {
    await drop(scan(name, options, of));
    if (name === "far") {
      await ready();
      await page.locator("#scan-start").click();
    }
    await notice().waitFor();
    const [told, wanted] = [await notice().innerText(), refused("map", `${name}.hdr`, library)];
    assert.ok(told.includes(wanted), `${wanted}\n${told}`);
    assert.match(told, /Way out: /);
    assert.doesNotMatch(told, /\[[a-z_]+[=\]]/);
    await page.getByRole("button", { name: "Close" }).click();
  }
  // Percent is understood and told.
  await drop(scan("percent", { scale: 100 }, rest));
  await ready();
  assert.match(await page.locator("#scan-told").innerText(), /values up to .* are taken for percent/);
  // Header and data disagree; one of both is missing; two of a name; no scan at all.
  const [header, data] = scan("short", {}, rest);
  data.bytes = data.bytes.subarray(0, data.bytes.length - 4);
  writeFileSync(join(folder, data.name), data.bytes);
  const told = async (files, pattern) => {
    await drop(files);
    await notice().waitFor();
    assert.match(await notice().innerText(), pattern);
    assert.equal(await page.evaluate(() => document.activeElement.id), "notice");
    assert.ok(await page.locator("#scan-start").isDisabled());
    await page.getByRole("button", { name: "Close" }).click();
  };
  const wanted = refused("map", "short.hdr", library);
  assert.match(wanted, /describes \d+ bytes/);
  await told([header, data], new RegExp(wanted.replace(/[.*+?^${}()|[\]\\]/g, "\\$&")));
  await told([header], /short\.hdr: the data of this header are not beside it[^]*header \(\.hdr\) and its data file together/);
  await told([data], /short\.img: is not a cube that can be read, and no header of ENVI is beside it/);
  await told([header, { name: "short.hdr", bytes: data.bytes }], /two files are named short\.hdr/);
  await told([{ name: "old.mat", bytes: "MATLAB 5.0 MAT-file" }], /old\.mat: is a MATLAB file/);
  await drop(scan("fine", {}, rest));
  await ready();
  await page.locator("#scan-options summary").click();
  await page.locator("#scan").getByLabel("Rows and columns").fill("0..9,0..64");
  await page.locator("#scan-start").click();
  await page.locator("#notice", { hasText: "does not lie within the scan's 4 x 64 pixels" }).waitFor();
  assert.match(await notice().innerText(), /"Rows and columns"/);
});

test("a scan above 1 GB is refused before it is read, and mapping can be cancelled", async () => {
  await page.locator("#tab-scan").click();
  await page.evaluate(() => {
    const large = new File(["ENVI"], "large.hdr");
    Object.defineProperty(large, "size", { value: 1024 ** 3 + 1 });
    const event = new Event("drop", { bubbles: true });
    event.dataTransfer = { files: [large] };
    document.querySelector("#scan-drop").dispatchEvent(event);
  });
  await notice().waitFor();
  assert.match(await notice().innerText(), /large\.hdr: 1025 MB, and a page reads 1024 MB at most[^]*program impasto or its Python package/);
  const pixels = Array.from({ length: 8 }, () => simulated.pixels).flat();
  await drop(scan("tall", {}, { ...simulated, lines: simulated.lines * 8, pixels }));
  await ready();
  await page.locator("#scan-start").click();
  await page.locator("#busy-stage", { hasText: /surveying, \d+ %/ }).waitFor();
  await page.getByRole("button", { name: "Cancel" }).click();
  await page.locator("#busy").waitFor({ state: "hidden" });
  assert.ok(await page.locator("#scan-result").isHidden());
  // The next worker opens the scan again.
  await page.locator("#scan-options summary").click();
  await page.locator("#scan").getByLabel("Map every n-th pixel").fill("16");
  await page.locator("#scan").getByLabel("Rows and columns").fill("0..48,0..64");
  await map();
  assert.match(await page.locator("#scan-words").innerText(), /^384 x 64 pixels/);
});

test("spectra at points have the program's pigments, shares and probabilities", async () => {
  const { nm, pixels } = simulated;
  const rows = { sky: pixels[2], leaf: pixels[30], flesh: pixels[60], comb: pixels[70], hole: nm.map(() => 0) };
  const line = (name, film, values) => [name, film, ...values].join(",");
  const table = [line("sample", "film", nm), ...Object.entries(rows).map(([name, values]) => line(name, "paint", values)), line("card", "none", nm.map(() => 0.9))];
  const files = [{ name: "fors.csv", bytes: `${table.join("\n")}\n` }];
  writeFileSync(join(folder, "fors.csv"), files[0].bytes);
  await page.locator("#tab-scan").click();
  const identify = async () => {
    await page.locator("#spots-start:enabled").click();
    await page.locator("#busy").waitFor({ state: "hidden" });
    await page.locator("#spots-result").waitFor();
    assert.equal(await page.evaluate(() => document.activeElement.id), "spots-done");
    return JSON.parse((await savedBy(page, page.locator("#spots-json"))).text);
  };
  const check = async (found, ...words) => {
    const wanted = JSON.parse(program(folder, "identify", "fors.csv", library, ...words, "--json"));
    assert.deepEqual(near(found), near(wanted));
    assert.equal(found.spectra.length, 5, "a bare card holds no paint");
    const csv = (await savedBy(page, page.locator("#spots-csv"))).text.split("\n");
    const told = program(folder, "identify", "fors.csv", library, ...words, "--csv").split("\n");
    assert.deepEqual([csv.length, csv[0]], [told.length, told[0]]);
    return wanted;
  };
  await dropped(page, "#spots-drop", files);
  const wanted = await check(await identify());
  assert.match(await page.locator("#spots-notes").innerText(), /Van Gogh's oils[^]*Counted as one: [^]*left out 1 spectrum of bare cards/);
  const text = program(folder, "identify", "fors.csv", library);
  // Table and words of each spectrum are those that the program prints.
  const printed = text.split("\n").filter((one) => !one.startsWith("counted as one"));
  for (const { spectrum, mapped } of wanted.spectra) {
    await page.locator("#spots-which").selectOption(spectrum);
    const start = printed.findIndex((one) => one.startsWith(`${spectrum}: `));
    assert.equal(await page.locator("#spots-words").innerText(), printed[start]);
    const shown = (await page.locator("#spots-pigments").innerText()).replace(/\s+/g, " ");
    for (const one of printed.slice(start + 1)) {
      const pigment = / {2}(.*?) +(\S+ \+- +\S+ %) {2}there: +(\d+ %)$/.exec(one);
      if (!pigment) break;
      const row = `${pigment[1]} ${pigment[2].replace(/ +/g, " ")} ${pigment[3]}`;
      assert.ok(shown.includes(row), `${row}\n${shown}`);
    }
    const curves = await page.locator("#spots-chart polyline").count();
    assert.equal(curves, mapped.length ? 2 : 1);
  }
  assert.match(text, /^hole: not compared: darker/m);
  await page.locator("#spots-which").selectOption("leaf");
  await page.screenshot({ path: join(pictures, "calibration-points-1280.png"), fullPage: true });
  await page.setViewportSize({ width: 400, height: 860 });
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 400);
  await page.screenshot({ path: join(pictures, "calibration-points-400.png"), fullPage: true });
  await page.setViewportSize({ width: 1280, height: 900 });
  // Options, and a refusal in the words of the panel.
  await page.locator("details:has(#spots-fields) > summary").click();
  await page.locator("#at_most-of-spots").fill("2");
  await page.locator("#palette-of-spots").fill("Zinc White; Cobalt Blue; Viridian; Vermilion");
  await page.locator("#noise-of-spots").fill("0.01");
  await page.locator("#apart-of-spots").check();
  const palette = ["Zinc White", "Cobalt Blue", "Viridian", "Vermilion"].flatMap((name) => ["--palette", name]);
  await check(await identify(), "--at-most", "2", "--noise", "0.01", "--apart", ...palette);
  await page.locator("#palette-of-spots").fill("Mud");
  await page.locator("#spots-start").click();
  await page.locator("#notice", { hasText: refused("identify", "fors.csv", library, "--palette", "Mud") }).waitFor();
  assert.doesNotMatch(await notice().innerText(), /--palette/);
});

test("without a network the panel fits 390 and 1280 px, light and dark, and every control has a name", async () => {
  await page.locator("html[data-offline=ready]").waitFor({ state: "attached" });
  await context.setOffline(true);
  await page.reload();
  await page.locator("#tab-mix").focus();
  await page.keyboard.press("End");
  assert.equal(await page.evaluate(() => document.activeElement.id), "tab-scan");
  await drop(scan("shown", {}));
  await ready();
  for (const name of ["#scan-options", "#scan-reading"]) await page.locator(`${name} summary`).click();
  await page.locator("#scan").getByLabel("Map every n-th pixel").fill("2");
  await map();
  assert.match(await page.locator("#scan").innerText(), /Tested on simulated scans and measured swatches only/);
  assert.equal(await page.evaluate(() => document.activeElement.id), "scan-heading");
  for (const scheme of ["light", "dark"]) {
    for (const width of [1280, 390]) {
      await page.emulateMedia({ colorScheme: scheme });
      await page.setViewportSize({ width, height: 860 });
      await page.locator("#scan-chart").evaluate((chart) => chart.replaceChildren());
      await page.locator("#scan-map").click({ position: { x: 40, y: 40 } });
      await page.locator("#scan-chart svg").waitFor();
      const wide = await page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok(wide <= width, `${wide} px wide`);
      await page.screenshot({ path: join(pictures, `calibration-scan-${width}-${scheme}.png`), fullPage: true });
    }
  }
  const nameless = await page.evaluate(() => {
    const controls = [...document.querySelectorAll("#scan button, #scan input, #scan select, #scan summary, #scan canvas, #scan img, #scan [tabindex='0']")];
    const named = (one) => one.labels?.length || one.ariaLabel || one.alt || one.textContent.trim();
    return controls.filter((one) => !named(one)).map((one) => one.outerHTML.slice(0, 80));
  });
  assert.deepEqual(nameless, []);
});
