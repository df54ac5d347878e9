#!/usr/bin/env bash
# Installs the build tree into a folder of its own, then builds and runs a program against it and the installed tool.
# usage: install_and_use.sh CMAKE BUILD_DIR COMPILER "COMPILER FLAGS" VERSION
set -euo pipefail

cmake=$1 build_dir=$2 compiler=$3 flags=$4 version=$5
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
prefix=$scratch/prefix

"$cmake" --install "$build_dir" --prefix "$prefix" > "$scratch/install.log" || { cat "$scratch/install.log"; exit 1; }
if grep -rqF -e "$build_dir" -e project_options "$prefix"/lib*/cmake "$prefix"/lib/*/cmake 2> /dev/null; then
    echo "FAIL: the installed package speaks of the build tree"
    grep -rF -e "$build_dir" -e project_options "$prefix"/lib*/cmake "$prefix"/lib/*/cmake 2> /dev/null
    exit 1
fi

topology=$prefix/share/liena/topologies/cerebrovascular.xml
"$cmake" -S "$here" -B "$scratch/build" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="$flags"
"$cmake" --build "$scratch/build"
"$scratch/build/consumer" "$topology" "$scratch/pki" | tee "$scratch/output"
grep -qxF "liena $version: 4 devices of cerebrovascular" "$scratch/output"

"$prefix/bin/liena" pki show "$scratch/pki/ca.crt" "$scratch/pki/robot.crt" | tee "$scratch/shown"
grep -q '0x00008208' "$scratch/shown"
"$prefix/bin/liena" check "$topology" "$prefix"/share/liena/devices/*.xml

# Wherever the tool is started, it finds the register that was installed with it.
(cd "$scratch" && "$prefix/bin/liena" sets list --store "$scratch/no-store") | tee "$scratch/sets"
grep -q 'register .* vascular-robot ' "$scratch/sets"

# An installed page has beside it what it links to. (The library alone has no pages.)
find "$prefix/share/doc" -name '*.md' > "$scratch/pages" 2> /dev/null || true
while read -r page; do
    while read -r target; do
        [ -e "$(dirname "$page")/$target" ] || { echo "FAIL: $page links to $target, which is not installed"; exit 1; }
    done < <(grep -o '](\([^)#:]*\)[#)]' "$page" | sed -e 's/^](//' -e 's/[#)]$//' | grep .)
done < "$scratch/pages"
echo "the installed package works"
