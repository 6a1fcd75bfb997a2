// Small ENVI scans, simulated from the program's spectra.

import { resolve } from "node:path";
import { program, root } from "./browser.mjs";

const measurements = resolve(root, "measurements");
const library = "van-gogh-oils.pigments.json";

// Mixtures whose patches lie side by side in a scan.
const MIXTURES = [
  ["Zinc White=8", "Cobalt Blue=1"], ["Zinc White=4", "Viridian=1"], ["Lead White=6", "Vermilion=1"],
  ["Zinc White=5", "Cobalt Blue=1", "Vermilion=0.5"], ["Zinc White=1"], ["Viridian=1", "Zinc White=1"],
];

// Numbers from 0 to 1, always the same.
function* chance() {
  for (let state = 12345; ; ) {
    state = (Math.imul(state, 1103515245) + 12345) & 0x7fffffff;
    yield state / 0x7fffffff;
  }
}

// Wavelengths and reflectances of `samples` x `lines` pixels: patches of paint with a little noise.
export function painted(samples = 64, lines = 48) {
  const spectra = MIXTURES.map((parts) => JSON.parse(program(measurements, "mix", library, ...parts, "--json")));
  const nm = spectra[0].wavelengths_nm;
  const noise = chance();
  const pixels = [];
  for (let line = 0; line < lines; line++) {
    for (let sample = 0; sample < samples; sample++) {
      const patch = Math.floor((sample * 3) / samples) + 3 * Math.floor((line * 2) / lines);
      pixels.push(spectra[patch].reflectance.map((value) => value * (1 + 0.004 * (noise.next().value - 0.5))));
    }
  }
  // A pixel that marks no data, and one that no paint has.
  pixels[5] = nm.map(() => -1);
  pixels[70] = nm.map((_, band) => (band % 2 ? 0.9 : 0.05));
  return { nm, pixels, samples, lines };
}

const TYPES = {
  2: [2, "Int16"], 4: [4, "Float32"], 5: [8, "Float64"], 12: [2, "Uint16"],
};

// Header and data of a scan. `more` are lines of the header, `scale` is what a white reads.
export function envi({ nm, pixels, samples, lines }, { interleave = "bil", type = 4, order = 0, scale = 1, more = [] } = {}) {
  const [bytes, name] = TYPES[type];
  const data = Buffer.alloc(pixels.length * nm.length * bytes);
  const view = new DataView(data.buffer, data.byteOffset, data.length);
  const bands = nm.length;
  for (const [place, pixel] of pixels.entries()) {
    const [line, sample] = [Math.floor(place / samples), place % samples];
    for (const [band, value] of pixel.entries()) {
      const number = {
        bsq: (band * lines + line) * samples + sample,
        bil: (line * bands + band) * samples + sample,
        bip: (line * samples + sample) * bands + band,
      }[interleave];
      const stored = type === 4 || type === 5 ? value * scale : Math.round(value * scale);
      view[`set${name}`](number * bytes, stored, order === 0);
    }
  }
  const header = [
    "ENVI", `samples = ${samples}`, `lines = ${lines}`, `bands = ${bands}`, "header offset = 0", "file type = ENVI Standard",
    `data type = ${type}`, `interleave = ${interleave}`, `byte order = ${order}`, "wavelength units = Nanometers",
    `wavelength = {${nm.join(", ")}}`, ...more,
  ].join("\n");
  return { header: `${header}\n`, data };
}
