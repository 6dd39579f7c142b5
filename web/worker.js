// The program beside the page: it runs on a disk in memory, one command after the other.
"use strict";

const disk = new Disk();
let program;

const does = {
  async load({ packed }) {
    const whole = new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip")));
    program = await WebAssembly.compile(await whole.arrayBuffer());
  },
  put({ files }) {
    for (const [path, bytes] of files) disk.put(path, new Uint8Array(bytes));
  },
  remove({ path }) {
    disk.remove(path);
  },
  list({ path }) {
    return disk.list(path);
  },
  read({ path }) {
    return disk.bytes(path);
  },
  async run({ words, environment, id }) {
    const said = { 1: "", 2: "" }, began = performance.now();
    const print = (stream, text) => {
      said[stream] += text;
      if (stream === 2) postMessage({ id, progress: text });
    };
    const code = await runProgram(program, disk, ["handeye", ...words], environment || [], print);
    return { code, out: said[1], err: said[2], seconds: (performance.now() - began) / 1e3 };
  },
};

let turn = Promise.resolve();
onmessage = ({ data }) => {
  turn = turn.then(async () => {
    try {
      postMessage({ id: data.id, done: await does[data.does](data) });
    } catch (error) {
      postMessage({ id: data.id, failed: String(error && error.message ? error.message : error) });
    }
  });
};
