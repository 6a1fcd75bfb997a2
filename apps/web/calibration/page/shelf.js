// The library at work, the light, and the two engines: one for what must be quick, one for long work.

import { Cancelled, Engine, Refusal } from "./engine.js";
import { $, clearNotice, notice } from "./page.js";

export const quick = new Engine();
export const long = new Engine();
// The module of scans, which is loaded when the first call comes.
export const scans = new Engine("maps/worker.js");

// The library: file name, JSON text, and what it tells of itself. `null` before there is one.
export const shelf = { name: "", json: "", about: null, readings: null };

const listeners = [];

// Calls `listener` whenever the library or the light changes.
export const onChange = (listener) => listeners.push(listener);

export const viewing = () => ({ illuminant: $("light").value, observer: $("observer").value });

// Shows a refusal; a cancellation is none.
export function refuse(error) {
  if (error instanceof Cancelled) return;
  if (error instanceof Refusal) return notice(error.failure);
  if (error?.message && error.hint !== undefined) return notice(error);
  notice({ message: "a defect of the page", causes: [String(error?.message ?? error)], hint: "please report it" });
}

// Makes `name` with this JSON text the library of both engines and of the page.
export async function useLibrary(name, bytes) {
  const args = [name, bytes, JSON.stringify(viewing())];
  const told = await quick.make("library", "open", args);
  await long.make("library", "open", args);
  show(name, told);
}

// The oils that ship.
export async function useShipped() {
  const args = [JSON.stringify(viewing())];
  const told = await quick.make("library", "shipped", args);
  await long.make("library", "shipped", args);
  show("van-gogh-oils.pigments.json", told);
}

// The library that the long engine has just fitted.
export async function useFitted(name, { about, json }) {
  const bytes = new TextEncoder().encode(json);
  const args = [name, bytes, JSON.stringify(viewing())];
  await quick.make("library", "open", args);
  long.keep("library", "open", args);
  show(name, { about, json });
}

function show(name, { about, json }) {
  Object.assign(shelf, { name, json, about });
  tell();
}

function tell() {
  const { about } = shelf;
  $("library-title").textContent = about.title || shelf.name;
  const error = about.evidence ? `, CIEDE2000 ${about.evidence.delta_e.mean.toFixed(2)} on average` : "";
  $("library-facts").textContent = `${about.pigments.length} pigments, ${about.grid}${error}`;
  $("library-save").disabled = $("library-link").disabled = false;
  for (const part of document.querySelectorAll("[data-with-library]")) part.hidden = false;
  for (const part of document.querySelectorAll("[data-needs-library]")) part.hidden = true;
  for (const listener of listeners) listener();
}

// Takes readings that were read, or `null` where there are none any more.
export function useReadings(told) {
  shelf.readings = told;
  if (shelf.about) for (const listener of listeners) listener();
}

// Takes a changed light or observer over.
export async function changeViewing() {
  clearNotice();
  if (!shelf.about) return;
  try {
    shelf.about = await quick.call("about", [JSON.stringify(viewing())]);
    tell();
  } catch (error) {
    refuse(error);
  }
}

let working = false;

// Does long work: shows its stages with the time, lets the user cancel it. Returns its result, or `undefined`
// where it failed or was cancelled.
export async function work(name, does) {
  if (working) return undefined;
  working = true;
  clearNotice();
  const begun = performance.now();
  let stage = name;
  const show = () => {
    const seconds = Math.floor((performance.now() - begun) / 1000);
    $("busy-stage").textContent = seconds > 0 ? `${stage}, ${seconds} s` : stage;
  };
  show();
  $("busy").hidden = false;
  const timer = setInterval(show, 1000);
  try {
    return await does((told) => { stage = `${name}: ${told}`; show(); });
  } catch (error) {
    refuse(error);
    return undefined;
  } finally {
    clearInterval(timer);
    working = false;
    $("busy").hidden = true;
  }
}
