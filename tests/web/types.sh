#!/bin/sh
# types.sh WEB TOOLS: TypeScript finds nothing wrong in the pages' sources.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
ln -s "$1/src" "$folder/src"
ln -s "$2/node_modules" "$folder/node_modules"
cp "$1/tsconfig.json" "$1/package.json" "$folder/"
"$2/node_modules/.bin/tsc" -p "$folder" --preserveSymlinks
