/** Sentences about what could not be done, until somebody closes them. */

import { element } from "./elements";

/** More than these at once tell nobody anything. */
const MOST = 8;

export class Problems {
  private messages: string[] = [];

  constructor(private readonly host: HTMLElement) {}

  replace(messages: readonly string[]): void {
    this.messages = [...messages];
    this.draw();
  }

  add(message: string): void {
    if (!this.messages.includes(message)) this.messages.push(message);
    this.draw();
  }

  private draw(): void {
    const shown = this.messages.slice(-MOST);
    const rest = this.messages.length - shown.length;
    if (rest > 0) shown.unshift(`${rest} more.`);
    this.host.hidden = shown.length === 0;
    const close = element("button", { type: "button", class: "quiet close", "aria-label": "Close these messages",
      onclick: () => this.replace([]) }, "×"); // prettier-ignore
    this.host.replaceChildren(...shown.map((message) => element("p", {}, message)), close);
  }
}
