// One worker with the native part: calls in order, stages, cancellation, and its state after a restart.

export class Cancelled extends Error {}

// A refusal of the libraries or of the page: message, causes, hint.
export class Refusal extends Error {
  constructor(failure) {
    super(failure.message);
    this.failure = failure;
  }
}

export class Engine {
  #script;
  #worker = null;
  #waiting = new Map();
  #next = 1;
  // Calls whose effect a new worker needs, by the object they make.
  #kept = new Map();

  // `script` is the file of the worker, beside this one.
  constructor(script = "worker.js") {
    this.#script = script;
  }

  // Whether a call is not answered yet.
  get busy() {
    return this.#waiting.size > 0;
  }

  #start() {
    const worker = new Worker(new URL(this.#script, import.meta.url), { type: "module" });
    worker.onmessage = ({ data }) => {
      const waiting = this.#waiting.get(data.id);
      if (!waiting) return;
      if ("stage" in data) return waiting.stage?.(data.stage);
      this.#waiting.delete(data.id);
      if (!("failure" in data)) return waiting.resolve(data.result);
      waiting.reject(new Refusal(data.failure));
      // The memory of a module that stopped cannot be trusted.
      if (data.failure.fault === "defect" || data.failure.fault === "memory") this.stop();
    };
    worker.onerror = (event) => {
      event.preventDefault?.();
      const failure = {
        message: "the native part of the page does not start", causes: [event.message ?? ""],
        hint: "use a current browser (WebAssembly and module workers), and load the page again",
      };
      for (const waiting of this.#waiting.values()) waiting.reject(new Refusal(failure));
      this.#waiting.clear();
      this.#worker = null;
    };
    this.#worker = worker;
    for (const { call, args } of this.#kept.values()) this.#send(call, args).catch(() => {});
  }

  #send(call, args, stage) {
    const id = this.#next++;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject, stage });
      this.#worker.postMessage({ id, call, args });
    });
  }

  // Calls the native part. `stage` hears the stages.
  call(call, args = [], stage = null) {
    if (!this.#worker) this.#start();
    return this.#send(call, args, stage);
  }

  // Calls the native part to make `object`, which later calls and a new worker need.
  async make(object, call, args = [], stage = null) {
    const result = await this.call(call, args, stage);
    this.keep(object, call, args);
    return result;
  }

  // Remembers how a new worker makes `object`.
  keep(object, call, args) {
    this.#kept.set(object, { call, args });
  }

  // Ends what the worker does. The next call starts another, with the same objects.
  stop() {
    this.#worker?.terminate();
    this.#worker = null;
    for (const waiting of this.#waiting.values()) waiting.reject(new Cancelled());
    this.#waiting.clear();
  }
}
