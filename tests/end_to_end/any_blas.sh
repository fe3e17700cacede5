#!/usr/bin/env bash
# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
#
# any_blas.sh LHD_LOADING: a loading cycle comes out the same, digit by digit, whichever BLAS and LAPACK the system has chosen.
# Where the system has one alone, a second is fetched from Debian's packages and looked at here, not installed; without a
# network there is nothing to compare (77). Models and fronts do follow the library, through Ipopt's MUMPS.
set -euo pipefail
loading=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Folders that hold a libblas.so.3 or liblapack.so.3 of their own, as Debian's alternatives do.
choices() {
  local root=/usr/lib/x86_64-linux-gnu
  if [ -d $root/blas ]; then echo "$root/blas:$root/lapack"; fi
  find $root -mindepth 1 -maxdepth 1 -type d \( -name 'openblas*' -o -name 'atlas*' -o -name 'blis*' \) | sort
}

fetched() {
  (cd "$work" && apt-get -q download libopenblas0-serial && dpkg-deb -x libopenblas0-serial_*.deb fetched) >/dev/null 2>&1 || return 0
  find "$work/fetched" -type d -name 'openblas*'
}

mapfile -t libraries < <(choices)
[ ${#libraries[@]} -ge 2 ] || mapfile -t -O ${#libraries[@]} libraries < <(fetched)
[ ${#libraries[@]} -ge 2 ] || { echo "one BLAS is here, ${libraries[*]}, and no other can be fetched; install libopenblas0" >&2; exit 77; }

for k in "${!libraries[@]}"; do
  LD_LIBRARY_PATH=${libraries[$k]} "$loading" evaluate --x=1.2,0.8,0.5,0.2 --pile-mass 15 --cycles 1 --seed 1 >"$work/$k" 2>/dev/null
  diff "$work/0" "$work/$k" >"$work/diff" ||
    { echo "a cycle differs between ${libraries[0]} (<) and ${libraries[$k]} (>):"; head -6 "$work/diff"; failed=1; }
done
exit "${failed:-0}"
