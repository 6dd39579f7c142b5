// A folder in memory, and the system calls (WASI preview 1) by which a program reads and writes in it.
"use strict";

const ERRNO = { badf: 8, exist: 20, inval: 28, isdir: 31, noent: 44, notdir: 54, notempty: 55 };
const TYPE = { terminal: 2, folder: 3, file: 4 };
const ROOT = 3; // the descriptor of the only folder that is open from the start

class Exit extends Error {
  constructor(code) {
    super("exit " + code);
    this.code = code;
  }
}

class Folder {
  constructor() {
    this.entries = new Map();
  }
}

class MemoryFile {
  constructor(bytes) {
    this.bytes = bytes;
    this.size = bytes.length;
  }
  read(at, into) {
    const part = this.bytes.subarray(at, Math.min(at + into.length, this.size));
    into.set(part);
    return part.length;
  }
  write(at, from) {
    const end = at + from.length;
    if (end > this.bytes.length) {
      const grown = new Uint8Array(Math.max(end, 2 * this.bytes.length));
      grown.set(this.bytes.subarray(0, this.size));
      this.bytes = grown;
    }
    this.bytes.set(from, at);
    this.size = Math.max(this.size, end);
  }
  content() {
    return this.bytes.subarray(0, this.size);
  }
}

// Files by their path, `cell/images/001.png`.
class Disk {
  constructor() {
    this.root = new Folder();
    this.makeFolder("tmp");
  }
  names(path) {
    const names = [];
    for (const name of path.split("/")) {
      if (name === "..") names.pop();
      else if (name !== "" && name !== ".") names.push(name);
    }
    return names;
  }
  find(path) {
    let node = this.root;
    for (const name of this.names(path)) {
      if (!(node instanceof Folder)) return undefined;
      node = node.entries.get(name);
    }
    return node;
  }
  // The folder that a path is in, and its last name.
  parent(path) {
    const names = this.names(path), last = names.pop();
    const node = this.find(names.join("/"));
    return [node instanceof Folder ? node : undefined, last];
  }
  makeFolder(path) {
    let node = this.root;
    for (const name of this.names(path)) {
      if (!node.entries.has(name)) node.entries.set(name, new Folder());
      node = node.entries.get(name);
    }
    return node;
  }
  put(path, bytes) {
    const names = this.names(path), last = names.pop();
    this.makeFolder(names.join("/")).entries.set(last, new MemoryFile(bytes));
  }
  remove(path) {
    const [folder, name] = this.parent(path);
    if (folder) folder.entries.delete(name);
  }
  bytes(path) {
    const node = this.find(path);
    return node instanceof MemoryFile ? node.content().slice() : undefined;
  }
  // Paths and sizes of all files below a folder.
  list(path) {
    const found = [], node = this.find(path);
    const walk = (node, path) => {
      if (node instanceof MemoryFile) found.push([path, node.size]);
      else for (const [name, child] of node.entries) walk(child, path ? path + "/" + name : name);
    };
    if (node) walk(node, this.names(path).join("/"));
    return found;
  }
}

// Runs the program once; `print` is given what it writes, with the number of the stream. Returns its exit code.
async function runProgram(program, disk, words, environment, print) {
  const encoder = new TextEncoder();
  const decoders = [1, 2].map(() => new TextDecoder());
  const open = new Map([
    [0, { type: TYPE.file, node: new MemoryFile(new Uint8Array(0)), at: 0 }],
    [1, { type: TYPE.file, stream: 1 }],
    [2, { type: TYPE.terminal, stream: 2 }], // so that the program shows how far it is
    [ROOT, { type: TYPE.folder, node: disk.root, path: "" }],
  ]);
  let next = ROOT + 1, memory;
  const view = () => new DataView(memory.buffer);
  const bytes = (at, length) => new Uint8Array(memory.buffer, at, length);
  const text = (at, length) => new TextDecoder().decode(bytes(at, length));
  const wide = (at, value) => view().setBigUint64(at, BigInt(value), true);
  const short = (at, value) => view().setUint32(at, value, true);
  const resolve = (fd, at, length) => {
    const folder = open.get(fd);
    return folder && folder.type === TYPE.folder ? folder.path + "/" + text(at, length) : undefined;
  };
  const numbers = new WeakMap(); // each file's own
  let count = 0;
  const number = (node) => {
    if (!numbers.has(node)) numbers.set(node, ++count);
    return numbers.get(node);
  };
  const type = (node) => (node instanceof Folder ? TYPE.folder : TYPE.file);
  const stat = (node, at) => {
    bytes(at, 64).fill(0);
    if (node) wide(at + 8, number(node));
    view().setUint8(at + 16, node ? type(node) : TYPE.terminal);
    wide(at + 24, 1);
    wide(at + 32, node instanceof MemoryFile ? node.size : 0);
    return 0;
  };
  const parts = function* (list, length) {
    for (let k = 0; k < length; k++) {
      const at = view().getUint32(list + 8 * k, true), size = view().getUint32(list + 8 * k + 4, true);
      yield bytes(at, size);
    }
  };
  const strings = (all) => ({
    sizes(counted, size) {
      short(counted, all.length);
      short(size, all.reduce((sum, one) => sum + one.length, 0));
      return 0;
    },
    get(pointers, at) {
      for (const one of all) {
        short(pointers, at);
        bytes(at, one.length).set(one);
        [pointers, at] = [pointers + 4, at + one.length];
      }
      return 0;
    },
  });
  const zero = (all) => strings(all.map((one) => encoder.encode(one + "\0")));
  const words_ = zero(words), environment_ = zero(environment);
  const calls = {
    args_sizes_get: words_.sizes,
    args_get: words_.get,
    environ_sizes_get: environment_.sizes,
    environ_get: environment_.get,
    sched_yield: () => 0,
    proc_exit: (code) => {
      throw new Exit(code);
    },
    random_get: (at, length) => {
      for (let k = 0; k < length; k += 65536) {
        crypto.getRandomValues(bytes(at + k, Math.min(65536, length - k)));
      }
      return 0;
    },
    clock_time_get: (clock, _precision, at) => {
      const ms = clock === 0 ? Date.now() : performance.now();
      view().setBigUint64(at, BigInt(Math.round(1e3 * ms)) * 1000n, true);
      return 0;
    },
    fd_close: (fd) => (open.delete(fd) ? 0 : ERRNO.badf),
    fd_sync: () => 0,
    fd_prestat_get: (fd, at) => {
      if (fd !== ROOT) return ERRNO.badf;
      short(at, 0);
      short(at + 4, 1);
      return 0;
    },
    fd_prestat_dir_name: (fd, at) => {
      bytes(at, 1).set(encoder.encode("/"));
      return fd === ROOT ? 0 : ERRNO.badf;
    },
    fd_fdstat_get: (fd, at) => {
      const file = open.get(fd);
      if (!file) return ERRNO.badf;
      bytes(at, 24).fill(0);
      view().setUint8(at, file.type);
      // a terminal is told by what it cannot do: seek (2) and tell (5)
      const rights = file.type === TYPE.terminal ? (1n << 30n) - 1n - (1n << 2n) - (1n << 5n) : (1n << 30n) - 1n;
      view().setBigUint64(at + 8, rights, true);
      view().setBigUint64(at + 16, rights, true);
      return 0;
    },
    fd_filestat_get: (fd, at) => (open.has(fd) ? stat(open.get(fd).node, at) : ERRNO.badf),
    fd_read: (fd, list, length, at) => {
      const file = open.get(fd);
      if (!file || !(file.node instanceof MemoryFile)) return file ? ERRNO.isdir : ERRNO.badf;
      let sum = 0;
      for (const part of parts(list, length)) {
        const read = file.node.read(file.at, part);
        [file.at, sum] = [file.at + read, sum + read];
        if (read < part.length) break;
      }
      short(at, sum);
      return 0;
    },
    fd_write: (fd, list, length, at) => {
      const file = open.get(fd);
      if (!file) return ERRNO.badf;
      let sum = 0;
      for (const part of parts(list, length)) {
        if (file.stream) print(file.stream, decoders[file.stream - 1].decode(part, { stream: true }));
        else {
          if (file.appends) file.at = file.node.size;
          file.node.write(file.at, part);
          file.at += part.length;
        }
        sum += part.length;
      }
      short(at, sum);
      return 0;
    },
    fd_seek: (fd, offset, whence, at) => {
      const file = open.get(fd);
      if (!file || !(file.node instanceof MemoryFile)) return ERRNO.badf;
      const to = [0, file.at, file.node.size][whence] + Number(offset);
      if (!(to >= 0)) return ERRNO.inval;
      file.at = to;
      wide(at, to);
      return 0;
    },
    fd_readdir: (fd, at, length, cookie, used) => {
      const folder = open.get(fd);
      if (!folder || folder.type !== TYPE.folder) return ERRNO.badf;
      const all = [...folder.node.entries];
      let sum = 0;
      for (let k = Number(cookie); k < all.length && sum < length; k++) {
        const [name, node] = all[k], encoded = encoder.encode(name);
        const entry = new Uint8Array(24 + encoded.length), fields = new DataView(entry.buffer);
        fields.setBigUint64(0, BigInt(k + 1), true);
        fields.setBigUint64(8, BigInt(number(node)), true);
        fields.setUint32(16, encoded.length, true);
        fields.setUint8(20, type(node));
        entry.set(encoded, 24);
        const part = entry.subarray(0, length - sum);
        bytes(at + sum, part.length).set(part);
        sum += part.length;
      }
      short(used, sum);
      return 0;
    },
    path_open: (fd, _follow, at, length, how, _rights, _inherited, flags, opened) => {
      const path = resolve(fd, at, length);
      if (path === undefined) return ERRNO.badf;
      const [creates, folderOnly, isNew, truncates] = [how & 1, how & 2, how & 4, how & 8];
      let node = disk.find(path);
      if (node && isNew) return ERRNO.exist;
      if (!node) {
        const [folder, name] = disk.parent(path);
        if (!creates || !folder) return ERRNO.noent;
        node = new MemoryFile(new Uint8Array(0));
        folder.entries.set(name, node);
      } else if (folderOnly && !(node instanceof Folder)) return ERRNO.notdir;
      else if (truncates) {
        if (node instanceof Folder) return ERRNO.isdir;
        node.size = 0;
      }
      open.set(next, { type: type(node), node, path, at: 0, appends: flags & 1 });
      short(opened, next++);
      return 0;
    },
    path_filestat_get: (fd, _flags, at, length, into) => {
      const path = resolve(fd, at, length);
      if (path === undefined) return ERRNO.badf;
      const node = disk.find(path);
      return node ? stat(node, into) : ERRNO.noent;
    },
    path_readlink: () => ERRNO.inval, // nothing is a link
    path_create_directory: (fd, at, length) => {
      const path = resolve(fd, at, length);
      if (path === undefined) return ERRNO.badf;
      const [folder, name] = disk.parent(path);
      if (!folder) return ERRNO.noent;
      if (name === undefined || folder.entries.has(name)) return ERRNO.exist;
      folder.entries.set(name, new Folder());
      return 0;
    },
    path_remove_directory: (fd, at, length) => {
      const path = resolve(fd, at, length), node = path === undefined ? undefined : disk.find(path);
      if (!node) return ERRNO.noent;
      if (!(node instanceof Folder)) return ERRNO.notdir;
      if (node.entries.size > 0) return ERRNO.notempty;
      disk.remove(path);
      return 0;
    },
    path_unlink_file: (fd, at, length) => {
      const path = resolve(fd, at, length), node = path === undefined ? undefined : disk.find(path);
      if (!node) return ERRNO.noent;
      if (node instanceof Folder) return ERRNO.isdir;
      disk.remove(path);
      return 0;
    },
    path_rename: (fd, at, length, newFd, newAt, newLength) => {
      const from = resolve(fd, at, length), to = resolve(newFd, newAt, newLength);
      if (from === undefined || to === undefined) return ERRNO.badf;
      const node = disk.find(from), [folder, name] = disk.parent(to), old = disk.find(to);
      if (!node || !folder) return ERRNO.noent;
      if (old instanceof Folder && old.entries.size > 0) return ERRNO.notempty;
      disk.remove(from);
      folder.entries.set(name, node);
      return 0;
    },
  };
  const instance = await WebAssembly.instantiate(program, { wasi_snapshot_preview1: calls });
  memory = instance.exports.memory;
  try {
    instance.exports._start();
  } catch (error) {
    if (error instanceof Exit) return error.code;
    throw error;
  }
  return 0;
}
