import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    environment: "jsdom",
    // Files share a page: making one for each takes longer than most of them. They leave nothing behind in it.
    isolate: false,
    globalSetup: "facade_nb/widgets/test/solver/pieces.ts",
    // A busy machine makes a test later, and nothing else: what ends it is that it hangs.
    testTimeout: 180_000,
    hookTimeout: 180_000,
    include: ["{facade_nb/widgets,tests}/**/*.test.ts"],
  },
});
