// The acts that tests of the calibration page share.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";

// Drops files on `target`, as a hand does.
export async function dropped(page, target, files) {
  const transfer = await page.evaluateHandle((given) => {
    const data = new DataTransfer();
    for (const { name, base64 } of given) {
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      data.items.add(new File([bytes], name));
    }
    return data;
  }, files.map(({ name, bytes }) => ({ name, base64: Buffer.from(bytes).toString("base64") })));
  await page.dispatchEvent(target, "dragover", { dataTransfer: transfer });
  await page.dispatchEvent(target, "drop", { dataTransfer: transfer });
}

// The file that `button` downloads: its name and its text.
export async function savedBy(page, button) {
  const [download] = await Promise.all([page.waitForEvent("download"), button.click()]);
  return { name: download.suggestedFilename(), text: readFileSync(await download.path(), "utf8") };
}

// Equal texts; tells the first line that differs, not thousands.
export function same(found, wanted) {
  if (found === wanted) return;
  const [a, b] = [found.split("\n"), wanted.split("\n")];
  const at = a.findIndex((line, place) => line !== b[place]);
  assert.fail(`line ${at + 1} is ${String(a[at]).slice(0, 120)}, wanted ${String(b[at]).slice(0, 120)}`);
}

// A fresh page of `height` pixels, which waits `timeout` ms at most. `faults` collects the errors of its scripts and of
// its console.
export async function freshPage(browser, height, timeout) {
  const context = await browser.newContext({ viewport: { width: 1280, height } });
  const page = await context.newPage();
  page.setDefaultTimeout(timeout);
  const faults = [];
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  return { context, page, faults };
}
