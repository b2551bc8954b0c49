/** The `Client` of the contract: a quick worker and a heavy one, each with its own instance of the module. */

import type { Client } from "./contract";
import { Lane } from "./lane";
import type { ModuleSource } from "./messages";
import type { Request, Response } from "./protocol";

/** Where the page has its worker's script and its module. */
export type Source = { script: string; base64: string } | { worker: string; module: string };

/** A check decides whether a value that somebody types is taken; it waits for nothing but what is under way. */
const URGENT: ReadonlySet<Request["call"]> = new Set(["check"]);

export function makeClient(source: Source): Client {
  let compiled: WebAssembly.Module | null = null;
  const address =
    "script" in source ? URL.createObjectURL(new Blob([source.script], { type: "text/javascript" })) : null;
  const workshop = {
    worker: () => new Worker(address ?? (source as { worker: string }).worker),
    module: (): ModuleSource => {
      if (compiled !== null) return { compiled };
      return "script" in source
        ? { base64: source.base64 }
        : { address: new URL(source.module, document.baseURI).href };
    },
    keep: (module: WebAssembly.Module) => {
      compiled = module;
    },
  };
  const quick = new Lane(workshop);
  const heavy = new Lane(workshop);
  quick.warm();
  return {
    ask: (slot, request) =>
      new Promise<Response>((resolve, reject) => {
        quick.add(
          { slot, requests: [request], each: resolve, done: () => {}, failed: reject },
          URGENT.has(request.call),
        );
      }),
    series: (slot, requests, each) =>
      new Promise<void>((resolve, reject) => {
        heavy.add({ slot, requests, each, done: resolve, failed: reject });
      }),
    cancel: (slot) => {
      quick.cancel(slot);
      heavy.cancel(slot);
    },
  };
}
