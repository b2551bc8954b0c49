/** What the page and a worker say to each other: the module first, then one request after the other. */

/** The module as a worker gets it: compiled by another one, or gzipped and as base64 text. */
export type ModuleSource = { compiled: WebAssembly.Module } | { base64: string };

/** `request` is the JSON of a `Request`, which the module reads itself. */
export type ToWorker = { module: ModuleSource } | { request: string };

/** The answer to a request, whose digest is compared with that of the native library. */
type Reply = { json: string; refused: boolean; digest: string; numbers: Float64Array; bytes: Uint8Array };

/** First the module that it compiled, for those that start later, or null. A worker that throws is of no use any more. */
export type FromWorker = { ready: WebAssembly.Module | null } | Reply;

/** Its arrays are copies outside of the module's memory, which can change hands. */
type Explorer = { respond(request: string): Reply & { free(): void } };

declare const wasm_bindgen: {
  initSync(options: { module: WebAssembly.Module }): unknown;
  Explorer: new () => Explorer;
};

/** That of a worker: the types are those of pages. */
declare function postMessage(message: FromWorker, transfer: Transferable[]): void;
let explorer: Explorer;

async function compiled(source: ModuleSource): Promise<WebAssembly.Module> {
  if ("compiled" in source) return source.compiled;
  const bytes = Uint8Array.from(atob(source.base64), (letter) => letter.charCodeAt(0));
  const inflated = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(inflated).arrayBuffer());
}

async function start(source: ModuleSource): Promise<void> {
  const module = await compiled(source);
  wasm_bindgen.initSync({ module });
  explorer = new wasm_bindgen.Explorer();
  postMessage({ ready: "compiled" in source ? null : module }, []);
}

function answer(request: string): void {
  const reply = explorer.respond(request);
  const { json, refused, digest, numbers, bytes } = reply;
  reply.free();
  postMessage({ json, refused, digest, numbers, bytes }, [numbers.buffer, bytes.buffer]);
}

globalThis.onmessage = ({ data }: MessageEvent<ToWorker>) => {
  if ("module" in data) start(data.module).catch(reportError);
  else answer(data.request);
};
