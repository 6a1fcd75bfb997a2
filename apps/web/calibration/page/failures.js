// Errors of the native parts as the page shows them.

// A refusal of the libraries comes as JSON; anything else is a defect or a lack of memory.
// `defect` is where the native part stopped.
export function failureOf(error, defect) {
  if (typeof error === "string") return JSON.parse(error);
  const memory = error instanceof RangeError || /memory/i.test(`${defect}${error?.message}`);
  if (memory) {
    return {
      message: "the browser has not enough memory for this", causes: [], fault: "memory",
      hint: "give fewer or smaller files, or use the program impasto, which reads large files in pieces",
    };
  }
  if (error instanceof WebAssembly.CompileError || (error instanceof TypeError && !defect)) {
    return {
      message: "the native part of the page does not start", causes: [error.message], fault: "defect",
      hint: "load the page again; a browser older than 2023 may not know its WebAssembly",
    };
  }
  if (error instanceof DOMException) {
    return {
      message: `a file cannot be read: ${error.message}`, causes: [], fault: "environment",
      hint: "choose it again: it may have been moved or changed",
    };
  }
  return {
    message: "a defect of impasto", causes: [defect || String(error?.message ?? error)], fault: "defect",
    hint: "please report it, with the files if you may",
  };
}
