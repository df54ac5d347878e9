#!/usr/bin/env bash
# The example of one screen against the reference robot: it opens, sends, and prints what comes back.
# usage: one_screen_test.sh SOURCE_DIR PROGRAMS_DIR
set -euo pipefail

source_dir=$1 programs=$2
scratch=$(mktemp -d)
robot=
finish() {
    if [ -n "$robot" ]; then
        kill -KILL "$robot" 2> /dev/null || true
        wait "$robot" 2> /dev/null || true
    fi
    rm -rf "$scratch"
}
trap finish EXIT

fail() {
    printf 'FAIL: %s\n' "$*"
    cat "$scratch"/robot.log "$scratch"/one_screen.{out,log} 2> /dev/null || true
    exit 1
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

cd "$scratch"
mkdir -p topologies resources
cp -r "$source_dir/resources/devices" resources/devices
# Free ports, and times that a computer busy with other tests keeps.
sed -e "s/52100/$(free_port)/" -e "s/52110/$(free_port)/" \
    -e 's|<timing[^>]*>|<timing heartbeat="50ms" suspect="2s" lost="3s" reconnect="5s"/>|' \
    "$source_dir/topologies/cerebrovascular.xml" > topologies/cerebrovascular.xml
"$programs/liena" pki init --dir pki > /dev/null
"$programs/liena" pki issue --dir pki --topology topologies/cerebrovascular.xml > /dev/null

"$programs/liena-device" robot --topology topologies/cerebrovascular.xml --registry resources/devices \
    --certificate pki/robot.crt --key pki/robot.key --authority pki/ca.crt < /dev/null > robot.out 2> robot.log &
robot=$!
tenths=0
until grep -qsF "listening on" robot.log; do
    [ $tenths -lt 600 ] || fail "the robot did not start"
    sleep 0.1
    tenths=$((tenths + 1))
done

timeout 100 "$programs/one_screen" > one_screen.out 2> one_screen.log || fail "one_screen ended with $?"
grep -q '^opened ' one_screen.out || fail "no channel was opened"
[ "$(grep -cE '^(RobotStatus|DriveStatus|TipPose) [a-z]+=' one_screen.out)" -ge 3 ] || fail "nothing came back"
lines=$(wc -l < "$source_dir/liena/examples/one_screen/one_screen.cpp")
[ "$lines" -le 40 ] || fail "one_screen.cpp has $lines lines; it shall fit one screen of 40"
printf 'one screen works\n'
