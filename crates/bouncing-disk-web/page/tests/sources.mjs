/** The page's own source, for tests that need what it is made from. */

import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));

/** What a source file of the page exports. */
export async function sourceOf(path) {
  const { outputFiles } = await build({
    entryPoints: [join(here, "../src", path)],
    write: false,
    bundle: true,
    format: "esm",
    logLevel: "warning",
  });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString("base64")}`);
}
