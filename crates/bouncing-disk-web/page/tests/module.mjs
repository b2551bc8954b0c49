/** The module of the page without a browser: requests in, answers out, for tests of what the page says. */

import { readFileSync } from "node:fs";
import { createContext, runInContext } from "node:vm";

/** The worker of a built page, in this process; `ask` gives the JSON and the arrays of an answer. */
export async function moduleOf(file) {
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

