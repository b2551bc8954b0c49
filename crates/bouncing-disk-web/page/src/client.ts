/** The `Client` of the contract: a quick worker and a heavy one, each with its own instance of the module. */

import { Cancelled, Refused, type Client } from "./contract";
import type { Refusal, Request, Response } from "./protocol";
import { say, WORDS } from "./words";
import type { FromWorker, ModuleSource, ToWorker } from "./worker";

/** Where the page has its worker's script and its module. */
export type Source = { script: string; base64: string } | { worker: string; module: string };

/** How long (ms) an unwanted answer is waited for before the worker is replaced, which costs about as much. */
const GRACE = 40;
/** Workers that die before they have answered anything, in a row, until the lane gives up. */
const MOST_DEATHS = 3;

export function makeClient(source: Source): Client {
  const workshop = workshopOf(source);
  const quick = new Lane(workshop);
  const heavy = new Lane(workshop);
  quick.warm();
  const added = (lane: Lane, slot: string, requests: readonly Request[], each: Each = () => {}, first = false) =>
    new Promise<Response<never>>((done, failed) => lane.add({ slot, requests, each, done, failed }, first));
  return {
    // A check decides whether a value that somebody types is taken; it waits for nothing but what is under way.
    ask: (slot, request) => added(quick, slot, [request], undefined, request.call === "check"),
    series: (slot, requests, each) => added(heavy, slot, requests, each as Each),
    cancel: (slot) => {
      quick.cancel(slot);
      heavy.cancel(slot);
    },
  };
}

/** What both lanes share: where the worker's script is, and the module, once one of them has compiled it. */
type Workshop = { readonly script: string; module: ModuleSource };

function workshopOf(source: Source): Workshop {
  if ("worker" in source)
    return { script: source.worker, module: { address: new URL(source.module, document.baseURI).href } };
  const script = URL.createObjectURL(new Blob([source.script], { type: "text/javascript" }));
  return { script, module: { base64: source.base64 } };
}

type Each = (response: Response<never>, index: number) => void;

interface Job {
  readonly slot: string;
  readonly requests: readonly Request[];
  readonly each: Each;
  readonly done: (last: Response<never>) => void;
  readonly failed: (error: Error) => void;
  next?: number;
}

type Running = { readonly id: number; readonly job: Job; wanted: boolean };

/** One honest sentence about a worker's end. */
function sentence(message: string, starting: boolean): Error {
  const what = message.replace(/^\w*Error: /, "").replace(/\.$/, "");
  return new Error(say(starting ? WORDS.client.no_start : WORDS.client.broken, { what }));
}

/** A worker that is replaced when what it does is not wanted any more, and the requests that wait for it. */
class Lane {
  private worker: Worker | null = null;
  private ready = false;
  private queue: Job[] = [];
  private running: Running | null = null;
  private lastId = 0;
  private deaths = 0;

  constructor(private readonly workshop: Workshop) {}

  /** Adds a job behind the others; `first` before them. The slot's older job ends. */
  add(job: Job, first: boolean): void {
    this.cancel(job.slot);
    if (first) this.queue.unshift(job);
    else this.queue.push(job);
    this.pump();
  }

  /** Ends the job of a slot, and the worker with it if it goes on with it for long. */
  cancel(slot: string): void {
    const gone = this.queue.filter((job) => job.slot === slot);
    this.queue = this.queue.filter((job) => job.slot !== slot);
    const running = this.running;
    if (running?.wanted && running.job.slot === slot) {
      running.wanted = false;
      gone.push(running.job);
      setTimeout(() => {
        if (this.running === running) this.replace();
      }, GRACE);
    }
    for (const job of gone) job.failed(new Cancelled(`"${slot}" was cancelled`));
  }

  warm(): void {
    if (this.worker !== null) return;
    const worker = new Worker(this.workshop.script);
    Object.assign(this, { worker, ready: false });
    worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
      if (this.worker === worker) this.hear(data);
    };
    worker.onerror = (event) => {
      event.preventDefault();
      if (this.worker === worker) this.fail(event.message || WORDS.client.no_reason, !this.ready);
    };
    this.tell({ kind: "start", module: this.workshop.module });
  }

  private tell(message: ToWorker): void {
    this.worker?.postMessage(message);
  }

  private pump(): void {
    if (this.running !== null || this.queue.length === 0) return;
    this.warm();
    if (!this.ready) return;
    const job = this.queue.shift() as Job;
    this.lastId += 1;
    this.running = { id: this.lastId, job, wanted: true };
    this.tell({ kind: "ask", id: this.lastId, request: JSON.stringify(job.requests[job.next ?? 0]) });
  }

  private hear(message: FromWorker): void {
    if (message.kind === "failed") return this.fail(message.message, message.id === null && !this.ready);
    const running = this.running;
    if (message.kind === "ready") {
      if (message.module !== null) this.workshop.module = { compiled: message.module };
      this.ready = true;
    } else if (running?.id === message.id) {
      this.deaths = 0;
      // What its `each` asks for waits, and may cancel it.
      if (running.wanted) this.deliver(running, message);
      this.running = null;
    }
    this.pump();
  }

  private deliver(running: Running, message: Exclude<FromWorker, { kind: "ready" | "failed" }>): void {
    const { job } = running;
    const { next = 0 } = job;
    try {
      if (message.kind === "refused") throw new Refused(JSON.parse(message.json) as Refusal);
      const { digest, numbers, bytes } = message;
      const response = { json: JSON.parse(message.json) as never, numbers, bytes, digest };
      job.each(response, next);
      if (!running.wanted) return;
      job.next = next + 1;
      if (job.next >= job.requests.length) job.done(response);
      // Behind the jobs of other slots, so that a long series does not keep them waiting.
      else this.queue.push(job);
    } catch (error) {
      job.failed(error instanceof Error ? error : new Error(String(error)));
    }
  }

  private fail(message: string, starting: boolean): void {
    const running = this.running;
    this.deaths += 1;
    const error = sentence(message, starting);
    const hopeless = this.deaths >= MOST_DEATHS;
    const victims = starting || hopeless ? this.queue.splice(0) : [];
    if (running?.wanted) victims.push(running.job);
    this.replace(hopeless);
    for (const job of victims) job.failed(error);
  }

  private replace(hopeless = false): void {
    this.worker?.terminate();
    Object.assign(this, { worker: null, ready: false, running: null });
    if (hopeless) this.deaths = 0;
    else this.warm();
    this.pump();
  }
}
