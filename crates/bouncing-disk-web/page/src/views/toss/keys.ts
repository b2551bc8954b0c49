/** The animation by keyboard, for as long as its picture has the focus. */

import type { Player } from "./player";

/** `stepped` is called where the keyboard has chosen another moment. */
export function attachKeys(surface: HTMLElement, player: Player, toggle: () => void, stepped: () => void): void {
  surface.addEventListener("keydown", (event) => {
    const step = event.shiftKey ? 1 : 1 / 16;
    if (event.key === " ") toggle();
    else if (event.key === "ArrowLeft" || event.key === "ArrowRight") {
      player.pause();
      player.seek(player.now + (event.key === "ArrowLeft" ? -step : step));
      stepped();
    } else if (event.key === "Home") {
      player.seek(0);
      stepped();
    } else return;
    event.preventDefault();
  });
}
