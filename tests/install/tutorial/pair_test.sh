#!/usr/bin/env bash
# The two programs of the tutorial as a reader runs them: open, infuse, the pump is killed, stand-by, re-open, start anew.
# usage: pair_test.sh TUTORIAL_DIR PROGRAMS_DIR LIENA_TOOL REGISTER_DIR
set -euo pipefail

tutorial=$1 programs=$2 tool=$3 register=$4
scratch=$(mktemp -d)
started=()
finish() {
    for pid in ${started[@]+"${started[@]}"}; do
        kill -KILL "$pid" 2> /dev/null || true
        wait "$pid" 2> /dev/null || true
    done
    rm -rf "$scratch"
}
trap finish EXIT

fail() {
    printf 'FAIL: %s\n' "$*"
    for file in "$scratch"/*.{out,log}; do
        printf -- '--- %s\n' "${file##*/}"
        cat "$file" 2> /dev/null || true
    done
    exit 1
}

# await FILE TEXT: until a line of the file holds the text, at most two minutes.
await() {
    local tenths=0
    until grep -qsF -e "$2" "$scratch/$1"; do
        [ $tenths -lt 1200 ] || fail "$1 never said: $2"
        sleep 0.1
        tenths=$((tenths + 1))
    done
}

free_port() {
    local port
    for port in $(shuf -i 20000-32000 -n 200); do
        if ! (exec 3<> "/dev/tcp/127.0.0.1/$port") 2> /dev/null; then
            echo "$port"
            return
        fi
    done
}

# start_pump NAME_OF_OUTPUT
start_pump() {
    (cd "$scratch" && exec "$programs/pump") > "$scratch/$1.out" 2> "$scratch/$1.log" 4>&- &
    pump=$!
    started+=("$pump")
    await "$1.log" "listening on"
}

mkdir "$scratch/devices"
cp "$tutorial/devices/syringe-pump.xml" "$register/siat-cockpit.xml" "$scratch/devices"
# Free ports, and times that a computer busy with other tests keeps.
timing='<timing heartbeat="50ms" suspect="2s" lost="3s" reconnect="5s"/>'
sed -e "s/52300/$(free_port)/" -e "s/52310/$(free_port)/" -e "s|<security|$timing<security|" "$tutorial/topology.xml" > "$scratch/topology.xml"
(
    cd "$scratch"
    "$tool" check topology.xml devices/*.xml
    "$tool" pki init --dir pki --site "My ward"
    "$tool" pki issue --dir pki --topology topology.xml
) > "$scratch/tool.out" 2>&1 || fail "the tool refuses the tutorial's files"
grep -qF "3 files checked: 0 errors, 0 warnings" "$scratch/tool.out" || fail "liena check has remarks"

start_pump first
mkfifo "$scratch/person"
(cd "$scratch" && exec "$programs/cockpit") < "$scratch/person" > "$scratch/cockpit.out" 2> "$scratch/cockpit.log" &
started+=($!)
exec 4> "$scratch/person"
await cockpit.out "opened"
await first.out "session opening -> open"

echo "start 60" >&4
await cockpit.out "Infuse.rate = 60"
echo "start 5" >&4
await first.out "infusing 5 mL/h"
await cockpit.out "PumpStatus permit="

kill -KILL "$pump"
wait "$pump" 2> /dev/null || true
await cockpit.out "-> stand-by"
await cockpit.out "lost: "
await cockpit.out "stand-by began"

start_pump second
echo "start 5" >&4
await cockpit.out "start refused"
echo "reopen" >&4
await cockpit.out "re-opened"
await cockpit.out "stand-by ended"
await second.out "session re-opening -> open"
! grep -q infusing "$scratch/second.out" || fail "the pump infused although nobody had started it"

# The permit of the restarted pump has to be seen before a person can start under it.
tenths=0
until grep -qF "infusing 3 mL/h" "$scratch/second.out"; do
    [ $tenths -lt 100 ] || fail "the re-opened pump never infused"
    echo "start 3" >&4
    sleep 0.5
    tenths=$((tenths + 1))
done
echo "stop" >&4
await second.out "holds: "
exec 4>&-
await cockpit.out "closing -> closed"
await second.out "closing -> closed"
printf 'the tutorial works\n'
