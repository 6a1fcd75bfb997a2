// The native part on a thread of its own: the page stays alive while it computes.

import { failureOf } from "./failures.js";
import init, * as native from "./impasto_web_calibration.js";

const module = new URL("impasto_web_calibration_bg.wasm", import.meta.url);
const ready = init({ module_or_path: module }).then(() => native.begin());

// Objects of the native part that later calls use.
const held = {};

let current = 0;
let defect = "";
globalThis.impastoStage = (stage) => postMessage({ id: current, stage });
globalThis.impastoDefect = (text) => { defect = text; };

// Puts an object of the native part in place of the one before, whose memory is freed.
function hold(name, value) {
  held[name]?.free();
  held[name] = value;
}

function libraryTold(viewing) {
  return { about: JSON.parse(held.library.about(viewing)), json: held.library.json() };
}

const names = (files) => files.map((file) => file.name);

async function contents(files) {
  return Promise.all(files.map(async (file) => new Uint8Array(await file.arrayBuffer())));
}

const calls = {
  async read(files, recipes, references, options) {
    const [bytes, given] = [await contents(files), await contents(references)];
    const extra = recipes ? (await contents([recipes]))[0] : undefined;
    hold("readings", new native.Readings(names(files), bytes, recipes?.name, extra, names(references), given, options));
    return JSON.parse(held.readings.about());
  },
  async spectra(name, files, references, options) {
    const [bytes, given] = [await contents(files), await contents(references)];
    hold(name, native.Readings.spectra(names(files), bytes, names(references), given, options));
    return JSON.parse(held[name].about());
  },
  forget_readings() {
    hold("readings", null);
  },
  async fit(options, surface, viewing) {
    const extra = surface ? (await contents([surface]))[0] : undefined;
    const fit = new native.Fit(held.readings, options, surface?.name, extra);
    const errors = JSON.parse(fit.errors());
    hold("library", fit.library());
    fit.free();
    return { errors, ...libraryTold(viewing) };
  },
  open(name, bytes, viewing) {
    hold("library", new native.Library(name, bytes));
    return libraryTold(viewing);
  },
  shipped(viewing) {
    hold("library", native.Library.van_gogh_oils());
    return libraryTold(viewing);
  },
  about(viewing) {
    return JSON.parse(held.library.about(viewing));
  },
  curves(place) {
    return JSON.parse(held.library.curves(place));
  },
  mix(mixtures) {
    return mixtures.map((mixture) => JSON.parse(held.library.mix(JSON.stringify(mixture))));
  },
  typed(text) {
    hold("targets", native.Targets.typed(text));
    return JSON.parse(held.targets.about());
  },
  async of_file(file) {
    hold("targets", native.Targets.of_file(file.name, (await contents([file]))[0]));
    return JSON.parse(held.targets.about());
  },
  recipes(place, options) {
    return JSON.parse(held.library.recipes(held.targets, place, options));
  },
  report(withReadings, request) {
    return withReadings
      ? held.library.report_with(held.readings, request)
      : held.library.report(request);
  },
  film(request) {
    return JSON.parse(held.film.film(request));
  },
  compare(request) {
    return JSON.parse(held.batch.compare(held.standard, request));
  },
  // As text, which the module of scans reads.
  spots() {
    return held.spots.spots();
  },
  plan(wanted, withLibrary) {
    return JSON.parse(withLibrary ? held.library.plan(wanted) : native.plan(wanted));
  },
  formats() {
    return JSON.parse(native.formats());
  },
};

// Calls are done one after another: objects are used by the calls that follow.
let queue = Promise.resolve();
onmessage = ({ data: { id, call, args } }) => {
  queue = queue.then(async () => {
    try {
      await ready;
      current = id;
      postMessage({ id, result: await calls[call](...args) });
    } catch (error) {
      postMessage({ id, failure: failureOf(error, defect) });
    }
  });
};
