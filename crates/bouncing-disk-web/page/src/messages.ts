/** What the page and a worker say to each other. */

/** Where a worker finds the module: compiled by another worker, as base64 text, or at an address beside the page. */
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
