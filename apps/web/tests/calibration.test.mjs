// The calibration page in a browser, compared with the program.

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, afterEach, before, beforeEach, test } from "node:test";
import { launched, pictures, program, root, served } from "./browser.mjs";
import { dropped, freshPage, same, savedBy } from "./calibration.mjs";
import { apart, utf16, workbook } from "./files.mjs";

const measurements = resolve(root, "measurements");
const oils = resolve(measurements, "van-gogh-oils.csv");
const shipped = "van-gogh-oils.pigments.json";

let server, browser, context, page, folder, faults, requests, origin;

before(async () => {
  server = await served("calibration");
  browser = await launched();
  folder = mkdtempSync(join(tmpdir(), "impasto-page-"));
});

after(async () => {
  await browser?.close();
  server?.end();
  rmSync(folder, { recursive: true, force: true });
});

beforeEach(async () => {
  ({ context, page, faults } = await freshPage(browser, 900, 20_000));
  requests = [];
  context.on("request", (request) => requests.push(request.url()));
  origin = new URL("/", server.address).href;
  await page.goto(server.address);
});

afterEach(async () => {
  const strangers = requests.filter((url) => !/^(blob|data|about):/.test(url) && !url.startsWith(origin));
  assert.deepEqual(strangers, [], "the page asks its own host alone");
  assert.deepEqual(faults, [], "nothing is wrong in the browser's console");
  await context.close();
});

const drop = (target, files) => dropped(page, target, files);
const saved = (button) => savedBy(page, button);
const notice = () => page.locator("#notice");
const curve = (chart, name) => page.locator(`${chart} polyline[data-name="${name}"]`);
const values = async (line) => (await line.getAttribute("data-values")).split(" ").map(Number);

// Numbers that agree but for the last digits: powers and exponentials of two systems differ there.
function near(found, wanted, within = 1e-9) {
  assert.equal(found.length, wanted.length);
  for (const [place, value] of found.entries()) assert.ok(Math.abs(value - wanted[place]) <= within, `${place}: ${value}, wanted ${wanted[place]}`);
}

async function useOils() {
  await page.getByRole("button", { name: "Van Gogh's oils", exact: true }).click();
  await page.locator("#mix-patch").waitFor();
}

async function fitOils() {
  await drop("#readings-drop", [{ name: "van-gogh-oils.csv", bytes: readFileSync(oils) }]);
  await page.locator("#fit-start:enabled").click();
  await page.locator("#fit-result").waitFor();
}

test("dropped readings of the oils give the library of the program, byte for byte", async (t) => {
  await fitOils();
  t.diagnostic(`the fit took ${await page.locator("#fit-facts").getAttribute("data-seconds")} s`);
  const file = join(folder, "oils.json");
  const told = JSON.parse(program(measurements, "fit", "van-gogh-oils.csv", "-o", file, "--json"));
  const library = await saved(page.getByRole("button", { name: "Download library" }));
  assert.equal(library.name, "van-gogh-oils.pigments.json");
  same(library.text, readFileSync(file, "utf8"));
  const facts = await page.locator("#fit-facts").innerText();
  assert.match(facts, new RegExp(`mean ${told.delta_e.mean.toFixed(2)}, .*largest ${told.delta_e.max.toFixed(2)}`));
  const rows = await page.locator("#fit-errors tbody tr").allInnerTexts();
  assert.equal(rows.length, told.samples);
  const worst = told.per_sample.reduce((a, b) => (b.delta_e > a.delta_e ? b : a));
  assert.match(rows[0], new RegExp(`^${worst.sample}\\s+${worst.delta_e.toFixed(2)}`));
  for (const warning of told.warnings) assert.ok((await page.locator("#fit-told").innerText()).includes(warning), warning);
});

test("options of the fit are those of the program, and charts show the library's numbers", async () => {
  await page.locator("#fit-options summary").click();
  await page.locator("#fit").getByLabel("Surface", { exact: true }).fill("0.03,0.6");
  await page.getByLabel("Readings below the surface").selectOption("floor");
  await page.getByLabel("White", { exact: true }).fill("Lead White");
  await fitOils();
  const file = join(folder, "options.json");
  const words = ["--saunderson", "0.03,0.6", "--below-surface", "floor", "--white", "Lead White"];
  program(measurements, "fit", "van-gogh-oils.csv", ...words, "-o", file);
  const library = await saved(page.getByRole("button", { name: "Download", exact: true }));
  same(library.text, readFileSync(file, "utf8"));
  const pigments = JSON.parse(library.text).pigments;
  await page.locator("#curves-pigment").selectOption("Cobalt Blue");
  await page.locator('#curves-chart svg[aria-label^="K and S of Cobalt Blue"]').waitFor();
  const blue = pigments.find((pigment) => pigment.name === "Cobalt Blue");
  assert.deepEqual(await values(curve("#curves-chart", "K")), blue.absorption);
  assert.deepEqual(await values(curve("#curves-chart", "S")), blue.scattering);
});

test("a fit takes over the surface of a library, as the program does", async () => {
  program(measurements, "fit", "van-gogh-oils.csv", "--saunderson", "0.015,0.5", "-o", join(folder, "first.json"));
  await page.locator("#fit-options summary").click();
  await page.getByLabel("Surface of a library").setInputFiles(join(folder, "first.json"));
  await fitOils();
  const file = join(folder, "second.json");
  program(measurements, "fit", "van-gogh-oils.csv", "--surface-of", join(folder, "first.json"), "-o", file);
  const library = await saved(page.getByRole("button", { name: "Download library" }));
  same(library.text, readFileSync(file, "utf8"));
  const { k1, k2 } = JSON.parse(library.text).saunderson;
  assert.deepEqual([k1, k2], [0.015, 0.5]);
  await page.locator("#fit").getByLabel("Surface", { exact: true }).fill("0.03,0.6");
  await page.locator("#fit-start").click();
  await page.locator("#notice", { hasText: '"Surface" and "Surface of a library" both state the surface' }).waitFor();
  await page.locator("#fit").getByLabel("Surface", { exact: true }).fill("");
  await page.getByLabel("Surface of a library").setInputFiles({ name: "no.json", mimeType: "application/json", buffer: Buffer.from("{}") });
  await page.locator("#fit-start").click();
  await page.locator("#notice strong", { hasText: "no.json" }).waitFor();
});

test("a workbook, UTF-16, and CGATS with recipes apart give the program's libraries", async () => {
  const csv = readFileSync(oils, "utf8");
  const { cgats, recipes } = apart(csv);
  const cases = [
    { name: "oils.xlsx", bytes: workbook(csv) },
    { name: "wide.csv", bytes: utf16(csv) },
    { name: "oils.ti3", bytes: cgats, recipes },
  ];
  for (const { name, bytes, recipes: apart } of cases) {
    writeFileSync(join(folder, name), bytes);
    const more = apart ? ["--recipes", "recipes.csv"] : [];
    if (apart) {
      writeFileSync(join(folder, "recipes.csv"), apart);
      await page.locator("#fit-options summary").click();
      await page.locator("#o-recipes").setInputFiles(join(folder, "recipes.csv"));
    }
    program(folder, "fit", name, ...more, "--method", "weighted", "-o", "other.json");
    await page.locator("#o-method").evaluate((list) => { list.value = "weighted"; });
    await drop("#readings-drop", [{ name, bytes }]);
    await page.locator("#readings-told", { hasText: "336 readings" }).waitFor();
    await page.locator("#fit-start:enabled").click();
    await page.locator("#fit-result").waitFor();
    const library = await saved(page.getByRole("button", { name: "Download library" }));
    same(library.text, readFileSync(join(folder, "other.json"), "utf8"));
  }
});

test("mixtures have the program's colours and spectra, hiding and over black and white", async () => {
  await useOils();
  const recipe = ["Zinc White=3", "Cobalt Blue=1.5", "Vermilion=0.25"];
  await page.getByRole("button", { name: "Clear" }).click();
  for (const text of recipe) {
    const [name, part] = text.split("=");
    await page.getByRole("spinbutton", { name: new RegExp(`^${name}( [A-Z].*)?$`) }).fill(part);
  }
  const told = (...words) => JSON.parse(program(measurements, "mix", shipped, ...recipe, ...words, "--json"));
  const hiding = told();
  await page.locator("#mix-told", { hasText: hiding.hex }).waitFor();
  near(await values(curve("#mix-chart", "reflectance")), hiding.reflectance);
  await page.locator("#mix-film").selectOption("film");
  await page.getByLabel("Light", { exact: true }).fill("A");
  await page.getByLabel("Light", { exact: true }).press("Tab");
  const [white, black] = ["white", "black"].map((over) => told("--thickness", "1", "--over", over, "--illuminant", "A"));
  await page.locator("#mix-told", { hasText: `Over white: ${white.hex}` }).waitFor();
  assert.match(await page.locator("#mix-told").innerText(), new RegExp(`Over black: ${black.hex}`));
  near(await values(curve("#mix-chart", "over white")), white.reflectance);
  near(await values(curve("#mix-chart", "over black")), black.reflectance);
  await page.getByRole("slider", { name: "Thickness" }).press("End");
  await page.locator("#mix-thickness-told", { hasText: "31.6" }).waitFor();
});

test("recipes for a typed colour, a swatch file and readings are the program's", async () => {
  await useOils();
  await page.getByRole("tab", { name: "Recipes" }).click();
  const wanted = (target, ...words) => JSON.parse(program(measurements, "match", shipped, target, ...words, "--json"))[0];
  const check = async (told) => {
    const cards = page.locator("#recipes-list > li");
    await page.locator("#recipes-told", { hasText: told.target }).waitFor();
    assert.equal(await cards.count(), told.recipes.length);
    for (const [place, recipe] of told.recipes.entries()) {
      const text = await cards.nth(place).innerText();
      for (const { name, share, parts } of recipe.pigments) {
        const amount = parts === undefined ? `${(100 * share).toFixed(1)} %` : `${parts} parts`;
        assert.match(text.replace(/\s+/g, " "), new RegExp(`${name.replace(/[()]/g, "\\$&")} ${amount}`));
      }
    }
  };
  await page.locator("#recipes details summary").first().click();
  await page.getByLabel("Pigments at most").fill("3");
  await page.getByRole("button", { name: "Find recipes" }).click();
  await check(wanted("#4a7d8c", "--at-most", "3"));
  near(await values(curve("#recipes-chart", "recipe 1")), wanted("#4a7d8c", "--at-most", "3").recipes[0].reflectance);
  await page.getByLabel("Whole parts, at most").fill("12");
  await page.getByLabel("Colour", { exact: true }).fill("52,-10.5,8");
  await page.getByRole("button", { name: "Find recipes" }).click();
  await check(wanted("52,-10.5,8", "--at-most", "3", "--parts", "12"));
  await page.getByLabel("Whole parts, at most").fill("");
  const palette = "GIMP Palette\nName: two\n#\n200  60  40\tBrick\n 40 120  60\tLeaf\n";
  await drop("#target-drop", [{ name: "two.gpl", bytes: palette }]);
  await page.getByText("Leaf").click();
  await page.getByRole("button", { name: "Find recipes" }).click();
  await check({ ...wanted("#28783c", "--at-most", "3"), target: "Leaf" });
  await drop("#target-drop", [{ name: "van-gogh-oils.csv", bytes: readFileSync(oils) }]);
  await page.locator("#targets label", { hasText: /^01B on white$/ }).click();
  await page.getByRole("button", { name: "Find recipes" }).click();
  await check({ ...wanted("van-gogh-oils.csv#01B", "--at-most", "3"), target: "01B on white" });
  await page.getByRole("button", { name: "Mix this" }).first().click();
  await page.locator("#mix #mix-chart svg").waitFor();
});

test("a pixel of a photograph is a colour, by pointer and by keys", async () => {
  await useOils();
  await page.getByRole("tab", { name: "Recipes" }).click();
  const base64 = await page.evaluate(() => {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [80, 40];
    const area = canvas.getContext("2d");
    for (const [left, ink] of [[0, "#aa3322"], [40, "#2244aa"]]) {
      area.fillStyle = ink;
      area.fillRect(left, 0, 40, 40);
    }
    return canvas.toDataURL("image/png").split(",")[1];
  });
  await page.locator("#target-file").setInputFiles({ name: "two.png", mimeType: "image/png", buffer: Buffer.from(base64, "base64") });
  const photo = page.locator("#photo");
  await photo.click({ position: { x: 12, y: 20 } });
  assert.equal(await page.locator("#target-text").inputValue(), "#aa3322");
  for (let step = 0; step < 3; step++) await photo.press("Shift+ArrowRight");
  await photo.press("Enter");
  assert.equal(await page.locator("#target-text").inputValue(), "#2244aa");
  await page.getByRole("button", { name: "Find recipes" }).click();
  await page.locator("#recipes-list > li").first().waitFor();
});

test("bad input is refused as the program refuses it, in the words of the page", async () => {
  const table = "sample,film,backing,White,Blue,400,410,420\nA,paint,white,9,1,50,x,52\n";
  await drop("#readings-drop", [{ name: "bad.csv", bytes: table }]);
  await notice().waitFor();
  writeFileSync(join(folder, "bad.csv"), table);
  let refused = "";
  try {
    program(folder, "fit", "bad.csv");
  } catch (error) {
    refused = String(error);
  }
  const message = refused.match(/error: (.*)/)[1];
  assert.ok(message.includes("bad.csv") && (await notice().innerText()).includes(message), `${message}\n${await notice().innerText()}`);
  assert.equal(await page.evaluate(() => document.activeElement.id), "notice");
  await page.getByRole("button", { name: "Close" }).click();
  assert.ok(await page.locator("#fit-start").isDisabled());

  await page.locator("#library-file").setInputFiles({ name: "no.json", mimeType: "application/json", buffer: Buffer.from("{}") });
  await page.locator("#notice strong", { hasText: "no.json" }).waitFor();
  assert.match(await notice().innerText(), /no\.json.*\n?.*format/);

  await page.locator("#fit-options summary").click();
  await page.getByLabel("White", { exact: true }).fill("Titanium White");
  await drop("#readings-drop", [{ name: "van-gogh-oils.csv", bytes: readFileSync(oils) }]);
  await page.locator("#fit-start:enabled").click();
  await notice().waitFor();
  assert.match(await notice().innerText(), /Titanium White/);
  assert.doesNotMatch(await notice().innerText(), /\[reference|--white/);

  await page.getByLabel("Smoothness").fill("much");
  await page.locator("#fit-start").click();
  await page.locator("#notice", { hasText: "Smoothness is a number" }).waitFor();
});

test("a file too large for memory is refused before it is read", async () => {
  await page.evaluate(() => {
    const megabyte = new Uint8Array(1024 * 1024);
    const file = new File(Array(257).fill(megabyte), "large.csv");
    const data = new DataTransfer();
    data.items.add(file);
    document.querySelector("#readings-drop").dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true }));
  });
  assert.match(await notice().innerText(), /large\.csv: 257 MB, and a page reads 256 MB at most/);
  assert.ok(await page.locator("#busy").isHidden());
  assert.equal(await page.locator("#readings-told").innerText(), "");
});

test("the report is drawn inside the page, and long work can be cancelled", async () => {
  await fitOils();
  await page.getByRole("tab", { name: "Report" }).click();
  await page.getByLabel("Leave each mixture out in turn (slow)").check();
  await page.getByRole("button", { name: "Draw the report" }).click();
  await page.locator("#busy-stage", { hasText: "mixture left out" }).waitFor();
  await page.getByRole("tab", { name: "Mix" }).click();
  await page.getByRole("spinbutton", { name: /^Viridian/ }).fill("4");
  await page.locator("#mix-chart svg[aria-label*='4 Viridian']").waitFor();
  await page.getByRole("button", { name: "Cancel" }).click();
  await page.locator("#busy").waitFor({ state: "hidden" });
  await page.getByRole("tab", { name: "Report" }).click();
  await page.getByLabel("Leave each mixture out in turn (slow)").uncheck();
  await page.getByRole("button", { name: "Draw the report" }).click();
  const frame = page.frameLocator("#report-frame");
  await frame.locator("figure svg").first().waitFor();
  assert.equal(await frame.locator("h1").innerText(), "van-gogh-oils");
  assert.ok((await frame.locator("figure").count()) > 8);
  const report = await saved(page.getByRole("button", { name: "Download the report" }));
  assert.match(report.text, /<a download="[a-z-]+\.csv" href="data:text\/csv/);
  assert.doesNotMatch(report.text, /href="figures\//);
});

test("after one visit the page works without a network", async () => {
  await page.locator("html[data-offline=ready]").waitFor({ state: "attached" });
  await context.setOffline(true);
  server.end();
  try {
    await page.reload();
    await page.getByRole("button", { name: "Try readings of Van Gogh's oils" }).click();
    await page.locator("#fit-start:enabled").click();
    await page.locator("#fit-result").waitFor();
    const library = await saved(page.getByRole("button", { name: "Download library" }));
    const file = join(folder, "offline.json");
    program(measurements, "fit", "van-gogh-oils.csv", "-o", file);
    same(library.text, readFileSync(file, "utf8"));
  } finally {
    server = await served("calibration");
  }
});

test("a link holds the library and the mixture", async () => {
  await useOils();
  await page.getByRole("spinbutton", { name: /^Viridian/ }).fill("2");
  await page.getByRole("button", { name: "Copy link" }).click();
  await page.waitForURL(/#library=/);
  const link = page.url();
  const other = await context.newPage();
  await other.goto(link);
  await other.locator("#mix-chart svg[aria-label*='2 Viridian']").waitFor();
  const [download] = await Promise.all([other.waitForEvent("download"), other.getByRole("button", { name: "Download", exact: true }).click()]);
  same(readFileSync(await download.path(), "utf8"), readFileSync(resolve(measurements, shipped), "utf8"));
  await other.goto(`${server.address}#library=broken`);
  await other.reload();
  await other.locator("#notice", { hasText: "the link holds no library" }).waitFor();
});

test("all is reached by keys, and every control has a name", async () => {
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.className), "skip");
  await useOils();
  await page.locator("#tab-mix").focus();
  await page.keyboard.press("ArrowRight");
  assert.equal(await page.evaluate(() => document.activeElement.id), "tab-recipes");
  assert.ok(await page.locator("#recipes").isVisible());
  await page.keyboard.press("Home");
  assert.ok(await page.locator("#fit").isVisible());
  await page.keyboard.press("ArrowRight");
  const slider = page.getByRole("slider", { name: "Viridian, slider" });
  await slider.focus();
  for (let step = 0; step < 5; step++) await page.keyboard.press("ArrowRight");
  await page.locator("#mix-chart svg[aria-label*='0.5 Viridian']").waitFor();
  await page.locator("#mix-chart svg").focus();
  await page.keyboard.press("Home");
  await page.locator("#mix-chart p", { hasText: /^400 nm: reflectance 0\.\d+/ }).waitFor();
  const nameless = await page.evaluate(() => {
    const controls = [...document.querySelectorAll("button, input, select, summary, canvas, iframe, [tabindex='0'], svg")];
    const named = (one) => one.labels?.length || one.ariaLabel || one.getAttribute("aria-labelledby") || one.title || one.textContent.trim();
    return controls.filter((one) => !named(one)).map((one) => one.outerHTML.slice(0, 80));
  });
  assert.deepEqual(nameless, []);
});

for (const scheme of ["light", "dark"]) {
  for (const width of [1280, 390]) {
    test(`the page fits ${width} px, ${scheme}`, async () => {
      await page.emulateMedia({ colorScheme: scheme });
      await page.setViewportSize({ width, height: 860 });
      const shot = async (name) => {
        const wide = await page.evaluate(() => document.documentElement.scrollWidth);
        assert.ok(wide <= width, `${name} is ${wide} px wide`);
        await page.screenshot({ path: join(pictures, `calibration-${name}-${width}-${scheme}.png`), fullPage: true });
      };
      await shot("start");
      await fitOils();
      await shot("fit");
      await page.getByRole("button", { name: "Mix with it" }).click();
      await page.locator("#mix-film").selectOption("film");
      await page.locator("#mix-chart polyline[data-name='over black']").waitFor();
      await shot("mix");
      await page.getByRole("tab", { name: "Recipes" }).click();
      await page.getByRole("button", { name: "Find recipes" }).click();
      await page.locator("#recipes-list > li").first().waitFor();
      await shot("recipes");
      await page.getByRole("tab", { name: "Report" }).click();
      await page.getByRole("button", { name: "Draw the report" }).click();
      await page.frameLocator("#report-frame").locator("figure svg").first().waitFor();
      await shot("report");
      await drop("#readings-drop", [{ name: "bad.csv", bytes: "sample,400\nA,x\n" }]);
      await notice().waitFor();
      await shot("refusal");
    });
  }
}
