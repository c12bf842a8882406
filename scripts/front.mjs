// Build the front end: every facade_nb/widgets/src/entry/<name>.ts becomes one local ES module, <name>.js, and its
// style sheet, <name>.css, in facade_nb/widgets/static. The bundles are committed, so that `pip install .` needs no Node.
//
//   node scripts/front.mjs            write the bundles
//   node scripts/front.mjs --check    say whether the committed bundles are what the sources make; write nothing
//   node scripts/front.mjs --watch    write them again after every change

import { mkdir, readdir, readFile, rm, writeFile } from "node:fs/promises";
import { basename, dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { context } from "esbuild";

const root = dirname(dirname(fileURLToPath(import.meta.url)));
const entries = join(root, "facade_nb/widgets/src/entry");
const out = join(root, "facade_nb/widgets/static");

const list = async (folder) => (await readdir(folder).catch(() => [])).map((name) => join(folder, name));

async function options() {
  const entryPoints = (await list(entries)).filter((path) => path.endsWith(".ts"));
  if (entryPoints.length === 0) throw new Error(`no entry points in ${relative(root, entries)}`);
  return {
    absWorkingDir: root,
    entryPoints,
    outdir: out,
    bundle: true,
    minify: true,
    format: "esm",
    target: "es2022",
    charset: "utf8",
    // The bytes must not depend on the machine that builds: no source maps, no licence files, no paths.
    legalComments: "none",
    loader: { ".glsl": "text", ".svg": "text" },
    logLevel: "warning",
    write: false,
  };
}

async function write(files) {
  await mkdir(out, { recursive: true });
  const kept = new Set(files.map((file) => file.path));
  for (const path of await list(out)) if (!kept.has(path)) await rm(path);
  for (const file of files) {
    await writeFile(file.path, file.contents);
    console.log(`${relative(root, file.path)}  ${(file.contents.length / 1000).toFixed(1)} kB`);
  }
}

/** Name each committed bundle that differs from what the sources make, is missing, or has no source. */
async function stale(files) {
  const made = new Map(files.map((file) => [file.path, Buffer.from(file.contents)]));
  const faults = [];
  for (const [path, contents] of made) {
    const committed = await readFile(path).catch(() => undefined);
    if (committed === undefined) faults.push(`${basename(path)} is missing`);
    else if (!committed.equals(contents)) faults.push(`${basename(path)} is stale`);
  }
  for (const path of await list(out)) if (!made.has(path)) faults.push(`${basename(path)} has no source`);
  return faults;
}

async function report(files) {
  const faults = await stale(files);
  console.log(faults.length ? `${faults.join("\n")}\nrun: make front` : `${files.length} bundles are up to date`);
  process.exitCode = faults.length ? 1 : 0;
}

const mode = process.argv[2];
const finish = mode === "--check" ? report : write;
const build = await context({
  ...(await options()),
  plugins: [
    {
      name: "finish",
      setup({ onEnd }) {
        onEnd(async ({ errors, outputFiles }) => {
          if (errors.length === 0) await finish(outputFiles);
          else process.exitCode = 1; // esbuild has told them
        });
      },
    },
  ],
});

if (mode === "--watch") {
  await build.watch();
} else {
  await build.rebuild().catch(() => {});
  await build.dispose();
}
