#!/usr/bin/env bash
# Every file of C++ is laid out as .clang-format says. usage: formatting_test.sh SOURCE_DIR
set -euo pipefail

cd "$1"
rooms=(liena console tests packaging)
count=$(find "${rooms[@]}" -name '*.[ch]pp' | wc -l)
[ "$count" -gt 0 ] || { printf 'formatting: no files found in %s\n' "$1" >&2; exit 1; }
find "${rooms[@]}" -name '*.[ch]pp' -print0 | xargs -0 -P "$(nproc)" -n 64 clang-format --dry-run -Werror ||
    { printf 'formatting: lay these out with clang-format -i\n' >&2; exit 1; }
printf 'formatting: %s files are laid out as .clang-format says\n' "$count"
