// Two sets of measurements compared, sample by sample.

import { form } from "./forms.js";
import { $, download, element, namedTable, remarkList, showResult } from "./page.js";
import { long, viewing, work } from "./shelf.js";
import { say } from "./tabs.js";

let found = null;

// `settled` waits until the files are read.
export function startCompare(settled) {
  const options = form("compare", "CompareRequest", [["compare-fields", null]], ["viewing"]);
  $("compare-start").addEventListener("click", async () => {
    await settled();
    if (!$("compare-start").disabled) compare(options);
  });
  $("compare-csv").addEventListener("click", () => download("comparison.csv", found.csv, "text/csv"));
}

async function compare(options) {
  const done = await work("comparing", async () => long.call("compare", [JSON.stringify({ ...await options(), viewing: viewing() })]));
  if (!done) return;
  found = done;
  const { samples, mean, p95, max, shift, tolerance, failed, illuminant, observer, remarks } = found;
  const two = (value) => value.toFixed(2);
  const count = `${samples.length} ${samples.length === 1 ? "sample" : "samples"}`;
  const [dl, da, db] = shift.map(two);
  const line = `${count} under ${illuminant}, observer ${observer}: CIEDE2000 mean ${two(mean)}, 95 % below ${two(p95)}, largest ${two(max)}; mean shift dL* ${dl}, da* ${da}, db* ${db}.`;
  const passed = failed === null ? "" : ` ${samples.length - failed} pass and ${failed} fail at ${tolerance} CIEDE2000.`;
  $("compare-words").textContent = line + passed;
  const mark = (passes) => element("span", { className: passes ? "" : "bad" }, passes ? "pass" : "FAIL");
  const heads = ["Sample", "CIEDE2000", "dL*", "da*", "db*", ...(failed === null ? [] : ["Tolerance"])];
  const rows = samples.map((one) => [one.sample, ...[one.ciede2000, one.dl, one.da, one.db].map(two), ...(failed === null ? [] : [mark(one.passes)])]);
  $("compare-table").replaceChildren(namedTable(heads, rows));
  $("compare-notes").replaceChildren(...remarkList(remarks));
  showResult("compare");
  say(`${count} compared${passed ? `,${passed}` : ""}`);
}
