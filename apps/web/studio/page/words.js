// Texts of the page itself, which are shown before the studio speaks and after it has ended.

const GERMAN = {
  "The studio is loading.": "Das Atelier wird geladen.",
  "This browser has neither WebGPU nor WebGL 2, one of which the studio draws with. Turn on hardware acceleration in its settings, or use a newer browser.":
    "Dieser Browser hat weder WebGPU noch WebGL 2; mit einem von beiden zeichnet das Atelier. Die Hardwarebeschleunigung in seinen Einstellungen einschalten oder einen neueren Browser benutzen.",
  "This browser does not know the instructions that the studio is made of (WebAssembly with SIMD). Use a newer browser.":
    "Dieser Browser kennt die Befehle nicht, aus denen das Atelier besteht (WebAssembly mit SIMD). Einen neueren Browser benutzen.",
  "The studio cannot start": "Das Atelier kann nicht starten",
  "The studio has ended by an error in it. What was autosaved is offered when the page is loaded again.":
    "Das Atelier ist durch einen eigenen Fehler beendet. Was automatisch gesichert ist, wird angeboten, wenn die Seite neu geladen wird.",
  "Load again": "Neu laden",
};

/** The text in the language of the browser. */
export const said = (text) => (navigator.language.startsWith("de") ? GERMAN[text] : undefined) ?? text;
