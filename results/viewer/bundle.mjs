// Bundles source/ and the libraries it uses into one script and one style sheet, and says what a content security policy
// and a lawyer want to know about them: node bundle.mjs OUT
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { build } from "esbuild";

const out = process.argv[2];
const result = await build({
  entryPoints: ["source/main.js"],
  bundle: true,
  minify: true,
  format: "iife",
  charset: "ascii",
  target: ["chrome103", "firefox113", "safari16.4"],
  legalComments: "none", // the licences follow in full
  loader: { ".css": "css" },
  outdir: out,
  write: false,
});
const text = (ending) => result.outputFiles.find((file) => file.path.endsWith(ending)).text;
const script = text(".js");
if (/<\/script|<!--/i.test(script)) throw new Error("the script would end the element that holds it");
writeFileSync(join(out, "viewer.js"), script);
writeFileSync(join(out, "viewer.css"), text(".css").replaceAll("</", "<\\/"));
writeFileSync(join(out, "viewer.hash"), "sha256-" + createHash("sha256").update(script).digest("base64"));
const licences = Object.keys(JSON.parse(readFileSync("package.json")).dependencies).map((name) => {
  const { version } = JSON.parse(readFileSync(`node_modules/${name}/package.json`));
  return `${name} ${version}\n\n${readFileSync(`node_modules/${name}/LICENSE`, "utf8").trim()}`;
});
writeFileSync(join(out, "licences.txt"), licences.join("\n\n\n"));
