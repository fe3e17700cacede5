# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
#
# From a bare Debian 12 machine to a Release build: shared by run-study, run-tests and .ci/run, which source it after
# setting `root`. Everything said here goes to stderr, because a study's last line of stdout is for scripts to read.

build="$root/build/release"

say() { printf 'drawpoint: %s\n' "$*" >&2; }
die() { say "$@"; exit 1; }

# What cmake/packages.txt and the arguments name and dpkg does not have installed, one per line.
missing_packages() {
  local wanted
  wanted=$({ sed 's/#.*//' "$root/cmake/packages.txt"; printf '%s\n' "$@"; } | xargs -n1 | sort -u)
  # shellcheck disable=SC2086
  comm -23 <(printf '%s\n' "$wanted") \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $wanted 2>/dev/null | sed -n 's/^installed //p' | sort -u)
}

# apt_get ARGS...: apt-get as root, never asking. Its thousands of lines are shown only when it fails.
apt_get() {
  local as_root=() log code=0
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  log=$(mktemp)
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=120 -o Dpkg::Use-Pty=0 "$@" \
    </dev/null >"$log" 2>&1 || code=$?
  [ "$code" -eq 0 ] || cat "$log" >&2
  rm -f "$log"
  return "$code"
}

# install_packages [EXTRA...]: installs what is missing from the list and the extras. Quick when nothing is.
install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    [ -f "$build/build.ninja" ] || say "this is not a Debian system: install what cmake/packages.txt names with your own package manager"
    return 0
  fi
  local extra=("$@") missing
  command -v npm >/dev/null || extra+=(npm ca-certificates) # npm fetches the report's plotting library over https
  mapfile -t missing < <(missing_packages "${extra[@]}")
  [ ${#missing[@]} -gt 0 ] || return 0

  say "installing the Debian packages that the build needs and this machine lacks: ${missing[*]}"
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || die "installing them needs root and there is no sudo; run as root: apt-get install ${missing[*]}"
    say "using sudo, for apt-get only"
  fi
  say "this takes a minute or two, once"
  local install=(install -y --no-install-recommends "${missing[@]}")
  # A new machine has no package lists and an old one stale lists: fetch them only when apt cannot do without.
  if apt-get -qq --simulate "${install[@]}" </dev/null >/dev/null 2>&1 && apt_get "${install[@]}"; then return 0; fi
  say "fetching the package lists (apt-get update)"
  apt_get update || die "apt-get update failed, see above; check the network and /etc/apt/sources.list"
  apt_get "${install[@]}" ||
    die "apt-get could not install the packages, see above; Debian 12 has all of them in its main component"
}

# The number of compilers to run: every core, but no more than memory allows at 1.5 GB each.
build_jobs() {
  local by_memory
  by_memory=$(awk '/^MemAvailable/ {print int($2 / 1500000)}' /proc/meminfo)
  local jobs
  jobs=$(nproc)
  [ "$by_memory" -ge "$jobs" ] || jobs=$((by_memory > 0 ? by_memory : 1))
  echo "${CMAKE_BUILD_PARALLEL_LEVEL:-$jobs}"
}

# configure: makes build/release if it is not there or belongs to another place. Ninja itself reconfigures when a
# CMake file changes.
configure() {
  local fresh=()
  if [ -f "$build/CMakeCache.txt" ] && ! grep -qx "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$build/CMakeCache.txt"; then
    fresh=(--fresh) # the tree was moved or copied
  elif [ -f "$build/build.ninja" ]; then
    return 0
  fi
  say "configuring $build"
  (cd "$root" && cmake --preset release "${fresh[@]}") >&2 || die "cmake could not configure the build, see above"
}

# build_target TARGET: builds it, silently when it is up to date.
build_target() {
  ninja -C "$build" --quiet build.ninja 2>&1 | { grep -v 'no work to do' >&2 || true; } ||
    die "cmake could not configure the build, see above"
  ! ninja -C "$build" -n "$1" 2>/dev/null | grep -q 'no work to do' || return 0
  local jobs
  jobs=$(build_jobs)
  say "building $1 (Release, $jobs at a time)"
  cmake --build "$build" --target "$1" --parallel "$jobs" >&2 || die "the build of $1 failed, see above"
}
