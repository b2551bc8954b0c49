/** What the page and a worker say to each other. */

/** Where a worker finds the module: compiled by another worker, compressed by gzip as base64 text, or at an address beside the page. */
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

interface Reply {
  readonly json: string;
  readonly digest: string;
  readonly refused: boolean;
  /** Copies outside of the module's memory, which can change hands. */
  readonly numbers: Float64Array;
  readonly bytes: Uint8Array;
  free(): void;
}

interface Explorer {
  respond(request: string): Reply;
}

declare const wasm_bindgen: {
  initSync(options: { module: WebAssembly.Module }): unknown;
  Explorer: new () => Explorer;
};

/** The worker's global scope, of which the library for pages has no type. */
interface Scope {
  onmessage: ((event: MessageEvent<ToWorker>) => void) | null;
  postMessage(message: FromWorker, transfer: Transferable[]): void;
}

const scope = globalThis as unknown as Scope;
let explorer: Explorer | null = null;

function say(message: FromWorker, transfer: Transferable[] = []): void {
  scope.postMessage(message, transfer);
}

function decoded(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let index = 0; index < text.length; index++) bytes[index] = text.charCodeAt(index);
  return bytes;
}

async function compiled(source: ModuleSource): Promise<WebAssembly.Module> {
  if ("compiled" in source) return source.compiled;
  if ("base64" in source) {
    const inflated = new Blob([decoded(source.base64)]).stream().pipeThrough(new DecompressionStream("gzip"));
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
