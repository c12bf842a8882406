// Waiting in tests: however long it takes, for a busy machine makes a test later, and nothing else.

import { vi } from "vitest";

/** Wait until a check passes. What ends it is the limit of a test, which is for what hangs. */
export const eventually = <T>(check: () => T): Promise<T> => vi.waitFor(check, { timeout: 170_000 });
