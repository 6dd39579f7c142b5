#!/usr/bin/env bash
# Compiles the C++ example with the shared library and runs it: run.sh LIBRARY_FOLDER [DATASET]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
program=$(mktemp -d)
trap 'rm -rf "$program"' EXIT
# the header is C as well
echo '#include "handeye.h"' | "${CC:-cc}" -std=c99 -Wall -Wextra -Werror -pedantic -I "$here/../include" -fsyntax-only -x c -
"${CXX:-c++}" -std=c++11 -Wall -Wextra -Werror -pedantic -I "$here/../include" "$here/hand_eye.cpp" \
  -L "$1" -lhandeye_c "-Wl,-rpath,$(cd "$1" && pwd)" -o "$program/hand_eye"
"$program/hand_eye" "${@:2}"
