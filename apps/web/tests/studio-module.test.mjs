// The module of the studio's page, without a browser.

import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { test } from "node:test";

const there = (folder) => existsSync(new URL(`../out/studio/${folder}`, import.meta.url));

for (const folder of ["webgpu", "webgl"]) {
  if (folder === "webgpu" && !there(folder) && there("webgl")) continue; // A page built for tests alone.
  test(`the module for ${folder} has no relaxed vectors: every engine loads it, and letters are whole`, () => check(folder));
}

async function check(folder) {
  const file = new URL(`../out/studio/${folder}/impasto_web_studio_bg.wasm`, import.meta.url);
  // The compiler lists what the module needs in a section of its own. It may use relaxed instructions in
  // all functions as soon as one asks for them; then the left parts of letters were lost.
  const module = await WebAssembly.compile(await readFile(file));
  const [section] = WebAssembly.Module.customSections(module, "target_features");
  assert.ok(section, "the module tells what it needs");
  const needed = new TextDecoder().decode(section);
  assert.match(needed, /\+.?simd128/);
  assert.doesNotMatch(needed, /relaxed/);
}
