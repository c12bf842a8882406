// Bundle the site's script with what it needs of node_modules: `node scripts/docs/site/bundle.mjs FOLDER` writes live.js
// and live.css there. A page that is opened from a folder loads no module, so it is a classic script.

import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const [folder] = process.argv.slice(2);
if (!folder) throw new Error("expected the folder to write to");

await build({
  entryPoints: [join(here, "live.ts")],
  outdir: folder,
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "utf8",
  legalComments: "linked", // the licences go along
  loader: { ".svg": "dataurl" },
  logLevel: "warning",
});
