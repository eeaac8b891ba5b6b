/// <reference types="node" />
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { defineConfig, type Plugin } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

const HERE = import.meta.dirname;
const SHIPPED = ["three", "fflate"];

/** Lets only the page's own script and style run, by their hashes, and puts the licences of what it holds on top. */
function sealed(): Plugin {
  return {
    name: "sealed",
    enforce: "post",
    generateBundle: {
      order: "post",
      handler(_, bundle) {
        for (const file of Object.values(bundle)) {
          if (file.type === "asset" && file.fileName.endsWith(".html")) file.source = seal(String(file.source));
        }
      },
    },
  };
}

function seal(page: string): string {
  const hashes = (tag: string): string =>
    [...page.matchAll(new RegExp(`<${tag}(?![^>]*octet-stream)[^>]*>([\\s\\S]*?)</${tag}>`, "g"))]
      .map(([, content]) => `'sha256-${createHash("sha256").update(content!).digest("base64")}'`)
      .join(" ");
  const policy = [
    "default-src 'none'",
    `script-src ${hashes("script")}`,
    `style-src ${hashes("style")}`,
    "img-src data: blob:",
    "base-uri 'none'",
    "form-action 'none'",
  ].join("; ");
  return page
    .replace(
      '<meta charset="utf-8">',
      (charset) => `${charset}\n    <meta http-equiv="Content-Security-Policy" content="${policy}">`,
    )
    .replace("<!doctype html>", (doctype) => `${doctype}\n${licences()}`);
}

function licences(): string {
  const texts = SHIPPED.map((name) => {
    const { version } = JSON.parse(readFileSync(resolve(HERE, `node_modules/${name}/package.json`), "utf8"));
    const licence = readFileSync(resolve(HERE, `node_modules/${name}/LICENSE`), "utf8").trim();
    return `${name} ${version}\n\n${licence}`;
  });
  return `<!--\nThis page holds:\n\n${texts.join("\n\n")}\n-->`.replace(/\r\n/g, "\n");
}

export default defineConfig({
  plugins: [viteSingleFile(), sealed()],
  build: { outDir: resolve(HERE, "../src/genc/world/player"), emptyOutDir: true, target: "es2022" },
});
