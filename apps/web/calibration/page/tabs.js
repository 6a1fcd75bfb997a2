// The tabs of the page, and what a screen reader is told.

import { $ } from "./page.js";

const NAMES = ["fit", "mix", "recipes", "report", "lab", "scan"];

// Shows the panel `name`; with `focus`, its tab gets the focus.
export function select(name, focus = true) {
  for (const one of NAMES) {
    const tab = $(`tab-${one}`);
    tab.setAttribute("aria-selected", String(one === name));
    tab.tabIndex = one === name ? 0 : -1;
    $(one).hidden = one !== name;
  }
  if (focus) $(`tab-${name}`).focus();
}

export function startTabs() {
  for (const [place, name] of NAMES.entries()) {
    $(`tab-${name}`).addEventListener("click", () => select(name));
    $(`tab-${name}`).addEventListener("keydown", (event) => {
      const to = { ArrowRight: place + 1, ArrowLeft: place - 1, Home: 0, End: NAMES.length - 1 }[event.key];
      if (to === undefined) return;
      event.preventDefault();
      select(NAMES[(to + NAMES.length) % NAMES.length]);
    });
  }
}

// Tells a screen reader, and nobody else.
export function say(text) {
  $("said").textContent = text;
}
