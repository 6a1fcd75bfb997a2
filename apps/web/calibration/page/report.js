// The report inside the page.

import { $, download } from "./page.js";
import { long, onChange, shelf, viewing, work } from "./shelf.js";
import { say } from "./tabs.js";

let html = "";

export function startReport() {
  $("report-start").addEventListener("click", draw);
  $("report-save").addEventListener("click", () => download(`${shelf.name.replace(/\..*$/, "")}.report.html`, html, "text/html"));
  onChange(forget);
}

// A report on another library or under another light is none.
function forget() {
  html = "";
  $("report-save").disabled = true;
  $("report-frame").hidden = true;
  const about = shelf.readings
    ? "The readings that were dropped are compared with the library."
    : "Drop readings in Fit to compare them with the library.";
  $("report-about").textContent = about;
  $("report-validate").disabled = !shelf.readings;
}

async function draw() {
  const drawn = await work("drawing the report", (stage) => {
    const args = [shelf.readings !== null, shelf.readings !== null && $("report-validate").checked, JSON.stringify(viewing())];
    return long.call("report", args, stage);
  });
  if (!drawn) return;
  html = drawn;
  $("report-frame").srcdoc = html;
  $("report-frame").hidden = false;
  $("report-save").disabled = false;
  say("The report is drawn");
}
