/**
 * Builds the page: one file with everything in it.
 *
 *     node build.mjs --wasm MODULE.wasm --glue GLUE.js --out DIR [--words WORDS.json] [--address URL]
 *         [--check: the types first]
 *
 * The glue is what `wasm-bindgen --target no-modules` writes. WORDS.json has all texts of the page, as src/words.json has
 * them in English. The URL is where the page is published, instead of that in index.html.
 */

import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));

const text = { type: "string" };
const { values } = parseArgs({
  options: { wasm: text, glue: text, out: text, words: text, address: text, check: { type: "boolean" } },
});
const { wasm, glue, out, check, address, words = join(here, "src/words.json") } = values;

/** The texts stand in the page by themselves, where an editor finds them. */
const wordsOfThePage = {
  name: "words",
  setup: ({ onLoad }) => {
    // Somebody who edits them there and leaves out a comma reads so, in place of nothing.
    const contents = `let words;
      try { words = JSON.parse(document.getElementById("words").textContent); }
      catch (error) { document.getElementById("main").textContent = "words: " + error.message; throw error; }
      export default words;`;
    onLoad({ filter: /words\.json$/ }, () => ({ contents, loader: "js" }));
  },
};

const licence = readFileSync(join(here, "node_modules/uqr/LICENSE"), "utf8");

/** The text of a script's bundle, and of the style sheets that it imports. */
async function bundled(entry) {
  const { outputFiles } = await build({
    ...{ absWorkingDir: here, entryPoints: [entry], outdir: "unused", write: false, bundle: true, minify: true },
    ...{ charset: "utf8", format: "iife", target: ["es2022"], legalComments: "none" },
    // Whoever passes the page on passes on the licence of what is in it.
    banner: entry === "src/main.ts" ? { js: `/* uqr\n${licence.trim()}\n*/` } : {},
    plugins: [wordsOfThePage],
  });
  const text = (end) => outputFiles.find((file) => file.path.endsWith(end))?.text ?? "";
  return { script: text(".js").trim(), styles: text(".css").trim() };
}

/** What stands in a script element must not end it. */
const inScript = (text) => text.replaceAll(/<\/(script)/gi, "<\\/$1").replaceAll("<!--", "<\\!--");

const sha256 = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

/** Replaced text can have dollar signs in it. */
function filled(html, parts) {
  return Object.entries(parts).reduce((text, [name, part]) => text.replace(`<!-- ${name} -->`, () => part), html);
}

/** Fails where a translation lacks a text of the English one, has another one, or has other values in it. */
function compared(own, english, place) {
  const holes = (text) => [...String(text).matchAll(/\{\w+\}/g)].flat().sort().join();
  const kind = (value) =>
    typeof value === "string" ? "a text" : Object.keys(Object(value)).sort().join() || `${typeof value}`;
  if (kind(own) !== kind(english)) throw new Error(`${place}: ${kind(english)} expected, and not ${kind(own)}`);
  if (kind(english) !== "a text") for (const key of Object.keys(english)) compared(own[key], english[key], `${place}.${key}`);
  else if (holes(own) !== holes(english)) throw new Error(`${place} has to have ${holes(english) || "no values"} in it`);
}

const texts = JSON.parse(readFileSync(words, "utf8"));
compared(texts, JSON.parse(readFileSync(join(here, "src/words.json"), "utf8")), words);
const compiler = join(here, "node_modules/typescript/bin/tsc");
if (check) execFileSync(process.execPath, [compiler, "--noEmit"], { cwd: here, stdio: "inherit" });
/** The published address stands in the page; a page without one does not say that it has one. */
const published = (text) =>
  text.replace(/( *<link rel="canonical" href=")(.*)(" \/>\n)/, (_, before, own, after) => {
    const url = address ?? own;
    return url === "" ? "" : before + new URL(url).href.replaceAll("&", "&amp;") + after;
  });
const source = readFileSync(join(here, "index.html"), "utf8").replace('lang="en"', `lang="${texts.language}"`);
const escaped = (text) => text.replace(/[&<>"]/g, (letter) => `&#${letter.charCodeAt(0)};`);
const named = (path) => escaped(path.split(".").reduce((part, name) => part[name], texts));
const shell = published(source).replace(/\{\{([\w.]+)\}\}/g, (_, path) => named(path));
const page = await bundled("src/main.ts");
const worker = await bundled("src/worker.ts");
const module = readFileSync(wasm);
const workerScript = `${readFileSync(glue, "utf8").trim()}\n${worker.script}\n`;
const pageScript = inScript(page.script);

// No address at all may be asked for anything: the browser itself sees to it.
const policy = `default-src 'none'; base-uri 'none'; form-action 'none'; script-src ${sha256(pageScript)} \
'wasm-unsafe-eval' blob:; worker-src blob:; style-src 'unsafe-inline'; img-src data: blob:; connect-src 'none'`;
const html = filled(shell, {
  policy: `<meta http-equiv="Content-Security-Policy" content="${policy}" />`,
  words: `<script type="application/json" id="words">\n${JSON.stringify(texts, null, 1).replaceAll("<", "\\u003c")}\n</script>`,
  styles: `<style>${page.styles}</style>`,
  scripts:
    `<script type="text/plain" id="worker-script">${inScript(workerScript)}</script>\n` +
    `<script type="text/plain" id="module-base64">${gzipSync(module, { level: 9 }).toString("base64")}</script>\n` +
    `<script>${pageScript}</script>`,
});

mkdirSync(out, { recursive: true });
writeFileSync(join(out, "explorer.html"), html);
const kilobytes = (content) => `${(Buffer.byteLength(content) / 1000).toFixed(1)} kB`;
console.log(`explorer.html ${kilobytes(html)}, ${kilobytes(gzipSync(html, { level: 9 }))} gzipped`);
