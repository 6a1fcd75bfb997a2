// The pages served on this machine, and a browser to look at them.

import { spawn, spawnSync } from "node:child_process";
import { existsSync, mkdirSync } from "node:fs";
import { dirname, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

export const web = resolve(dirname(fileURLToPath(import.meta.url)), "..");
export const root = resolve(web, "../..");
export const pictures = resolve(web, "out/pictures");

// The browser of the system: none is fetched.
export const browserPath = ["chromium", "chromium-browser", "google-chrome"]
  .map((name) => `/usr/bin/${name}`)
  .find((path) => existsSync(process.env.CHROMIUM ?? path));

// Starts `apps/web/serve` on a free port. Returns the address of the page `name`, and how to end the server.
export async function served(name) {
  const server = spawn(resolve(web, "serve"), ["0"], { stdio: ["ignore", "pipe", "inherit"] });
  const address = await new Promise((found, failed) => {
    let told = "";
    server.stdout.on("data", (data) => {
      told += data;
      const line = told.split("\n").find((one) => one.endsWith(`/${name}/`));
      if (line) found(line);
    });
    server.on("exit", (code) => failed(new Error(`apps/web/serve ended with ${code} before it served ${name}`)));
  });
  return { address, end: () => server.kill() };
}

export async function launched(args = []) {
  mkdirSync(pictures, { recursive: true });
  const executablePath = process.env.CHROMIUM ?? browserPath;
  return chromium.launch({ executablePath, args: ["--no-sandbox", ...args] });
}

// What the program prints, run in `folder`.
export function program(folder, ...words) {
  const path = process.env.IMPASTO ?? resolve(root, "target/debug/impasto");
  const ended = spawnSync(path, words, { cwd: folder, encoding: "utf8", maxBuffer: 1 << 28 });
  if (ended.status !== 0) throw new Error(`${path} ${words.join(" ")}: ${ended.error ?? ended.stderr}`);
  return ended.stdout;
}
