// The page: takes a folder, runs the program in a worker, and shows what it says.
"use strict";

const $ = (id) => document.getElementById(id);
const show = (id, on = true) => ($(id).hidden = !on);

// The program.

const source = new Blob([$("worker").textContent], { type: "text/javascript" });
const worker = new Worker(URL.createObjectURL(source));
const waiting = new Map();
let calls = 0, onProgress = () => {};
worker.onmessage = ({ data }) => {
  if ("progress" in data) return onProgress(data.progress);
  const { resolve, reject } = waiting.get(data.id);
  waiting.delete(data.id);
  if ("failed" in data) reject(new Error(data.failed));
  else resolve(data.done);
};
function ask(does, what = {}, transfer = []) {
  return new Promise((resolve, reject) => {
    waiting.set(++calls, { resolve, reject });
    worker.postMessage({ id: calls, does, ...what }, transfer);
  });
}
const packed = Uint8Array.from(atob($("packed").textContent.trim()), (c) => c.charCodeAt(0));
$("packed").remove();
const loaded = ask("load", { packed: packed.buffer }, [packed.buffer]);

// Runs a command; `{code, out, err, seconds}`.
async function run(...words) {
  await loaded;
  return ask("run", { words });
}

// What is going on.

function tell(what, detail = "") {
  show("status");
  show("trouble", false);
  show("bar", false);
  $("what").textContent = what;
  $("detail").textContent = detail;
}
function trouble(what, text) {
  tell(what);
  $("trouble").textContent = text;
  show("trouble");
}
function busy(on) {
  for (const button of document.querySelectorAll("button")) button.disabled = on;
  show("bar", on);
  if (on) $("bar").removeAttribute("value");
}
onProgress = (text) => {
  const found = [...text.matchAll(/(\d+)\/(\d+) *$/gm)].pop();
  if (!found) return;
  $("bar").value = found[1] / found[2];
  $("detail").textContent = `${found[1]} of ${found[2]} captures`;
};
// Work that may fail in a way that nobody foresaw is told as well.
function guarded(work) {
  return async (...given) => {
    busy(true);
    try {
      await work(...given);
    } catch (error) {
      const memory = /memory|allocation|RangeError/i.test(String(error));
      const more = memory ? "\nA page may hold less than a program: use that for files of this size." : "";
      trouble("This did not work.", error.message + more);
    } finally {
      busy(false);
    }
  };
}
const document_ = (said) => {
  try {
    return JSON.parse(said.out);
  } catch {
    return { error: { message: said.err.trim() || said.out.trim() || `exit code ${said.code}` } };
  }
};

// The folder.

let cell = "", result = "";

// Files with their paths out of what was dropped. Browsers differ: some give handles, some entries; a page that was opened
// from a disk may read only the former.
async function filesOf(items) {
  const found = [];
  const ofHandle = async (handle, path) => {
    if (handle.kind === "file") found.push([path, await handle.getFile()]);
    else for await (const child of handle.values()) await ofHandle(child, path + "/" + child.name);
  };
  const ofEntry = async (entry, path) => {
    if (entry.isFile) {
      found.push([path, await new Promise((resolve, reject) => entry.file(resolve, reject))]);
      return;
    }
    const reader = entry.createReader();
    for (;;) {
      const some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject));
      if (some.length === 0) break;
      for (const child of some) await ofEntry(child, path + "/" + child.name);
    }
  };
  // what was dropped is gone once the event is over: all of it is asked for at once
  const files = [...items].filter((item) => item.kind === "file");
  const handles = files.map((item) => item.getAsFileSystemHandle && item.getAsFileSystemHandle());
  const entries = files.map((item) => item.webkitGetAsEntry && item.webkitGetAsEntry());
  const place = (name, isFolder) => (files.length === 1 && isFolder ? name : "cell/" + name);
  for (let k = 0; k < files.length; k++) {
    const handle = handles[k] && (await handles[k].catch(() => null));
    if (handle) await ofHandle(handle, place(handle.name, handle.kind === "directory"));
    else if (entries[k]) await ofEntry(entries[k], place(entries[k].name, entries[k].isDirectory));
  }
  found.sort(([a], [b]) => (a < b ? -1 : 1));
  return found;
}

function cannotRead() {
  throw new Error("This browser does not let a page read what is dropped on it: choose the folder with the button.");
}

async function take(files) {
  if (files.length === 0) return trouble("There are no files in it.", "Drop a folder, or choose one.");
  if (cell) await ask("remove", { path: cell });
  cell = files[0][0].split("/")[0];
  result = "";
  for (const id of ["result", "report", "manifest", "written"]) show(id, false);
  const size = files.reduce((sum, [, file]) => sum + file.size, 0);
  tell(`Reading ${cell}`, `${files.length} files, ${(size / 1e6).toFixed(1)} MB`);
  for (const [path, file] of files) {
    const bytes = await file.arrayBuffer();
    await ask("put", { files: [[path, bytes]] }, [bytes]);
  }
  $("drop").classList.add("small");
  const has = files.some(([path]) => path === `${cell}/handeye.toml`);
  if (has) {
    await readManifest("as the folder has it; it can be changed here", false);
    return calibrate();
  }
  return propose();
}

async function readManifest(asked, isOpen) {
  const bytes = await ask("read", { path: `${cell}/handeye.toml` });
  $("text").value = new TextDecoder().decode(bytes);
  $("asked").textContent = asked;
  $("questions").replaceChildren();
  show("answers", false);
  show("manifest");
  $("manifest").open = isOpen;
}

async function propose() {
  tell(`${cell} has no handeye.toml yet`, "one is written from what is there ...");
  const words = ["init", cell, "--json", "--force"];
  if ($("setup").value) words.push("--setup", $("setup").value);
  if ($("robot").value) words.push("--robot", $("robot").value);
  const found = document_(await run(...words));
  if (found.error) return trouble("The folder cannot be used as it is.", found.error.message);
  await readManifest("", true);
  const open = found.questions || [];
  $("asked").textContent = open.length
    ? `as it is written from what is there; ${open.length} questions are open`
    : "as it is written from what is there; nothing is open";
  for (const { line, question } of open) {
    const item = document.createElement("li"), link = document.createElement("button");
    link.type = "button";
    link.textContent = `line ${line}: ${question}`;
    link.onclick = () => toLine(line);
    item.append(link);
    $("questions").append(item);
  }
  show("answers");
  tell(`${cell}: handeye.toml is proposed`, open.length ? "answer its questions, then calibrate" : "calibrate when it is right");
}

function toLine(line) {
  const lines = $("text").value.split("\n"), before = lines.slice(0, line - 1).join("\n").length + (line > 1);
  $("text").focus();
  $("text").setSelectionRange(before, before + lines[line - 1].length);
  $("text").scrollTop = ((line - 4) / lines.length) * $("text").scrollHeight;
}

// The calibration.

async function writeManifest() {
  const bytes = new TextEncoder().encode($("text").value);
  await ask("put", { files: [[`${cell}/handeye.toml`, bytes.buffer]] }, [bytes.buffer]);
}

async function calibrate() {
  await writeManifest();
  for (const id of ["result", "report", "found"]) show(id, false);
  tell(`Calibrating ${cell}`);
  show("bar");
  result = `${cell}-result`;
  await ask("remove", { path: result });
  const said = await run("calibrate", cell, "--out", result, "--json");
  const found = document_(said);
  if (found.error) {
    result = "";
    return trouble("The folder cannot be calibrated as it is.", found.error.message);
  }
  await showResult(found, said.seconds);
}

async function showResult(found, seconds) {
  tell(`${cell}: ${found.captures.length} captures`, `in ${seconds.toFixed(1)} s`);
  show("result");
  const page = await ask("read", { path: `${result}/report.html` });
  const frame = $("report");
  frame.onload = () => {
    const fit = () => (frame.style.height = frame.contentDocument.documentElement.scrollHeight + "px");
    fit();
    new ResizeObserver(fit).observe(frame.contentDocument.body);
  };
  frame.srcdoc = new TextDecoder().decode(page);
  show("report");
}

async function check() {
  await writeManifest();
  tell(`Looking for mistakes in ${cell}`);
  show("bar");
  const said = await run("check", cell);
  tell(`${cell}: what the captures say of the manifest`);
  $("trouble").textContent = (said.out + said.err).trim();
  show("trouble");
}

async function example() {
  if (cell) await ask("remove", { path: cell });
  tell("The example: twelve images and scans of a board, and sixteen touched points");
  show("bar");
  for (const id of ["result", "report", "manifest"]) show(id, false);
  const said = await run("demo", "--out", "example", "--json"), found = document_(said);
  if (found.error) return trouble("The example does not run.", found.error.message);
  [cell, result] = ["example/dataset", "example"];
  $("drop").classList.add("small");
  await readManifest("of the example; it can be changed here", false);
  await showResult(found, said.seconds);
}

// Files out of it.

function save(name, bytes) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([bytes]));
  link.download = name.split("/").pop();
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
async function saveFile(path) {
  save(path, await ask("read", { path }));
}
async function saveFormat() {
  await ask("remove", { path: "exported" });
  const said = await run("export", result, "--format", $("format").value, "--out", "exported", "--json");
  const found = document_(said);
  if (found.error) {
    $("found").textContent = found.error.message;
    return show("found");
  }
  show("found", false);
  for (const [path] of await ask("list", { path: "exported" })) await saveFile(path);
}
async function listFormats() {
  for (const name of document_(await run("export", "--format", "list", "--json")).formats) {
    $("format").add(new Option(name, name));
  }
  for (const name of ["abb", "denso", "doosan", "fanuc", "kawasaki", "kuka", "staubli", "ur", "yaskawa"]) {
    $("robot").add(new Option(name, name));
  }
}

// Any other command.

async function command(line) {
  const words = [...line.matchAll(/"([^"]*)"|'([^']*)'|(\S+)/g)].map((m) => m[1] ?? m[2] ?? m[3]);
  if (words[0] === "handeye") words.shift();
  const before = new Map(await ask("list", { path: "" }));
  const said = await run(...words);
  $("output").textContent = (said.out + said.err).replace(/[^\n]*\r/g, "").trim() || `exit code ${said.code}`;
  show("output");
  $("written").replaceChildren();
  for (const [path, size] of await ask("list", { path: "" })) {
    if (before.get(path) === size || path.split("/").some((name) => name.startsWith("."))) continue;
    const item = document.createElement("li"), link = document.createElement("button");
    link.type = "button";
    link.textContent = `${path} (${(size / 1e3).toFixed(1)} kB)`;
    link.onclick = guarded(() => saveFile(path));
    item.append(link);
    $("written").append(item);
  }
  show("written");
}

// What a person does.

const taken = guarded(take), proposed = guarded(propose);
addEventListener("dragover", (event) => {
  event.preventDefault();
  $("drop").classList.add("over");
});
addEventListener("dragleave", () => $("drop").classList.remove("over"));
addEventListener("drop", (event) => {
  event.preventDefault();
  $("drop").classList.remove("over");
  // asked for here: once the event is over, nothing is left of it
  const files = filesOf(event.dataTransfer.items);
  guarded(async () => take(await files.catch(() => cannotRead())))();
});
$("choose").onclick = () => $("folder").click();
$("folder").onchange = () => taken([...$("folder").files].map((file) => [file.webkitRelativePath || `cell/${file.name}`, file]));
$("example").onclick = guarded(example);
$("calibrate").onclick = guarded(calibrate);
$("check").onclick = guarded(check);
$("setup").onchange = $("robot").onchange = () => proposed();
$("save-json").onclick = guarded(() => saveFile(`${result}/calibration.json`));
$("save-page").onclick = guarded(() => saveFile(`${result}/report.html`));
$("save-format").onclick = guarded(saveFormat);
$("shell").onsubmit = (event) => {
  event.preventDefault();
  guarded(command)($("line").value);
};
guarded(listFormats)();
