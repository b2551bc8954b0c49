/** Workers that break down or are not wanted any more; only the fake module does so when it is asked to. */

import assert from "node:assert/strict";
import { createServer } from "node:http";
import { existsSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { after, before, test } from "node:test";
import { file, isFake, launch, opened, ready, settled, type, whenAddress } from "./browser.mjs";

let browser;
before(async () => {
  browser = await launch();
});
after(() => browser.close());

test("a worker that breaks down is replaced, and one sentence says so", { skip: !isFake }, async () => {
  const { page, context, errors } = await opened(browser);
  await settled(page);
  await type(page, "friction", "0.06660666");
  await page.waitForSelector("#error-friction:not([hidden])");
  assert.match(await page.textContent("#error-friction"), /broke down/);
  await type(page, "friction", "0.3");
  await whenAddress(page, "friction", "0.3");
  await settled(page);
  assert.equal(await page.isVisible("#error-friction"), false);
  assert.deepEqual(errors, []);
  await context.close();
});

test("a computation without an end is given up as soon as another one is wanted", { skip: !isFake }, async () => {
  const { page, context, errors } = await opened(browser, { hash: "#view=diagram" });
  await settled(page);
  await type(page, "friction", "0.07770777");
  await whenAddress(page, "friction", "0.07770777");
  await page.waitForTimeout(300);
  const began = Date.now();
  await type(page, "friction", "0.3");
  await whenAddress(page, "friction", "0.3");
  await settled(page);
  assert.ok(Date.now() - began < 5000, `${Date.now() - began} ms`);
  assert.deepEqual(errors, []);
  await context.close();
});

const MEDIA = { html: "text/html", js: "text/javascript", css: "text/css", wasm: "application/wasm" };

test("the split files work from a server, and ask for nothing but themselves", async () => {
  const site = join(dirname(file), "site");
  if (!existsSync(site)) return;
  const server = createServer((request, response) => {
    const name = new URL(request.url, "http://localhost").pathname.slice(1) || "index.html";
    const path = join(site, name);
    if (!existsSync(path)) return response.writeHead(404).end();
    return response.writeHead(200, { "content-type": MEDIA[name.split(".").pop()] }).end(readFileSync(path));
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const origin = `http://127.0.0.1:${server.address().port}`;
  const page = await browser.newPage();
  const [errors, foreign] = [[], []];
  page.on("console", (message) => message.type() === "error" && errors.push(message.text()));
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on(
    "request",
    (request) => /^(data|blob):/.test(request.url()) || request.url().startsWith(origin) || foreign.push(request.url()),
  );
  await page.goto(`${origin}/#view=diagram`);
  await ready(page);
  await settled(page);
  assert.ok(Number(await page.inputValue("#field-axial_forcing")) > 0);
  assert.deepEqual([errors, foreign], [[], []]);
  await page.close();
  server.close();
});
