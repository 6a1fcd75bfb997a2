// The lab in the calibration page: films on two cards, sets compared and plans have the program's numbers and files.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, afterEach, before, beforeEach, test } from "node:test";
import { launched, pictures, program, root, served } from "./browser.mjs";
import { dropped, freshPage, same, savedBy } from "./calibration.mjs";

const measurements = resolve(root, "measurements");
const oils = "van-gogh-oils.pigments.json";

let server, browser, context, page, folder, faults;

before(async () => {
  server = await served("calibration");
  browser = await launched();
  folder = mkdtempSync(join(tmpdir(), "impasto-lab-"));
});

after(async () => {
  await browser?.close();
  server?.end();
  rmSync(folder, { recursive: true, force: true });
});

beforeEach(async () => {
  ({ context, page, faults } = await freshPage(browser, 900, 30_000));
  await page.goto(server.address);
});

afterEach(async () => {
  assert.deepEqual(faults, [], "nothing is wrong in the browser's console");
  await context.close();
});

const notice = () => page.locator("#notice");
const field = (label) => page.locator("#lab").getByLabel(label, { exact: true });
const saved = (id) => savedBy(page, page.locator(id));

// Drops files on `target`, and keeps them for the program.
async function drop(target, files) {
  for (const [name, text] of Object.entries(files)) writeFileSync(join(folder, name), text);
  await dropped(page, target, Object.entries(files).map(([name, bytes]) => ({ name, bytes })));
}

async function done(part) {
  await page.locator(`#${part}-start:enabled`).click();
  await page.locator("#busy").waitFor({ state: "hidden" });
  await page.locator(`#${part}-result`).waitFor();
  assert.equal(await page.evaluate(() => document.activeElement.id), `${part}-done`, "the result has the focus");
}

// What the program prints, and whether it refuses: a comparison that fails ends with status 1.
function run(...words) {
  const ended = spawnSync(process.env.IMPASTO ?? resolve(root, "target/debug/impasto"), words, { cwd: folder, encoding: "utf8" });
  return { text: ended.stdout, error: ended.stderr.match(/error: (.*)/)?.[1] };
}

const flat = async (selector) => (await page.locator(selector).innerText()).replace(/\s+/g, " ");

// A film of two thicknesses on cards, of which one reading is repeated.
const FILM = `sample,film,backing,thickness_mm,400,450,500,550,600,650,700
card,none,white,,0.80,0.84,0.86,0.87,0.87,0.88,0.88
card,none,black,,0.05,0.05,0.05,0.05,0.05,0.05,0.05
ochre,paint,white,0.08,0.12,0.17,0.35,0.52,0.62,0.66,0.68
ochre,paint,black,0.08,0.11,0.14,0.28,0.43,0.50,0.51,0.52
ochre,paint,black,0.08,0.112,0.142,0.281,0.429,0.503,0.512,0.519
ochre,paint,white,0.2,0.11,0.15,0.31,0.50,0.58,0.60,0.62
ochre,paint,black,0.2,0.11,0.15,0.308,0.49,0.57,0.586,0.60
`;

test("a film on two cards has the program's hiding power, curves and table", async () => {
  await page.locator("#tab-lab").click();
  await drop("#film-drop", { "ochre.csv": FILM });
  await done("film");
  const told = JSON.parse(program(folder, "film", "ochre.csv", "--json"));
  assert.equal(told.films.length, 2);
  const text = (estimate, digits) => `${estimate.value.toFixed(digits)} +- ${estimate.deviation.toFixed(digits)}`;
  const table = await flat("#film-table");
  for (const film of told.films) {
    const { contrast_ratio: ratio, hiding } = film;
    for (const part of [text(ratio, 4), `${text(hiding.thickness_mm, 4)} mm`, `${text(hiding.spreading_rate, 2)} m2/l`]) {
      assert.ok(table.includes(part), `${part}\n${table}`);
    }
  }
  assert.ok((await flat("#film-notes")).includes(`contrast ratio 0.98 at ${told.interpolated[0].spreading_rate.toFixed(2)} m2/l, between its films`));
  const csv = await saved("#film-csv");
  assert.equal(csv.name, "film.csv");
  same(csv.text, program(folder, "film", "ochre.csv", "--csv"));
  // Curves of the second film, per mm, with deviations.
  await page.locator("#film-which").selectOption("ochre, 0.2 mm");
  await page.locator("#film-curves").selectOption("K and S per mm");
  const line = page.locator('#film-chart polyline[data-name="S"]');
  const of = (key) => told.films[1].powers.map((power) => power[key] ?? "").join(" ");
  assert.equal(await line.getAttribute("data-values"), of("s_per_mm"));
  assert.equal(await line.getAttribute("data-sd"), of("s_per_mm_sd"));
  await page.locator("#film-chart summary").click();
  assert.match(await page.locator("#film-chart tbody tr").first().innerText(), /^400\s+-\s+-$/, "the readings do not show the cards");
  assert.match(await page.locator("#film-chart tbody tr").last().innerText(), /^700\s+[\d.]+ \+- [\d.]+\s+[\d.]+ \+- [\d.]+$/);
  await page.screenshot({ path: join(pictures, "calibration-film.png"), fullPage: true });
});

test("films without columns are named, and options of a film are the program's", async () => {
  await page.locator("#tab-lab").click();
  const spectra = FILM.split("\n").slice(0, 5).map((line) => line.split(",")).map(([sample, film, backing, , ...values], row) => {
    return [row ? `${sample} ${film} ${backing}` : "sample", ...values].join(",");
  });
  await drop("#film-drop", { "four.csv": `${spectra.join("\n")}\n` });
  const names = { over_white: "ochre paint white", over_black: "ochre paint black", white_card: "card none white", black_card: "card none black" };
  await page.locator("details:has(#film-options) > summary").click();
  await field("Over white").fill(names.over_white);
  await page.locator("#film-start:enabled").click();
  await notice().waitFor();
  const wanted = run("film", "four.csv", "--over-white", names.over_white).error;
  assert.ok((await notice().innerText()).includes(wanted), wanted);
  assert.match(await notice().innerText(), /"Over white"[^]*"Black card"/, "the way out names the fields");
  await field("Over black").fill(names.over_black);
  await field("White card").fill(names.white_card);
  await field("Black card").fill(names.black_card);
  await field("Thickness, mm").fill("0.08");
  await field("Solids").fill("0.4");
  await page.locator("#contrast-of-film").fill("0.95");
  await page.locator("#surface-of-film").fill("none");
  await page.getByLabel("Light", { exact: true }).fill("A");
  await done("film");
  const words = Object.entries(names).flatMap(([key, name]) => [`--${key.replace("_", "-")}`, name]);
  const more = ["--thickness-mm", "0.08", "--solids", "0.4", "--contrast", "0.95", "--saunderson", "none", "--illuminant", "A"];
  const told = JSON.parse(program(folder, "film", "four.csv", ...words, ...more, "--json"));
  assert.ok((await flat("#film-table")).includes(`${told.films[0].hiding.spreading_rate.value.toFixed(2)} +-`));
  same((await saved("#film-csv")).text, program(folder, "film", "four.csv", ...words, ...more, "--csv"));
  await field("Solids").fill("1.4");
  await page.locator("#film-start").click();
  await page.locator("#notice", { hasText: run("film", "four.csv", ...words, "--solids", "1.4").error }).waitFor();
  assert.match(await notice().innerText(), /"Solids"/);
});

test("two sets are compared sample by sample, and a fail is seen", async () => {
  await page.locator("#tab-lab").click();
  const batch = "sample,400,500,600,700\nred,5,6,50,62\ngrey,30,30,30,30\n\"green, dark\",9,20,11,9\n";
  await drop("#batch-drop", { "batch.csv": batch });
  await page.locator("#batch-told", { hasText: "3 spectra" }).waitFor();
  assert.ok(await page.locator("#compare-start").isDisabled(), "the standard is missing");
  await drop("#standard-drop", { "standard.csv": "sample,400,500,600,700\nred,0.05,0.06,0.55,0.65\ngrey,0.3,0.3,0.3,0.31\nblue,0.5,0.2,0.1,0.1\n\"green, dark\",0.09,0.2,0.11,0.09\n" });
  await done("compare");
  const words = ["color", "batch.csv", "--against", "standard.csv"];
  const [told] = JSON.parse(run(...words, "--json").text);
  assert.equal(await page.locator("#compare-table tbody tr").count(), 3);
  assert.ok((await flat("#compare-words")).includes(`3 samples under D65, observer 1931-2: CIEDE2000 mean ${told.mean.toFixed(2)}, 95 % below ${told.p95.toFixed(2)}, largest ${told.max.toFixed(2)}`));
  assert.match(await flat("#compare-notes"), /only in the second set: blue/);
  same((await saved("#compare-csv")).text, run(...words, "--csv").text);
  await field("Tolerance").fill("1");
  await done("compare");
  assert.match(await page.locator("#compare-table tbody tr").first().innerText(), new RegExp(`^red\\s+${told.samples[0].ciede2000.toFixed(2)}\\s.*FAIL$`, "s"));
  assert.match(await flat("#compare-words"), /2 pass and 1 fail at 1 CIEDE2000\./);
  same((await saved("#compare-csv")).text, run(...words, "--tolerance", "1", "--csv").text);
  // Percent as fractions, and no common name.
  await page.locator("#lab-reading > summary").click();
  await page.locator("#lab-o-percent").selectOption("fractions");
  await page.locator("#notice", { hasText: run("color", "batch.csv", "--against", "standard.csv", "--fraction").error }).waitFor();
  await page.locator("#lab-o-percent").selectOption("as the file says");
  await drop("#standard-drop", { "other.csv": "sample,400,500,600,700\nRed,0.05,0.06,0.55,0.65\n" });
  await page.locator("#standard-told", { hasText: "1 spectrum" }).waitFor();
  await page.locator("#compare-start:enabled").click();
  await page.locator("#notice", { hasText: run("color", "batch.csv", "--against", "other.csv").error }).waitFor();
});

test("a plan has the program's swatches, form and recipes, byte for byte", async () => {
  await page.locator("#tab-lab").click();
  await page.locator("#plan-start").click();
  await page.locator("#notice", { hasText: "no pigment is named" }).waitFor();
  await page.getByLabel("Pigments", { exact: true }).fill("Cobalt Blue; Earth, \"burnt\"");
  await page.getByLabel("White of the plan").fill("Titanium White");
  await field("Black").fill("Bone Black");
  await done("plan");
  const check = async (words, file) => {
    const { text } = run("plan", ...words, "-o", `${file}.csv`, "--json");
    const told = JSON.parse(text);
    assert.equal(await page.locator("#plan-table tbody tr").count(), told.swatches.length);
    const table = await flat("#plan-table");
    for (const { sample, grams, why } of told.swatches) {
      const recipe = Object.entries(grams).map(([name, mass]) => `${mass} g ${name}`).join(" + ");
      assert.ok(table.includes(`${sample} ${recipe} ${why}`), `${sample}\n${table}`);
    }
    const [form, recipes] = [await saved("#plan-form"), await saved("#plan-recipes")];
    assert.deepEqual([form.name, recipes.name], ["plan.csv", "plan-recipes.csv"]);
    same(form.text, readFileSync(join(folder, `${file}.csv`), "utf8"));
    same(recipes.text, readFileSync(join(folder, `${file}-recipes.csv`), "utf8"));
    return told;
  };
  await check(["Cobalt Blue", "Earth, \"burnt\"", "--white", "Titanium White", "--black", "Bone Black"], "plain");
  assert.equal(await page.locator("#plan-forecast table").count(), 0);
  await page.getByRole("button", { name: "Van Gogh's oils", exact: true }).click();
  await page.getByLabel("Pigments", { exact: true }).fill("Cobalt; Viridian");
  await page.getByLabel("White of the plan").fill("Zinc White");
  await field("Black").fill("");
  await page.locator("#minutes-of-plan").fill("60");
  await page.locator("details:has(#plan-options) > summary").click();
  await field("Grams").fill("20");
  await page.locator("#noise-of-plan").fill("0.003,0.02");
  await page.getByLabel("Wavelengths of the form").fill("380,730,5");
  await page.getByLabel("Readings of each").fill("3");
  await page.locator("#plan-start").click();
  await page.locator("#notice", { hasText: "works only where a library chooses the swatches" }).waitFor();
  await page.getByLabel("Choose them by the library above").check();
  await done("plan");
  const words = ["Cobalt", "Viridian", "--white", "Zinc White", "--minutes", "60", "--grams", "20", "--noise", "0.003,0.02", "--grid", "380,730,5", "--replicates", "3"];
  const told = await check([join(measurements, oils), ...words], "prior");
  assert.match(await flat("#plan-forecast"), new RegExp(`has ${(100 * told.prior.usual_efficiency).toFixed(0)} % of the information`));
  assert.match(await flat("#plan-notes"), /Warning: /, "fewer swatches than the usual plan");
  // Both ways to say how many.
  await page.locator("#swatches-of-plan").fill("9");
  await page.locator("#plan-start").click();
  await page.locator("#notice", { hasText: run("plan", join(measurements, oils), ...words, "--swatches", "9").error }).waitFor();
  assert.match(await notice().innerText(), /"Swatches" or "Minutes"/);
});

test("every field of the lab has a name of its own, and all fits a phone", async () => {
  await page.locator("#tab-lab").click();
  await page.locator("#noise-of-plan").waitFor({ state: "attached" });
  const twice = await page.evaluate(() => {
    const ids = [...document.querySelectorAll("[id]")].map((one) => one.id);
    return ids.filter((id, place) => ids.indexOf(id) !== place);
  });
  assert.deepEqual(twice, [], "ids are named once");
  const nameless = await page.evaluate(() => [...document.querySelectorAll("#lab input, #lab select, #scan input")].filter((one) => !one.labels?.length).map((one) => one.id));
  assert.deepEqual(nameless, []);
  // The schema says what each request takes, and the page has a field for it.
  const { $defs: all } = JSON.parse(readFileSync(resolve(root, "docs/schema/requests.json"), "utf8"));
  const elsewhere = { FilmRequest: ["viewing"], CompareRequest: ["viewing"], PlanRequest: [], IdentifyRequest: ["residuals"] };
  for (const [part, request] of [["film", "FilmRequest"], ["compare", "CompareRequest"], ["plan", "PlanRequest"], ["spots", "IdentifyRequest"]]) {
    for (const key of Object.keys(all[request].properties)) {
      assert.equal(await page.locator(`#${key}-of-${part}`).count(), elsewhere[request].includes(key) ? 0 : 1, `${key} of ${request}`);
    }
  }
  await drop("#film-drop", { "ochre.csv": FILM });
  await done("film");
  await drop("#batch-drop", { "ochre.csv": FILM });
  await page.locator("#batch-told", { hasText: "spectra" }).waitFor();
  await drop("#standard-drop", { "ochre.csv": FILM });
  await done("compare");
  await page.getByLabel("Pigments", { exact: true }).fill("Cobalt Blue; Viridian");
  await page.getByLabel("White of the plan").fill("Titanium White");
  await done("plan");
  for (const [width, scheme] of [[1280, "light"], [400, "light"], [400, "dark"]]) {
    await page.setViewportSize({ width, height: 860 });
    await page.emulateMedia({ colorScheme: scheme });
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= width, `${width} px`);
    await page.screenshot({ path: join(pictures, `calibration-lab-${width}-${scheme}.png`), fullPage: true });
  }
});
