import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    environment: "jsdom",
    globalSetup: "facade_nb/widgets/test/solver/pieces.ts",
    include: ["{facade_nb/widgets,tests}/**/*.test.ts"],
  },
});
