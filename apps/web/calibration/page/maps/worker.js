// The module of scans on a thread of its own, where slices of files are read at once.

import { failureOf } from "../failures.js";
import init, * as native from "./impasto_web_scan.js";

const module = new URL("impasto_web_scan_bg.wasm", import.meta.url);
const ready = init({ module_or_path: module }).then(() => native.begin());

let current = 0;
let defect = "";
let scan = null;
// Files of the scan and of its readings, which the module reads by their place.
let files = [];
globalThis.impastoStage = (stage) => postMessage({ id: current, stage });
globalThis.impastoDefect = (text) => { defect = text; };
globalThis.impastoSlice = (place, start, into) => {
  try {
    const slice = files[place].slice(start, start + into.length);
    into.set(new Uint8Array(new FileReaderSync().readAsArrayBuffer(slice)));
  } catch (error) {
    throw String(error.message);
  }
};

const calls = {
  begin() {},
  open(given, reading) {
    scan?.free();
    scan = null;
    files = given;
    scan = new native.Scan(files.map((file) => file.name), files.map((file) => file.size), reading);
    return JSON.parse(scan.about());
  },
  map(name, library, request, every) {
    const mapped = scan.map(name, library, request, every);
    const about = JSON.parse(mapped.about());
    const places = Array.from({ length: mapped.pictures() }, (_, place) => place);
    const pictures = places.map((place) => ({ name: mapped.picture_name(place), bytes: mapped.picture(place) }));
    mapped.free();
    return { about, pictures };
  },
  identify(name, library, spots, request) {
    return JSON.parse(native.identify(name, library, spots, request));
  },
  spot(...sides) {
    return JSON.parse(scan.spot(...sides));
  },
};

// Calls are done one after another.
let queue = Promise.resolve();
onmessage = ({ data: { id, call, args } }) => {
  queue = queue.then(async () => {
    try {
      await ready;
      current = id;
      postMessage({ id, result: calls[call](...args) });
    } catch (error) {
      postMessage({ id, failure: failureOf(error, defect) });
    }
  });
};
