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

// The keys of `ReportRequest` (docs/schema/requests.json); the library chooses where a value is null.
function reportRequest() {
  return { no_validation: !$("report-validate").checked, viewing: viewing() };
}

async function draw() {
  const drawn = await work("drawing the report", (stage) => {
    return long.call("report", [shelf.readings !== null, JSON.stringify(reportRequest())], stage);
  });
  if (!drawn) return;
  html = drawn;
  $("report-frame").srcdoc = html;
  $("report-frame").hidden = false;
  $("report-save").disabled = false;
  say("The report is drawn");
}
