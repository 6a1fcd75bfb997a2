// The shipped strokes lay the same paint in WebAssembly as on this machine, to the last quantum.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { test } from "node:test";
import { root, web } from "./browser.mjs";
import { digest, initSync } from "../out/replay/impasto_web_replay.js";

// Strokes of every brush; more would take minutes.
const ACTIONS = 60;
const SCRIPTS = ["colour-study", "glaze", "landscape"].map((name) => resolve(root, `paintings/${name}.json`));

test("shipped strokes lay the same paint to the bit", () => {
  const ended = spawnSync(process.env.REPLAY_DIGEST, [String(ACTIONS), ...SCRIPTS], { encoding: "utf8" });
  assert.equal(ended.status, 0, ended.stderr);
  const native = ended.stdout.trim().split("\n");
  assert.equal(new Set(native).size, SCRIPTS.length, "paintings differ");
  initSync({ module: readFileSync(resolve(web, "out/replay/impasto_web_replay_bg.wasm")) });
  const page = SCRIPTS.map((path) => digest(readFileSync(path), ACTIONS));
  assert.deepEqual(page, native);
});
