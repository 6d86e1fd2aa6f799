# Sourced by ./umbsim and ./test: installs what is missing, configures, builds. Sets `root` and `build`.
# Packages by use. Everything comes from Debian.
build_packages="g++ cmake ninja-build pkg-config git libbullet-dev libeigen3-dev liburdfdom-dev libtinyxml2-dev \
libyaml-cpp-dev libcli11-dev libfmt-dev nlohmann-json3-dev libtbb-dev libboost-dev libsqlite3-dev libssl-dev"
test_packages="libgtest-dev libgmock-dev chromium valgrind slurm-wlm munge sqlite3"
bench_packages="libbenchmark-dev libmujoco-dev valgrind"

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build="$root/build/release"

say() { printf 'umbsim: %s\n' "$*" >&2; }

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

# install_missing PACKAGE...
install_missing() {
  command -v dpkg-query > /dev/null || return 0  # not Debian: CMake will name what it misses
  local missing="" package
  for package in "$@"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null)" = installed ] || missing="$missing $package"
  done
  [ -n "$missing" ] || return 0
  say "installing from Debian:$missing"
  local log
  log=$(mktemp)
  if ! { as_root apt-get update -q && as_root env DEBIAN_FRONTEND=noninteractive \
         apt-get install -y -q --no-install-recommends $missing; } > "$log" 2>&1 < /dev/null; then
    tail -n 20 "$log" >&2
    say "could not install:$missing (whole log in $log)"
    return 1
  fi
  rm -f "$log"
}

# quietly COMMAND...: on a terminal as it is; in a pipe only its output if it fails.
quietly() {
  if [ -t 2 ]; then "$@" >&2; return; fi
  local log
  log=$(mktemp)
  if ! "$@" > "$log" 2>&1; then
    tail -n 60 "$log" >&2
    rm -f "$log"
    return 1
  fi
  rm -f "$log"
}

# build_targets TARGET...: configures when needed, says so when there is real work, builds.
build_targets() {
  if [ ! -f "$build/build.ninja" ]; then
    say "configuring and building in build/release; this takes some minutes the first time"
    (cd "$root" && quietly cmake --preset release) || { say "configuring failed"; return 1; }
  fi
  if [ -t 2 ]; then
    # Silent when there is nothing to do.
    (cd "$root" && ninja -C "$build" -n "$@" | grep -q '^\[[0-9]*/[0-9]*\] [BL]') || { quiet_build "$@"; return; }
  fi
  (cd "$root" && quietly ninja -C "$build" "$@") || { say "building failed"; return 1; }
}

quiet_build() {
  (cd "$root" && ninja -C "$build" "$@" > /dev/null) || { say "building failed"; return 1; }
}
