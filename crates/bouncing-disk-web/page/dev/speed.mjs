/**
 * The speed of WebAssembly beside that of the native library, one thread each, in turn, least of twenty:
 *
 *     cargo xtask explorer --digests
 *     cargo build --release --package bouncing-disk-web --features digests --example workloads
 *     node crates/bouncing-disk-web/page/dev/speed.mjs
 */

import { spawn } from "node:child_process";
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { runInThisContext } from "node:vm";

const target = join(dirname(fileURLToPath(import.meta.url)), "../../../../target");
const folder = process.env.EXPLORER_MODULE ?? join(target, "explorer/digests");
const native = process.env.NATIVE_WORKLOADS ?? join(target, "release/examples/workloads");
const ROUNDS = 20;

const glue = readFileSync(join(folder, "bouncing_disk_web.js"), "utf8");
const module = runInThisContext(`(() => { ${glue}; return wasm_bindgen; })()`);
module.initSync({ module: readFileSync(join(folder, "bouncing_disk_web_bg.wasm")) });
const workloads = new module.Workloads();

const child = spawn(native, { stdio: ["pipe", "pipe", "inherit"] });
const answers = createInterface({ input: child.stdout })[Symbol.asyncIterator]();

async function nativeTime(name, size) {
  child.stdin.write(`${name} ${size}\n`);
  return Number((await answers.next()).value);
}

function moduleTime(name, size) {
  const begun = performance.now();
  const count = workloads[name](size);
  return ((performance.now() - begun) / count) * 1e6;
}

for (const [name, size, title] of [
  ["impacts", 200, "W1 in lockstep, an impact"],
  ["cells", 300, "W3, a cell"],
]) {
  const least = [Infinity, Infinity];
  for (let round = 0; round < ROUNDS; round++) {
    least[0] = Math.min(least[0], moduleTime(name, size));
    least[1] = Math.min(least[1], await nativeTime(name, size));
  }
  const [ours, theirs] = least;
  const ratio = (theirs / ours).toFixed(2);
  console.log(`${title}: WebAssembly ${ours.toFixed(1)} ns, native ${theirs.toFixed(1)} ns, speed ${ratio} of native`);
}
child.stdin.end();
