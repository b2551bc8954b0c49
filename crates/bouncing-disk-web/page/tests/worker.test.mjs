/** Workers that break down or are not wanted any more, and the page from a server. */

import assert from "node:assert/strict";
import { createServer } from "node:http";
import { existsSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { onPage, settled, type, whenAddress, within } from "./browser.mjs";
import { file } from "./module.mjs";

/** With the first of these coefficients of friction the module breaks down, with the second no motion of it ends. */
function breakable() {
  const Original = window.Blob;
  window.Blob = function (parts, options) {
    const tail = `;{
      const { respond } = wasm_bindgen.Explorer.prototype;
      wasm_bindgen.Explorer.prototype.respond = function (request) {
        if (request.includes('"friction":0.06660666')) throw new WebAssembly.RuntimeError("unreachable");
        if (request.includes('"friction":0.07770777') && !request.includes('"check"')) for (;;);
        return respond.call(this, request);
      };
    }`;
    return new Original(options.type === "text/javascript" ? [...parts, tail] : parts, options);
  };
}

onPage("a worker that breaks down is replaced, and one sentence says so", { script: breakable }, async (page) => {
  await type(page, "friction", "0.06660666");
  await page.waitForSelector("#error-friction:not([hidden])");
  assert.match(await page.textContent("#error-friction"), /broke down/);
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

const MEDIA = { html: "text/html", js: "text/javascript", css: "text/css", wasm: "application/wasm" };

test("the split files work from a server, and ask for nothing but themselves", async () => {
  const site = join(dirname(file), "site");
  const server = createServer((request, response) => {
    const name = new URL(request.url, "http://localhost").pathname.slice(1) || "index.html";
    const path = join(site, name);
    if (!existsSync(path)) return response.writeHead(404).end();
    return response.writeHead(200, { "content-type": MEDIA[name.split(".").pop()] }).end(readFileSync(path));
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const to = `http://127.0.0.1:${server.address().port}/`;
  await within({ to, hash: "#view=diagram" }, async (page) => {
    assert.ok(Number(await page.inputValue("#field-axial_forcing")) > 0);
  });
  server.close();
});
