#!/usr/bin/env bash
# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
#
# any_blas.sh LHD_LOADING FORMULA_DEMO PRINT_FITS: a loading cycle, the models and the front of a study, and fits of a program
# that links the toolkit alone, come out the same, digit by digit, whichever BLAS and LAPACK the system has chosen. Where the
# system has one alone, a second is fetched from Debian's packages and used here without being installed; without a network
# there is nothing to compare (77).
set -euo pipefail
loading=$1
formula=$2
fits=$3
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

# answers LIBRARIES FOLDER: what the programs compute with these.
answers() {
  mkdir "$2"
  export LD_LIBRARY_PATH=$1
  "$loading" evaluate --x=1.2,0.8,0.5,0.2 --pile-mass 15 --cycles 1 --seed 1 >"$2/cycle" 2>/dev/null
  "$formula" run --runs 40 --validation 10 --out "$work/study" --json 2>/dev/null | tr ',' '\n' | grep -v -e seconds -e report >"$2/study.json"
  "$formula" export --what front --out "$work/study" >"$2/front.csv" 2>/dev/null
  "$fits" >"$2/fits"
  rm -r "$work/study"
}

failed=0
for k in "${!libraries[@]}"; do
  (answers "${libraries[$k]}" "$work/$k")
  diff -r "$work/0" "$work/$k" >"$work/diff" ||
    { echo "${libraries[0]} (<) and ${libraries[$k]} (>) give different answers:"; head -20 "$work/diff"; failed=1; }
done
exit "$failed"
