#!/usr/bin/env bash
# Installs the build tree, builds the tutorial's programs against it as its reader does, and runs them.
# usage: tutorial_test.sh CMAKE BUILD_DIR COMPILER "COMPILER FLAGS"
set -euo pipefail

cmake=$1 build_dir=$2 compiler=$3 flags=$4
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
prefix=$scratch/prefix

"$cmake" --install "$build_dir" --prefix "$prefix" > "$scratch/install.log" || { cat "$scratch/install.log"; exit 1; }
"$cmake" -S "$here" -B "$scratch/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_CXX_FLAGS="$flags -Wall -Wextra -Werror"
"$cmake" --build "$scratch/build"
"$here/pair_test.sh" "$here" "$scratch/build" "$prefix/bin/liena" "$prefix/share/liena/devices"
