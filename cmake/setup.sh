# shellcheck shell=bash
# Sourced by ./umbsim, ./test and bench/: installs what is missing, configures, builds. Sets `root` and `build`.
# Packages by use. Everything comes from Debian.
build_packages="g++ cmake ninja-build pkg-config git libbullet-dev libeigen3-dev liburdfdom-dev libtinyxml2-dev \
libyaml-cpp-dev libcli11-dev libfmt-dev nlohmann-json3-dev libtbb-dev libboost-dev libsqlite3-dev libssl-dev \
libceres-dev libnlopt-dev libnlopt-cxx-dev libfastcdr-dev libzstd-dev liblz4-dev librosbag-storage-dev"
test_packages="libgtest-dev libgmock-dev chromium valgrind slurm-wlm munge sqlite3 shellcheck libmujoco-dev \
python3"
# Node.js for the pages, unless it is there from elsewhere: other packages of it bring npm along and conflict with Debian's.
if ! { command -v node && command -v npm; } > /dev/null; then build_packages="$build_packages nodejs npm"; fi
# shellcheck disable=SC2034  # used by bench/
bench_packages="libbenchmark-dev libmujoco-dev valgrind"

root=$(cd "${BASH_SOURCE[0]%setup.sh}.." && pwd)
build="$root/build/release"
program="$build/umbsim"
stamp="$build/umbsim.stamp"
first_build=no
dpkg_status="${DPKG_ADMINDIR:-/var/lib/dpkg}/status"

say() { printf 'umbsim: %s\n' "$*" >&2; }

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

# install_missing PACKAGE...
install_missing() {
  command -v dpkg-query > /dev/null || return 0  # not Debian: CMake will name what it misses
  local installed missing="" package
  installed=" $(dpkg-query -W -f '${Package}=${db:Status-Status} ' "$@" 2> /dev/null)" || true  # 1: some are unknown
  for package in "$@"; do
    [[ "$installed" == *" $package=installed "* ]] || missing="$missing $package"
  done
  [ -n "$missing" ] || return 0
  say "installing from Debian:$missing"
  local log
  log=$(mktemp)
  # shellcheck disable=SC2086  # names of packages, split on purpose
  if ! { as_root apt-get update -q && as_root env DEBIAN_FRONTEND=noninteractive \
         apt-get install -y -q --no-install-recommends $missing; } > "$log" 2>&1 < /dev/null 9>&-; then
    tail -n 20 "$log" >&2
    say "could not install:$missing (whole log in $log)"
    return 1
  fi
  rm -f "$log"
}

# quietly COMMAND...: what it says is kept in build.log, and shown if it fails.
quietly() {
  mkdir -p "$build"
  "$@" > "$build/build.log" 2>&1 && return
  show_log
}

# What the tools said: of a compiler from the first failure on, of CMake the end. Always fails.
show_log() {
  if grep '^FAILED: ' "$build/build.log" | grep -qv '^FAILED: build.ninja'; then
    sed -n -e '/^@/d' -e '/^FAILED: /,$p' "$build/build.log" | head -n 100 >&2
  else
    sed '/^@/d' "$build/build.log" | tail -n 60 >&2
  fi
  say "the whole log is in $build/build.log"
  return 1
}

# run_ninja TARGET...: as `quietly`, with a line of progress on a terminal while something is compiled or linked, and
# elsewhere a line every ten per cent of a first build.
run_ninja() {
  local status=0
  if [ -t 2 ]; then
    NINJA_STATUS='@%p ' ninja -C "$build" "$@" 2>&1 | show_progress > "$build/build.log" || status=$?
  elif [ "$first_build" = yes ]; then
    NINJA_STATUS='@%p ' ninja -C "$build" "$@" 2>&1 | say_progress > "$build/build.log" || status=$?
  else
    NINJA_STATUS='@%p ' ninja -C "$build" "$@" > "$build/build.log" 2>&1 || status=$?
  fi
  [ "$status" = 0 ] || show_log
}

# Copies ninja's lines, and makes of those that tell of work one line on the terminal, wiped at the end.
show_progress() {
  local line shown=""
  while IFS= read -r line; do
    printf '%s\n' "$line"
    case "$line" in
      @*Building* | @*Linking* | @*Embedding*) shown=yes; printf '\r\033[Kumbsim: building ... %s' "${line:1:4}" >&2 ;;
    esac
  done
  [ -z "$shown" ] || printf '\r\033[K' >&2
}

# Copies ninja's lines, and says when another tenth of them is done.
say_progress() {
  local line percent tenths=0
  while IFS= read -r line; do
    printf '%s\n' "$line"
    [[ "$line" =~ ^@\ *([0-9]+)% ]] || continue
    percent=${BASH_REMATCH[1]}
    [ $((percent / 10)) -gt "$tenths" ] || continue
    tenths=$((percent / 10))
    say "built $((tenths * 10)) %"
  done
}

# A build folder knows where its project stood when it was configured.
forget_other_place() {
  local cache="$build/CMakeCache.txt"
  [ ! -f "$cache" ] || grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache" || rm -rf "$cache" "$build/build.ninja"
}

# Sets `pages`: ON where the packages of the pages are there or npm gives them, else OFF, and says so.
choose_pages() {
  pages=ON
  "$root/report/web/fetch.sh" "$build/report/pages" --omit=dev > "$build/npm.log" 2>&1 9>&- && return
  pages=OFF
  say "npm cannot be reached: the program is built without pages (report.html), and with them once it can (see $build/npm.log)"
}

# build_targets TARGET...: configures when needed, says so, builds. Silent if there is nothing to do.
# The environment's UMBSIM_WARNINGS_AS_ERRORS is ON or OFF; without it the build folder stays as it is.
build_targets() {
  local strict=${UMBSIM_WARNINGS_AS_ERRORS:-}
  mkdir -p "$build"
  forget_other_place
  choose_pages
  if [ ! -f "$build/build.ninja" ]; then
    first_build=yes
    say "configuring and building in build/release; this takes some minutes the first time"
  elif ! grep -qx "UMBSIM_PAGES:[A-Z]*=$pages" "$build/CMakeCache.txt" ||
       { [ -n "$strict" ] && ! grep -qx "UMBSIM_WARNINGS_AS_ERRORS:[A-Z]*=$strict" "$build/CMakeCache.txt"; }; then
    rm -f "$build/build.ninja"
  fi
  if [ ! -f "$build/build.ninja" ]; then
    (cd "$root" && quietly cmake --preset release -DUMBSIM_PAGES=$pages \
       ${strict:+"-DUMBSIM_WARNINGS_AS_ERRORS=$strict"}) || { say "configuring failed"; return 1; }
  fi
  (cd "$root" && run_ninja "$@") || { say "building failed"; return 1; }
}

# locked COMMAND...: one build at a time in the build folder. The lock is descriptor 9, which ninja inherits: it may
# outlive a launcher that is killed. What a package starts (apt-get) must not.
locked() {
  mkdir -p "$build"
  trap 'exit 130' INT
  (
    trap 'exit 130' INT
    exec 9> "$build/.lock"
    if command -v flock > /dev/null && ! flock -n 9; then
      [ ! -t 2 ] || say "waiting for another build"
      flock 9
    fi
    "$@"
  )
}

# As cmake/WriteCommit.cmake asks for it.
commit() {
  GIT_OPTIONAL_LOCKS=0 git -C "$root" describe --always --dirty=+ --abbrev=12 --exclude='*' 2> /dev/null ||
    echo unknown
}

files_built() { stat -c '%i %s %.9Y' "$program" "$build/build.ninja" 2> /dev/null; }

# True if no file or folder that the program is made of, and no package, changed since the build that left the stamp.
# Its time is that build's beginning. Changes of folders tell of files that came and went. What is not a file's time is
# written in it: the place, the commit that --version shows, and what was built.
program_is_current() {
  [ -x "$program" ] && [ -f "$stamp" ] || return 1
  local said=""
  IFS= read -r -d '' said < "$stamp" || true  # to its end
  [ "${said%$'\n'}" = "$(echo "$root"; commit; files_built)" ] || return 1
  local watched=("$root"/*/CMakeLists.txt) file
  watched=("${watched[@]%/CMakeLists.txt}")
  for file in "$root"/{CMakeLists.txt,CMakePresets.json,CMakeUserPresets.json,cmake} "$dpkg_status"; do
    [ ! -e "$file" ] || watched+=("$file")
  done
  [ -z "$(find "${watched[@]}" -cnewer "$stamp" -print -quit 2>&1)" ]
}

# Builds the program. A stamp is left only by a build that came to its end.
build_program() {
  program_is_current && return  # another launcher has just built it
  rm -f "$stamp"
  # shellcheck disable=SC2086  # names of packages, split on purpose
  install_missing $build_packages || return
  touch "$stamp.begin" || return
  local built_commit
  built_commit=$(commit)
  build_targets umbsim_program || return
  # shellcheck disable=SC2015  # a stamp that cannot be written is none
  (echo "$root"; echo "$built_commit"; files_built) > "$stamp.new" && touch -r "$stamp.begin" "$stamp.new" &&
    mv "$stamp.new" "$stamp" || true
}

# Builds the program and every test. ninja is asked every time: a test that someone removed is built again.
build_all() {
  # shellcheck disable=SC2086  # names of packages, split on purpose
  install_missing $build_packages $test_packages || return
  # GoogleTest may have come after the program was configured.
  [ -f "$build/tests/CTestTestfile.cmake" ] || rm -f "$build/build.ninja"
  build_targets all
}
