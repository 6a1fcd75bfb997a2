// Puts the parts of the page together.

import { startCompare } from "./compare.js";
import { startFilm } from "./film.js";
import { saveLibrary, startFit, take } from "./fit.js";
import { startLink } from "./link.js";
import { startMix } from "./mix.js";
import { $, clearNotice, fits, notice, takesDrops, takesFiles } from "./page.js";
import { startPhotograph } from "./photograph.js";
import { startPlan } from "./plan.js";
import { startPoints } from "./points.js";
import { spectraSets } from "./reading.js";
import { startRecipes } from "./recipes.js";
import { startReport } from "./report.js";
import { isScan, startScan, takeScan } from "./scan.js";
import { changeViewing, long, refuse, scans, useLibrary, useShipped } from "./shelf.js";
import { say, select, startTabs } from "./tabs.js";

async function openLibrary(file) {
  clearNotice();
  if (!fits([file])) return;
  try {
    await useLibrary(file.name, new Uint8Array(await file.arrayBuffer()));
    say(`${file.name} is the library`);
    if (!$("fit").hidden) select("mix", false);
  } catch (error) {
    refuse(error);
  }
}

// The lab reads the files of all its parts in one way.
function startLab() {
  const changed = (told) => {
    $("film-start").disabled = !told.has("film");
    $("compare-start").disabled = !(told.has("batch") && told.has("standard"));
  };
  const settled = spectraSets($("lab-reading"), "lab-", ["film", "batch", "standard"], changed);
  startFilm(settled);
  startCompare(settled);
  startPlan();
}

function start() {
  if (typeof WebAssembly !== "object" || typeof Worker !== "function") {
    notice({ message: "this browser has no WebAssembly or no workers", hint: "use a current browser" });
    return;
  }
  startTabs();
  startFit();
  startMix();
  startRecipes();
  startPhotograph();
  startReport();
  startLab();
  startScan();
  startPoints();
  $("library-shipped").addEventListener("click", async () => {
    clearNotice();
    try {
      await useShipped();
      if (!$("fit").hidden) select("mix", false);
      say("Van Gogh's oils are the library");
    } catch (error) {
      refuse(error);
    }
  });
  takesFiles($("library-file"), ([file]) => openLibrary(file));
  $("library-save").addEventListener("click", saveLibrary);
  for (const id of ["light", "observer"]) $(id).addEventListener("change", changeViewing);
  $("busy-cancel").addEventListener("click", () => {
    for (const engine of [long, scans]) if (engine.busy) engine.stop();
    say("Cancelled");
  });
  // A file that is dropped beside the fields is a library, a scan or readings, by its ending.
  takesDrops(document.body, (files) => {
    if (files.length === 1 && /\.json$/i.test(files[0].name)) return openLibrary(files[0]);
    if (isScan(files)) {
      select("scan", false);
      return takeScan(files);
    }
    select("fit", false);
    return take(files);
  });
  startLink();
  // The same address then opens without a network.
  navigator.serviceWorker?.register("service-worker.js").then(() => navigator.serviceWorker.ready).then(() => {
    $("offline").textContent = ", and it works offline";
    document.documentElement.dataset.offline = "ready";
  }, () => {});
}

start();
