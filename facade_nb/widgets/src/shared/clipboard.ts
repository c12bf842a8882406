// The browser's clipboard: a page may be kept from it, and has none where it is not secure.

/** Put text on the clipboard; whether the browser let us. */
export async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}
