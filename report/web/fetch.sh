#!/usr/bin/env bash
# fetch.sh FOLDER [npm ci options]: the packages that the pages are made of, as the lock file says, into FOLDER/node_modules.
# Does nothing where they are there already. The project's own folder stays as it is.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=${1:?usage: $0 FOLDER [npm ci options]}
shift
mkdir -p "$folder"
if ! { cmp -s "$here/package-lock.json" "$folder/fetched.json" && [ -d "$folder/node_modules" ]; }; then
  rm -f "$folder/fetched.json"
  command -v npm > /dev/null || { echo "umbsim: npm is not installed (Debian's packages nodejs and npm)" >&2; exit 1; }
  cp "$here/package.json" "$here/package-lock.json" "$here/.npmrc" "$folder/"
  (cd "$folder" && npm ci --no-progress --loglevel=error "$@") || {
    echo "umbsim: npm cannot be reached, or lacks a package of the pages; -DUMBSIM_PAGES=OFF builds the program without them" >&2
    exit 1
  }
  cp "$here/package-lock.json" "$folder/fetched.json"
fi
for source in package.json package-lock.json .npmrc fetch.sh; do  # a build that asks by time is content
  [ "$folder/fetched.json" -nt "$here/$source" ] || touch "$folder/fetched.json"
done
