/** The page's module and sources without a browser. */

import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { createContext, runInContext } from "node:vm";
import { build } from "esbuild";

/** The page that is tested: that of `cargo xtask explorer`, if EXPLORER_HTML names no other one. */
export const file =
  process.env.EXPLORER_HTML ?? fileURLToPath(new URL("../../../../target/explorer/explorer.html", import.meta.url));

/** What a source file of the page exports. */
export async function sourceOf(path) {
  const entryPoints = [fileURLToPath(new URL(`../src/${path}`, import.meta.url))];
  const { outputFiles } = await build({ entryPoints, write: false, bundle: true, format: "esm", logLevel: "warning" });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString("base64")}`);
}

/** The worker of the page, in this process; `ask` gives the JSON and the arrays of an answer. */
export async function moduleOf() {
  const html = readFileSync(file, "utf8");
  const part = (id) => new RegExp(`<script type="text/plain" id="${id}">([^]*?)</script>`).exec(html)[1];
  let heard;
  const scope = createContext({
    atob, console, fetch, performance, TextDecoder, TextEncoder, URL, WebAssembly,
    postMessage: (message) => heard(message),
  }); // prettier-ignore
  runInContext(part("worker-script"), scope);
  const tell = (data) =>
    new Promise((resolve) => {
      heard = resolve;
      scope.onmessage({ data });
    });
  const started = await tell({ kind: "start", module: { base64: part("module-base64") } });
  if (started.kind !== "ready") throw new Error(started.message);
  return {
    async ask(request) {
      const { kind, json, numbers, bytes, message } = await tell({
        kind: "ask",
        id: 1,
        request: JSON.stringify(request),
      });
      if (kind !== "answer") throw new Error(`${JSON.stringify(request)}: ${json ?? message}`);
      return { json: JSON.parse(json), numbers, bytes };
    },
  };
}
