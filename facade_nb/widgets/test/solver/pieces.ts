// Before the tests: have Python write the pieces of real traces (tests/widgets/solver/pieces.py).

import { execFileSync } from "node:child_process";
import { existsSync } from "node:fs";
import { join } from "node:path";

const root = join(import.meta.dirname, "../../../..");

export const FOLDER = join(root, "out/pieces");

export default function setup(): void {
  const own = [".venv/bin/python", ".venv/Scripts/python.exe"].map((path) => join(root, path)).find(existsSync);
  execFileSync(own ?? "python3", ["-m", "tests.widgets.solver.pieces", FOLDER], { cwd: root, stdio: "inherit" });
}
