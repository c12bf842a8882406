import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    environment: "jsdom",
    include: ["{facade_nb/widgets,tests}/**/*.test.ts"],
  },
});
