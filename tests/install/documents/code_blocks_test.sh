#!/usr/bin/env bash
# The documents show files of the project: each must stand there as it is, so that no document drifts from what is tested.
# usage: code_blocks_test.sh SOURCE_DIR
set -euo pipefail

source_dir=$1
failed=0

# shows DOCUMENT LANGUAGE FILE
shows() {
    local text content
    text=$(< "$source_dir/$1")
    content=$(< "$source_dir/$3")
    if [[ $text != *$'\n```'"$2"$'\n'"$content"$'\n```'* ]]; then
        printf 'FAIL: %s has no block of %s that equals %s; copy the file into it\n' "$1" "$2" "$3"
        failed=1
    fi
}

shows README.md cpp liena/examples/one_screen/one_screen.cpp
shows liena/TUTORIAL.md xml tests/install/tutorial/devices/syringe-pump.xml
shows liena/TUTORIAL.md xml tests/install/tutorial/topology.xml
shows liena/TUTORIAL.md cpp tests/install/tutorial/pump.cpp
shows liena/TUTORIAL.md cpp tests/install/tutorial/cockpit.cpp
shows liena/TUTORIAL.md cmake tests/install/tutorial/CMakeLists.txt
[ $failed -ne 0 ] || printf 'the documents show the files as they are\n'
exit $failed
