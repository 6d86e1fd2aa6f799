"""alone.py BUILD: compiles each file of a build's compile_commands.json by itself, without writing anything, and lists those
that lean on what another file includes. Files that the build makes are left out."""

import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys


def compiles(entry):
    words = shlex.split(entry["command"])
    words = words[: words.index("-o")] + ["-fsyntax-only", entry["file"]]
    done = subprocess.run(words, cwd=entry["directory"], capture_output=True, text=True)
    return entry["file"], done.returncode == 0, done.stderr


build = pathlib.Path(sys.argv[1]).resolve()
commands = json.loads((build / "compile_commands.json").read_text())
entries = {e["file"]: e for e in commands if build not in pathlib.Path(e["file"]).parents}
with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
    failed = [(file, said) for file, good, said in pool.map(compiles, entries.values()) if not good]
for file, said in failed:
    print(file, said, sep="\n")
print(f"{len(entries) - len(failed)} of {len(entries)} files compile by themselves")
sys.exit(bool(failed))
