/** Views for the development of the shell: each asks the module for something and prints a little of it. */

import { Cancelled, type Context, type State, type View, type ViewName } from "../src/contract";
import type { Request } from "../src/protocol";

function requestsOf(name: ViewName, state: State): Request[] {
  const { system, start } = state;
  const { axial_forcing } = state.diagram;
  switch (name) {
    case "toss":
      return [{ call: "motion", system, start: { kind: "impact", ...start }, periods: 20, samples_per_period: 64 }];
    case "diagram":
      return Array.from({ length: 20 }, (_, part) => ({
        call: "diagram", system, axial_forcing, count: 400, columns: [20 * part, 20 * part + 20], start,
        transient: 100, recorded: 40,
      })); // prettier-ignore
    case "basins":
      return [{ call: "attractors", axial_forcing: 0.45, restitution: system.restitution }];
    case "motor":
      return [{ call: "sheet_of_system", system, mass: state.mass }];
  }
}

function placeholder(name: ViewName, title: string): View {
  let canvas: HTMLCanvasElement | null = null;
  let context: Context | null = null;
  let numbers: Float64Array[] = [];
  let digests: string[] = [];
  const redraw = (): void => {
    const pen = canvas?.getContext("2d");
    if (!canvas || !pen || !context) return;
    const { clientWidth: width, clientHeight: height } = canvas;
    canvas.width = width;
    canvas.height = height;
    pen.fillStyle = context.colour("--stable");
    const points = numbers.flatMap((part) => [...part.subarray(0, 2000)]);
    points.forEach((value, index) => {
      if (Number.isFinite(value)) pen.fillRect((index / points.length) * width, height * (0.5 - 0.4 * Math.tanh(value)), 2, 2);
    });
    canvas.dataset["digests"] = digests.join(" ");
  };
  return {
    name,
    title,
    description: `Placeholder of ${title}`,
    mount(host, given) {
      context = given;
      canvas = document.createElement("canvas");
      canvas.style.cssText = "width:100%;height:100%;min-height:300px;display:block";
      host.append(canvas);
    },
    show(state) {
      const given = context;
      if (given === null) return;
      numbers = [];
      digests = [];
      given.status("computing", "busy");
      given.client
        .series(name, requestsOf(name, state), (response) => {
          numbers.push(response.numbers);
          digests.push(response.digest);
        })
        .then(() => {
          given.status("done");
          redraw();
        })
        .catch((error: unknown) => {
          if (!(error instanceof Cancelled)) given.status(String(error), "error");
        });
    },
    hide() {
      context?.client.cancel(name);
    },
    redraw,
    offers: () => [
      { name: `${name} data`, kind: "json", make: () => Promise.resolve(new Blob([JSON.stringify(digests)])) },
      { name: `${name} data`, kind: "csv", make: () => Promise.resolve(new Blob([digests.join("\n")])) },
    ],
  };
}

export const VIEWS: readonly View[] = [
  placeholder("toss", "Toss and bounce"),
  placeholder("diagram", "Orbit diagram"),
  placeholder("basins", "Basins"),
  placeholder("motor", "Motor"),
];
