// Files that the browser writes.

import { h } from "../shared/dom.ts";

/** Have the browser save a file. */
export function download(name: string, text: string, media = "application/json", binary = false): void {
  const url = URL.createObjectURL(new Blob([binary ? bytesOf(text) : text], { type: media }));
  const link = h("a", { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

/** What a base64 text stands for. */
export function bytesOf(text: string): Uint8Array<ArrayBuffer> {
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) bytes[i] = letters.charCodeAt(i);
  return bytes;
}

/** A name that every file system takes. */
export function fileName(name: string): string {
  return (
    name
      .toLowerCase()
      .replaceAll(/[^\p{L}\p{N}_-]/gu, "-")
      .replaceAll(/^-+|-+$/g, "") || "design"
  );
}
