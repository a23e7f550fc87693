import tseslint from "typescript-eslint";

export default tseslint.config(
  { ignores: ["**/dist", "**/src/gen", "**/node_modules"] },
  ...tseslint.configs.recommended,
  {
    rules: {
      "@typescript-eslint/no-explicit-any": "error",
      "@typescript-eslint/consistent-type-imports": "error",
      eqeqeq: ["error", "smart"],
      "no-console": "error",
    },
  },
  { files: ["**/examples/**", "**/test/**"], rules: { "no-console": "off" } },
);
