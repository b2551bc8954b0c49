/** A worker that is replaced when what it does is not wanted any more, and the requests that wait for it. */

import { Cancelled, Refused } from "./contract";
import type { FromWorker, ModuleSource, ToWorker } from "./messages";
import type { Refusal, Request, Response } from "./protocol";

/** How long (ms) an unwanted answer is waited for before the worker is replaced, which costs about as much. */
const GRACE = 40;
/** Workers that die before they have answered anything, in a row, until the lane gives up. */
const MOST_DEATHS = 3;

/** Requests of one slot, answered in their order. */
export interface Job {
  readonly slot: string;
  readonly requests: readonly Request[];
  readonly each: (response: Response, index: number) => void;
  readonly done: () => void;
  readonly failed: (error: Error) => void;
}

/** What all lanes share: how to make a worker, and the module, once one of them has compiled it. */
export interface Workshop {
  worker(): Worker;
  module(): ModuleSource;
  keep(module: WebAssembly.Module): void;
}

interface Waiting {
  job: Job;
  next: number;
  /** True once the job has been cancelled while its `each` ran. */
  ended: boolean;
}

interface Running {
  id: number;
  waiting: Waiting;
  wanted: boolean;
}

/** One honest sentence about a worker's end. */
function sentence(message: string, starting: boolean): Error {
  const what = message.replace(/^\w*Error: /, "").replace(/\.$/, "");
  return starting
    ? new Error(`The computing module does not start in this browser (${what}); it needs WebAssembly with SIMD.`)
    : new Error(`The computation broke down (${what}); a fresh worker has taken over, and other requests still work.`);
}

export class Lane {
  private worker: Worker | null = null;
  private ready = false;
  private queue: Waiting[] = [];
  private running: Running | null = null;
  private delivering: Waiting | null = null;
  private lastId = 0;
  private deaths = 0;

  constructor(private readonly workshop: Workshop) {}

  /** Adds a job behind the others; `first` before them. The slot's older job ends. */
  add(job: Job, first = false): void {
    this.cancel(job.slot);
    const waiting = { job, next: 0, ended: false };
    if (first) this.queue.unshift(waiting);
    else this.queue.push(waiting);
    this.pump();
  }

  /** Ends the job of a slot, and the worker with it if it goes on with it for long. */
  cancel(slot: string): void {
    const gone = this.queue.filter((waiting) => waiting.job.slot === slot);
    this.queue = this.queue.filter((waiting) => waiting.job.slot !== slot);
    const running = this.running;
    if (running?.wanted && running.waiting.job.slot === slot) {
      running.wanted = false;
      gone.push(running.waiting);
      setTimeout(() => {
        if (this.running === running) this.replace();
      }, GRACE);
    }
    if (this.delivering?.job.slot === slot) {
      this.delivering.ended = true;
      gone.push(this.delivering);
    }
    for (const waiting of gone) waiting.job.failed(new Cancelled(`"${slot}" was cancelled`));
  }

  /** Starts the worker before anything is asked. */
  warm(): void {
    if (this.worker !== null) return;
    const worker = this.workshop.worker();
    this.worker = worker;
    this.ready = false;
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
      if (this.worker === worker) this.hear(data);
    };
    worker.onerror = (event) => {
      event.preventDefault();
      if (this.worker === worker) this.hear({ kind: "failed", id: null, message: event.message || "no reason given" });
    };
    this.tell({ kind: "start", module: this.workshop.module() });
  }

  private tell(message: ToWorker): void {
    this.worker?.postMessage(message);
  }

  private pump(): void {
    if (this.running !== null || this.queue.length === 0) return;
    this.warm();
    if (!this.ready) return;
    const waiting = this.queue.shift();
    const request = waiting?.job.requests[waiting.next];
    if (waiting === undefined) return;
    if (request === undefined) {
      waiting.job.done();
      this.pump();
      return;
    }
    this.lastId += 1;
    this.running = { id: this.lastId, waiting, wanted: true };
    this.tell({ kind: "ask", id: this.lastId, request: JSON.stringify(request) });
  }

  private hear(message: FromWorker): void {
    if (message.kind === "ready") {
      if (message.module !== null) this.workshop.keep(message.module);
      this.ready = true;
      this.pump();
      return;
    }
    if (message.kind === "failed") {
      this.fail(message.message, message.id === null && !this.ready);
      return;
    }
    const running = this.running;
    if (running === null || running.id !== message.id) return;
    this.running = null;
    this.deaths = 0;
    if (running.wanted) this.deliver(running.waiting, message);
    this.pump();
  }

  private deliver(waiting: Waiting, message: Exclude<FromWorker, { kind: "ready" | "failed" }>): void {
    const { job } = waiting;
    this.delivering = waiting;
    try {
      if (message.kind === "refused") {
        job.failed(new Refused(JSON.parse(message.json) as Refusal));
        return;
      }
      const { digest, numbers, bytes } = message;
      job.each({ json: JSON.parse(message.json) as unknown, numbers, bytes, digest }, waiting.next);
    } catch (error) {
      job.failed(error instanceof Error ? error : new Error(String(error)));
      return;
    } finally {
      this.delivering = null;
    }
    if (waiting.ended) return;
    waiting.next += 1;
    if (waiting.next >= job.requests.length) {
      job.done();
      return;
    }
    // Behind the jobs of other slots, so that a long series does not keep them waiting.
    this.queue.push(waiting);
  }

  private fail(message: string, starting: boolean): void {
    const running = this.running;
    this.deaths += 1;
    const error = sentence(message, starting);
    const hopeless = this.deaths >= MOST_DEATHS;
    const victims = starting || hopeless ? this.queue.splice(0) : [];
    if (running?.wanted) victims.push(running.waiting);
    this.replace(hopeless);
    for (const waiting of victims) waiting.job.failed(error);
  }

  private replace(hopeless = false): void {
    this.worker?.terminate();
    this.worker = null;
    this.ready = false;
    this.running = null;
    if (hopeless) this.deaths = 0;
    else this.warm();
    this.pump();
  }
}
