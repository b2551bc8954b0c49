/** Workers that break down or are not wanted any more. */

import assert from "node:assert/strict";
import { onPage, settled, type, whenAddress } from "./browser.mjs";

/** With the first of these coefficients of friction the module breaks down, with the second no motion of it ends. */
function breakable() {
  const Original = window.Blob;
  window.Blob = function (parts, options) {
    const tail = `;{
      const { respond } = wasm_bindgen.Explorer.prototype;
      wasm_bindgen.Explorer.prototype.respond = function (request) {
        if (request.includes("0.06660666")) throw new WebAssembly.RuntimeError("unreachable");
        if (request.includes("0.07770777") && !request.includes('"check"')) for (;;);
        return respond.call(this, request);
      };
    }`;
    return new Original(options.type === "text/javascript" ? [...parts, tail] : parts, options);
  };
}

onPage("a worker that breaks down is replaced, and one sentence says so", { script: breakable }, async (page) => {
  await type(page, "friction", "0.06660666");
  await page.waitForSelector("#error-friction:not([hidden])");
  assert.match(await page.textContent("#error-friction"), /computation failed/);
  await type(page, "friction", "0.3");
  await whenAddress(page, "friction", "0.3");
  await settled(page);
  assert.equal(await page.isVisible("#error-friction"), false);
});

onPage("a computation without an end is given up", { hash: "#view=diagram", script: breakable }, async (page) => {
  await type(page, "friction", "0.07770777");
  await whenAddress(page, "friction", "0.07770777");
  await page.waitForTimeout(300);
  const began = Date.now();
  await type(page, "friction", "0.3");
  await whenAddress(page, "friction", "0.3");
  await settled(page);
  assert.ok(Date.now() - began < 5000, `${Date.now() - began} ms`);
});
