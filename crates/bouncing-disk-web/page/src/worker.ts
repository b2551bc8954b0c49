/** What the page and a worker say to each other. */

/** Where a worker finds the module: compiled by another one, as gzipped base64 text, or at an address. */
export type ModuleSource = { compiled: WebAssembly.Module } | { base64: string } | { address: string };

export type ToWorker =
  | { kind: "start"; module: ModuleSource }
  /** `request` is the JSON of a `Request`, which the module reads itself. */
  | { kind: "ask"; id: number; request: string };

export type FromWorker =
  /** `module` is there if this worker compiled it, for those that start later. */
  | { kind: "ready"; module: WebAssembly.Module | null }
  | { kind: "answer"; id: number; json: string; digest: string; numbers: Float64Array; bytes: Uint8Array }
  | { kind: "refused"; id: number; json: string }
  /** `id` is null where the worker could not even start. The worker is of no use any more. */
  | { kind: "failed"; id: number | null; message: string };

/** Its arrays are copies outside of the module's memory, which can change hands. */
type Reply = Omit<Extract<FromWorker, { kind: "answer" }>, "kind" | "id"> & { refused: boolean; free(): void };
type Explorer = { respond(request: string): Reply };

declare const wasm_bindgen: {
  initSync(options: { module: WebAssembly.Module }): unknown;
  Explorer: new () => Explorer;
};

/** The worker's global scope, of which the library for pages has no type. */
const scope = globalThis as unknown as {
  onmessage: ((event: MessageEvent<ToWorker>) => void) | null;
  postMessage(message: FromWorker, transfer: Transferable[]): void;
};
let explorer: Explorer | null = null;

const say = (message: FromWorker, transfer: Transferable[] = []): void => scope.postMessage(message, transfer);

async function compiled(source: ModuleSource): Promise<WebAssembly.Module> {
  if ("compiled" in source) return source.compiled;
  if ("base64" in source) {
    const bytes = Uint8Array.from(atob(source.base64), (letter) => letter.charCodeAt(0));
    const inflated = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return WebAssembly.compile(await new Response(inflated).arrayBuffer());
  }
  const response = await fetch(source.address);
  if (!response.ok) throw new Error(`${source.address} is not there (status ${response.status})`);
  // Not compileStreaming: some static hosts send the module with another media type.
  return WebAssembly.compile(await response.arrayBuffer());
}

async function start(source: ModuleSource): Promise<void> {
  try {
    const module = await compiled(source);
    wasm_bindgen.initSync({ module });
    explorer = new wasm_bindgen.Explorer();
    say({ kind: "ready", module: "compiled" in source ? null : module });
  } catch (error) {
    say({ kind: "failed", id: null, message: String(error) });
  }
}

function answer(id: number, request: string): void {
  try {
    if (explorer === null) throw new Error("the module has not started");
    const reply = explorer.respond(request);
    const { json, digest, refused, numbers, bytes } = reply;
    reply.free();
    if (refused) say({ kind: "refused", id, json });
    else say({ kind: "answer", id, json, digest, numbers, bytes }, [numbers.buffer, bytes.buffer]);
  } catch (error) {
    say({ kind: "failed", id, message: String(error) });
  }
}

scope.onmessage = ({ data }) => {
  if (data.kind === "start") void start(data.module);
  else answer(data.id, data.request);
};
