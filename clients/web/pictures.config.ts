import { defineConfig } from "@playwright/test";
import tests from "./playwright.config.js";

/** Pictures of the documents: the same browser, other files. */
export default defineConfig({ ...tests, testDir: "pictures" });
