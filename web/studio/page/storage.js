// The browser's storage (OPFS): a copy of the files of the page that should outlive it.
//
// A store is a folder with numbered files and a list, which says which path each of them holds. A
// change is written as new numbered files, then the list in one piece, and only then are those
// removed that no list names. So whatever moment a page ends at, the list names whole files.

const LIST = "list.json";

/** One store. */
class Store {
  constructor(folder, list) {
    this.folder = folder;
    this.list = list;
  }

  static async open(root, name) {
    const folder = await root.getDirectoryHandle(name, { create: true });
    let list = { next: 0, files: {} };
    try {
      const file = await (await folder.getFileHandle(LIST)).getFile();
      list = JSON.parse(await file.text());
    } catch (error) {
      if (error.name !== "NotFoundError" && !(error instanceof SyntaxError)) throw error;
    }
    return new Store(folder, list);
  }

  /** Path and content of every file. One that cannot be read is left out. */
  async read() {
    const files = [];
    for (const [path, name] of Object.entries(this.list.files)) {
      try {
        const file = await (await this.folder.getFileHandle(name)).getFile();
        files.push([path, new Uint8Array(await file.arrayBuffer())]);
      } catch (error) {
        console.warn(`${path} was not found in the browser's storage`, error);
      }
    }
    return files;
  }

  async #put(name, content) {
    const handle = await this.folder.getFileHandle(name, { create: true });
    const writable = await handle.createWritable();
    await writable.write(content);
    await writable.close();
  }

  /** Applies changes, each a path with its content or null. */
  async apply(changes) {
    const next = { next: this.list.next, files: { ...this.list.files } };
    const gone = [];
    const made = [];
    try {
      for (const [path, content] of changes) {
        if (next.files[path] !== undefined) gone.push(next.files[path]);
        delete next.files[path];
        if (content !== null) {
          const name = `f${next.next++}`;
          made.push(name);
          await this.#put(name, content);
          next.files[path] = name;
        }
      }
      await this.#put(LIST, JSON.stringify(next));
    } catch (error) {
      for (const name of made) await this.folder.removeEntry(name).catch(() => {});
      this.list.next = next.next;
      throw error;
    }
    this.list = next;
    for (const name of gone) await this.folder.removeEntry(name).catch(() => {});
  }
}

/** Holds a lock of this name until the page ends; false if another page holds it. */
function hold(name) {
  return new Promise((resolve) => {
    navigator.locks
      .request(name, { ifAvailable: true }, (lock) => {
        resolve(lock !== null);
        return lock === null ? undefined : new Promise(() => {});
      })
      .catch(() => resolve(false));
  });
}

/**
 * The storage of the page: settings, which all pages share, and the autosaves of this page. `taken`
 * are the files to begin with, among them the autosaves of pages that have ended.
 */
export class Storage {
  static async open() {
    const top = await navigator.storage.getDirectory();
    const root = await top.getDirectoryHandle("impasto-studio", { create: true });
    const storage = new Storage();
    storage.root = root;
    storage.settings = await Store.open(root, "settings");
    storage.taken = await storage.settings.read();
    storage.ended = [];
    const own = `page-${Date.now()}-${Math.floor(Math.random() * 1e6)}`;
    await hold(`impasto-studio-${own}`);
    const names = [];
    for await (const name of root.keys()) if (name.startsWith("page-")) names.push(name);
    const adopted = [];
    for (const name of names.sort()) {
      if (!(await hold(`impasto-studio-${name}`))) continue;
      const store = await Store.open(root, name);
      adopted.push(...(await store.read()));
      storage.ended.push(name);
    }
    storage.data = await Store.open(root, own);
    // What is adopted is written under the new name before the old one is removed.
    if (adopted.length > 0) await storage.data.apply(adopted);
    for (const name of storage.ended) {
      await root.removeEntry(name, { recursive: true }).catch(() => {});
    }
    storage.taken.push(...adopted);
    // Asked without a question where the browser allows that; refused, it may clear the storage.
    storage.lasts = (await navigator.storage.persist?.().catch(() => false)) ?? false;
    return storage;
  }

  /** Keeps the changes of settings and autosaves. */
  async apply(changes) {
    const below = (folder) => changes.filter(([path]) => path.startsWith(`${folder}/`));
    const settings = below("/settings");
    const data = below("/data");
    if (data.length > 0) await this.data.apply(data);
    if (settings.length > 0) await this.settings.apply(settings);
  }
}
