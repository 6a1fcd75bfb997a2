// The browser's storage (OPFS): a copy of the files of the page that should outlive it.
//
// A store is a folder with numbered files and a list, which says which path each of them holds. A
// change is written as new numbered files, then the list in one piece, and only then are those
// removed that no list names. So whatever moment a page ends at, the list names whole files.

const LIST = "list.json";

/** What `does` finds, or `undefined` if it is not there. */
async function found(does) {
  try {
    return await does();
  } catch (error) {
    if (error.name !== "NotFoundError") throw error;
    return undefined;
  }
}

/** One store. Its folder is made by the first write: a full storage can still be read. */
class Store {
  constructor(name) {
    this.name = name;
    this.folder = undefined;
    this.list = { next: 0, files: {} };
  }

  static async open(root, name) {
    const store = new Store(name);
    store.folder = root && (await found(() => root.getDirectoryHandle(name)));
    const list = store.folder && (await found(() => store.folder.getFileHandle(LIST)));
    if (list) {
      try {
        store.list = JSON.parse(await (await list.getFile()).text());
      } catch (error) {
        if (!(error instanceof SyntaxError)) throw error;
      }
    }
    return store;
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

  /** Applies changes, each a path with its content or null. The store lies in the folder `root`. */
  async apply(root, changes) {
    this.folder ??= await root.getDirectoryHandle(this.name, { create: true });
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

/** The folder of the studio in the browser's storage. */
async function studioFolder(create) {
  const top = await navigator.storage.getDirectory();
  return top.getDirectoryHandle("impasto-studio", { create });
}

/**
 * The storage of the page: settings, which all pages share, and the autosaves of this page. `taken`
 * are the files to begin with, among them the autosaves of pages that have ended.
 */
export class Storage {
  static async open() {
    if (!("createWritable" in FileSystemFileHandle.prototype)) {
      throw new Error("this browser cannot write files of its storage");
    }
    const storage = new Storage();
    storage.name = `page-${Date.now()}-${Math.floor(Math.random() * 1e6)}`;
    await hold(`impasto-studio-${storage.name}`);
    storage.root = await found(() => studioFolder(false));
    storage.data = new Store(storage.name);
    storage.taken = await (await Store.open(storage.root, "settings")).read();
    // Files that were adopted and do not lie under the new name yet, and the stores that hold them.
    storage.owed = [];
    storage.ended = [];
    const names = [];
    for await (const name of storage.root?.keys() ?? []) if (name.startsWith("page-")) names.push(name);
    for (const name of names.sort()) {
      if (name === storage.name || !(await hold(`impasto-studio-${name}`))) continue;
      const store = await Store.open(storage.root, name);
      storage.owed.push(...(await store.read()));
      storage.ended.push(name);
    }
    storage.taken.push(...storage.owed);
    // Asked without a question where the browser allows that; refused, it may clear the storage.
    storage.lasts = (await navigator.storage.persist?.().catch(() => false)) ?? false;
    return storage;
  }

  /**
   * Keeps the changes of settings and autosaves. If the storage was cleared, keeps the files that `all`
   * returns instead; returns whether it was.
   */
  async apply(changes, all) {
    try {
      await this.#write(changes);
      return false;
    } catch (error) {
      if (error.name !== "NotFoundError") throw error;
    }
    this.root = undefined;
    this.data = new Store(this.name);
    this.owed = [];
    await this.#write(all());
    return true;
  }

  async #write(changes) {
    const below = (folder) => changes.filter(([path]) => path.startsWith(`${folder}/`));
    const settings = below("/settings");
    const changed = new Set(changes.map(([path]) => path));
    const data = [...this.owed.filter(([path]) => !changed.has(path)), ...below("/data")];
    this.root ??= await studioFolder(true);
    if (settings.length > 0) await this.#writeSettings(settings);
    if (data.length > 0) await this.data.apply(this.root, data);
    this.owed = [];
    // What was adopted lies under the new name now.
    for (const name of this.ended.splice(0)) {
      await this.root.removeEntry(name, { recursive: true }).catch(() => {});
    }
  }

  /** Keeps settings. Another page may have changed the list of them since: it is read again. */
  async #writeSettings(changes) {
    await navigator.locks.request("impasto-studio-settings", async () => {
      const store = await Store.open(this.root, "settings");
      await store.apply(this.root, changes);
    });
  }
}
