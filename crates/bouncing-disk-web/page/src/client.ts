/** The `Client` of the contract: a quick worker and a heavy one, each with its own instance of the module. */

import { Cancelled, Refused, type Client } from "./contract";
import type { Refusal, Request, Response } from "./protocol";
import { say, WORDS } from "./words";
import type { FromWorker, ModuleSource, ToWorker } from "./worker";

/** How long (ms) an unwanted answer is waited for before the worker is replaced, which costs about as much. */
const GRACE = 40;
/** Workers that die before they have answered anything, in a row, until the lane gives up. */
const MOST_DEATHS = 3;

/** The texts of the workers' script and of the module, gzipped and in base64. */
export function makeClient(script: string, base64: string): Client {
  const address = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
  const workshop: Workshop = { script: address, module: { base64 } };
  const quick = new Lane(workshop);
  const heavy = new Lane(workshop);
  quick.warm();
  return {
    // A check decides whether a value that somebody types is taken; it waits for nothing but what is under way.
    ask: (slot, request) => quick.ask(quick.begin(slot), request, request.call === "check"),
    async series(slot, requests, each) {
      const turn = heavy.begin(slot);
      let last!: Response<never>;
      for (const [index, request] of requests.entries()) {
        last = await heavy.ask(turn, request);
        each?.(last, index);
      }
      if (turn.over) throw new Cancelled(slot);
      return last;
    },
    cancel: (slot) => {
      quick.cancel(slot);
      heavy.cancel(slot);
    },
  };
}

/** What both lanes share: where the worker's script is, and the module, once one of them has compiled it. */
type Workshop = { readonly script: string; module: ModuleSource };

/** What a slot asks for, until it asks for something else. */
type Turn = { over: boolean };

interface Job {
  readonly turn: Turn;
  readonly request: Request;
  readonly done: (response: Response<never>) => void;
  readonly failed: (error: unknown) => void;
}

/** One honest sentence about a worker's end. */
function sentence(message: string, starting: boolean): Error {
  const what = message.replace(/^(Uncaught )?\w*Error: /, "").replace(/\.$/, "");
  return new Error(say(starting ? WORDS.client.no_start : WORDS.client.broken, { what }));
}

/** A worker that is replaced when what it does is not wanted any more, and the requests that wait for it. */
class Lane {
  private worker: Worker | null = null;
  private ready = false;
  private queue: Job[] = [];
  private running: Job | null = null;
  private deaths = 0;
  private readonly turns = new Map<string, Turn>();

  constructor(private readonly workshop: Workshop) {}

  /** The slot's next turn, which ends the one before. */
  begin(slot: string): Turn {
    this.cancel(slot);
    const turn = { over: false };
    this.turns.set(slot, turn);
    return turn;
  }

  /** Ends the turn of a slot, and the worker with it if it goes on with it for long. */
  cancel(slot: string): void {
    const turn = this.turns.get(slot);
    if (turn === undefined) return;
    this.turns.delete(slot);
    turn.over = true;
    const { running } = this;
    for (const job of [...this.queue, running]) if (job?.turn === turn) job.failed(new Cancelled(slot));
    this.queue = this.queue.filter((job) => job.turn !== turn);
    if (running?.turn !== turn) return;
    setTimeout(() => {
      if (this.running === running) this.replace();
    }, GRACE);
  }

  /** Asks behind the jobs of other slots, so that a long series does not keep them waiting; `first` before them. */
  ask(turn: Turn, request: Request, first = false): Promise<Response<never>> {
    return new Promise((done, failed) => {
      if (turn.over) return failed(new Cancelled(request.call));
      this.queue.splice(first ? 0 : this.queue.length, 0, { turn, request, done, failed });
      this.pump();
    });
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
      if (this.worker === worker) this.fail(event.message || WORDS.client.no_reason);
    };
    this.tell({ module: this.workshop.module });
  }

  private tell(message: ToWorker): void {
    this.worker?.postMessage(message);
  }

  private pump(): void {
    if (this.running !== null || this.queue.length === 0) return;
    this.warm();
    if (!this.ready) return;
    this.running = this.queue.shift() as Job;
    this.tell({ request: JSON.stringify(this.running.request) });
  }

  private hear(message: FromWorker): void {
    if ("ready" in message) {
      if (message.ready !== null) this.workshop.module = { compiled: message.ready };
      this.ready = true;
    } else {
      const { json, refused, numbers, bytes } = message;
      // One that was cancelled has failed already.
      if (refused) this.running?.failed(new Refused(JSON.parse(json) as Refusal));
      else this.running?.done({ json: JSON.parse(json) as never, numbers, bytes });
      Object.assign(this, { running: null, deaths: 0 });
    }
    this.pump();
  }

  private fail(message: string): void {
    const starting = !this.ready;
    const error = sentence(message, starting);
    this.deaths += 1;
    const hopeless = this.deaths >= MOST_DEATHS;
    const victims = [...(starting || hopeless ? this.queue.splice(0) : []), this.running];
    this.replace(hopeless);
    for (const job of victims) job?.failed(error);
  }

  private replace(hopeless = false): void {
    this.worker?.terminate();
    Object.assign(this, { worker: null, ready: false, running: null });
    if (hopeless) this.deaths = 0;
    else this.warm();
    this.pump();
  }
}
