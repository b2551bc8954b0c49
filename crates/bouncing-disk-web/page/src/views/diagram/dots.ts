/** The dots of the diagram: the columns that have come, the picture of them, and the last one until it is replaced. */

import type { Quantity, State } from "../../contract";
import type { Plot } from "../../drawing/axes";
import type { Colours } from "../../drawing/colours";
import type { Pen } from "../../drawing/pen";
import type { Range } from "../../protocol";
import { AutomaticRange } from "./automatic_range";
import { RECORDED } from "./computation";
import type { Columns } from "./computation";
import { OrbitPicture } from "./orbit_picture";

type Diagram = State["diagram"];

export class Dots {
  /** All answers for the present columns, coarse and fine. */
  columns: Columns[] = [];
  /** How many columns there will be. */
  count = 0;
  private complete = false;
  private name = "";
  private drawn = "";
  private shown: OrbitPicture | null = null;
  private previous: OrbitPicture | null = null;
  private readonly automatic = new AutomaticRange();

  range({ range, quantity }: Diagram): Range {
    return range ?? (quantity === "impact_phase" ? [0, 1] : this.automatic.value);
  }

  /** Others are on their way; the picture of the last ones stays until they come. */
  begin(name: string, count: number): void {
    this.name = name;
    this.count = count;
    this.columns = [];
    this.complete = false;
    this.drawn = "";
  }

  take(columns: Columns, diagram: Diagram, rows: number, colour: Colours): void {
    this.columns.push(columns);
    if (this.arrange(diagram, rows, colour)) return;
    this.shown?.add(columns.numbers, columns.from, columns.to, columns.coarse, colour);
  }

  end(diagram: Diagram, rows: number, colour: Colours): void {
    this.complete = true;
    this.previous = null;
    this.arrange(diagram, rows, colour);
  }

  /** Makes the picture of the present quantity and range with all that has come, unless it is there: true if made. */
  arrange(diagram: Diagram, rows: number, colour: Colours): boolean {
    const { quantity } = diagram;
    if (this.complete) this.automatic.settle(this.columns, quantity);
    else this.automatic.follow(this.columns, quantity);
    const range = this.range(diagram);
    const key = JSON.stringify([this.name, quantity, range, rows]);
    if (key === this.drawn || this.count === 0) return false;
    if (this.drawn === "" || this.shown?.quantity !== quantity) this.previous = this.complete ? null : this.shown;
    if (this.previous !== null && this.previous.quantity !== quantity) this.previous = null;
    this.drawn = key;
    this.shown = new OrbitPicture(diagram.axial_forcing, quantity, range, this.count, rows, RECORDED);
    this.fill(this.shown, colour);
    return true;
  }

  recolour(colour: Colours): void {
    this.shown?.recolour(colour);
    this.previous?.recolour(colour);
  }

  paint(pen: Pen, plot: Plot, quantity: Quantity): void {
    this.previous?.paint(pen, plot);
    if (this.shown?.quantity === quantity) this.shown.paint(pen, plot);
  }

  /** The same dots in the colours of print, finely enough for it. */
  paintPrinted(pen: Pen, plot: Plot, diagram: Diagram, colour: Colours): void {
    const count = Math.max(this.count, 2);
    const { axial_forcing, quantity } = diagram;
    const rows = Math.round(count * 0.5);
    const picture = new OrbitPicture(axial_forcing, quantity, this.range(diagram), count, rows, RECORDED);
    this.fill(picture, colour);
    picture.paint(pen, plot);
  }

  private fill(picture: OrbitPicture, colour: Colours): void {
    for (const { numbers, from, to, coarse } of this.columns) picture.add(numbers, from, to, coarse, colour);
  }
}
