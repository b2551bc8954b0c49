/**
 * The script of a worker: one instance of the module, which answers one request after the other.
 *
 * The build puts the glue of wasm-bindgen (`--target no-modules`) in front of this file, so that the whole is one
 * classic script: workers that are modules do not start from a page on the disk.
 */

import type { FromWorker, ModuleSource, ToWorker } from "./messages";

interface Reply {
  readonly json: string;
  readonly digest: string;
  readonly refused: boolean;
  numbers(): Float64Array;
  bytes(): Uint8Array;
  free(): void;
}

interface Explorer {
  respond(request: string): Reply;
}

/** The glue's global. */
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
  if ("base64" in source) return WebAssembly.compile(decoded(source.base64));
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
    const { json, digest } = reply;
    if (reply.refused) {
      reply.free();
      say({ kind: "refused", id, json });
      return;
    }
    const numbers = reply.numbers();
    const bytes = reply.bytes();
    reply.free();
    // Both are copies outside of the module's memory, so they can change hands.
    say({ kind: "answer", id, json, digest, numbers, bytes }, [numbers.buffer, bytes.buffer]);
  } catch (error) {
    say({ kind: "failed", id, message: String(error) });
  }
}

scope.onmessage = ({ data }) => {
  if (data.kind === "start") void start(data.module);
  else answer(data.id, data.request);
};
