// build.mjs PACKAGES OUT: bundles src/ with the packages in PACKAGES/node_modules into OUT: page.html, with places for title,
// data and the replay, and replay.js. Nothing in a page may be run but these two scripts: their hashes stand in its policy.
import {createHash} from "node:crypto";
import {readFileSync, readdirSync, existsSync, writeFileSync, mkdirSync} from "node:fs";
import {createRequire} from "node:module";
import {dirname, join, resolve} from "node:path";
import {fileURLToPath} from "node:url";

const [packages, out] = process.argv.slice(2).map((path) => resolve(path));
const here = dirname(fileURLToPath(import.meta.url));
const esbuild = createRequire(join(packages, "package.json"))("esbuild");

async function bundle(entry, define = {}) {
  const result = await esbuild.build({
    entryPoints: [join(here, "src", entry)], bundle: true, minify: true, format: "iife", target: "es2020", charset: "utf8",
    nodePaths: [join(packages, "node_modules")], write: false, metafile: true, legalComments: "none", define,
  });
  const text = result.outputFiles[0].text.trim();
  // Either would end the script early, or hide its end.
  if (/<\/script|<!--/i.test(text)) throw new Error(`${entry}: the bundle holds "</script" or "<!--"`);
  return {text, inputs: Object.keys(result.metafile.inputs)};
}

// Packages of which a bundle holds something, with their licences.
function licences(inputs) {
  const names = new Set(inputs.map((path) => /.*node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(path)?.[1]).filter(Boolean));
  return [...names].sort().map((name) => {
    const folder = join(packages, "node_modules", name);
    const {version, license} = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const file = existsSync(folder) && readdirSync(folder).find((f) => /^licen[cs]e(\.|$)/i.test(f));
    return {name, version, licence: license, text: file ? readFileSync(join(folder, file), "utf8").trim() : ""};
  });
}

const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

const replay = await bundle("replay/main.ts");
const first = await bundle("main.ts", {LICENCES: "[]"});
const page = await bundle("main.ts", {LICENCES: JSON.stringify(licences([...first.inputs, ...replay.inputs]))});
const style = (await esbuild.build({
  entryPoints: [join(here, "src/style.css")], minify: true, write: false, charset: "utf8"})).outputFiles[0].text.trim();
const put = {"@STYLE@": style, "@SCRIPT@": page.text, "@HASHES@": `${hash(page.text)} ${hash(replay.text)}`};
const html = readFileSync(join(here, "src/page.html"), "utf8").replace(/@STYLE@|@SCRIPT@|@HASHES@/g, (name) => put[name]);
mkdirSync(out, {recursive: true});
writeFileSync(join(out, "page.html"), html);
writeFileSync(join(out, "replay.js"), replay.text);
