// Prints what the Khronos glTF validator has to say about GLB files, as JSON: a list of messages for each.
import { readFile } from "node:fs/promises";
import validator from "gltf-validator";

const told = {};
for (const path of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(await readFile(path)), { maxIssues: 0 });
  told[path] = report.issues.messages.map(({ severity, code, message, pointer }) => ({
    severity,
    code,
    message,
    pointer,
  }));
}
console.log(JSON.stringify(told));
