#!/usr/bin/env bash
# packaging/run with stand-ins for the programs: what it starts, how it ends, and that it leaves nothing running.
# usage: run_script_test.sh SOURCE_DIR
set -euo pipefail

source_dir=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
programs=$scratch/programs
export XDG_STATE_HOME=$scratch/state XDG_RUNTIME_DIR=$scratch DISPLAY=:none STARTED=$scratch/started
mkdir "$programs"

cat > "$programs/liena" <<'TEXT'
#!/usr/bin/env bash
shift
case "$1" in
    show) for file in "${@:2}"; do [ -e "$file" ] && ! grep -q expired "$file" || exit 1; done ;;
    init) mkdir -p "$3"; echo "made $$" > "$3/ca.crt" ;;
    issue) for name in cockpit robot arm xray; do echo new > "$3/$name.crt"; done ;;
esac
TEXT
cat > "$programs/liena-device" <<'TEXT'
#!/usr/bin/env bash
echo "$$ $*" >> "$STARTED"
echo "${XDG_RUNTIME_DIR:-none}" >> "$STARTED.runtime"
[ "$1" != "${BROKEN:-}" ] || { echo "the port is taken" >&2; exit 3; }
[ "$1" != "${DEAF:-}" ] || trap '' TERM
echo "listening on 127.0.0.1:1" >&2
while :; do sleep 0.1; done
TEXT
cat > "$programs/liena-console" <<'TEXT'
#!/usr/bin/env bash
echo "$$ console $*" >> "$STARTED"
echo "${XDG_RUNTIME_DIR:-none}" >> "$STARTED.runtime"
[ -z "${STAY:-}" ] || while :; do sleep 0.1; done
exit "${CONSOLE_STATUS:-0}"
TEXT
chmod +x "$programs"/*

failed=0
fail() { printf 'FAIL: %s\n' "$*"; failed=1; }

# run_it EXPECTED_STATUS [arguments]
run_it() {
    local expected=$1 status=0
    shift
    : > "$STARTED"
    "$source_dir/packaging/run" --programs "$programs" "$@" > "$scratch/output" 2>&1 || status=$?
    if [ $status -ne "$expected" ]; then
        fail "run $* ended with $status instead of $expected"
        cat "$scratch/output"
    fi
}
nothing_left() {
    local pid rest
    while read -r pid rest; do
        if kill -0 "$pid" 2> /dev/null; then
            fail "$1: still running: $rest"
            kill -KILL "$pid"
        fi
    done < "$STARTED"
}
expect() { grep -qE -- "$2" "$1" || { fail "$3: no \"$2\" in:"; cat "$1"; }; }

run_it 0 --seconds 7 --report r.json --screenshot s.png --dicom "$0"
nothing_left "plain run"
expect "$STARTED" '^[0-9]+ robot --topology .*cerebrovascular.xml --device robot --certificate .*/robot.crt --key .*/robot.key --authority .*/ca.crt --registry .*/resources/devices$' "robot"
expect "$STARTED" '^[0-9]+ arm ' "arm"
expect "$STARTED" '^[0-9]+ xray .* --dicom ' "X-ray system"
expect "$STARTED" '^[0-9]+ console .*/cockpit.crt .* --unattended 7 --report r.json --screenshot s.png --rehearsal$' "console"
[ "$(wc -l < "$STARTED")" -eq 4 ] || fail "not exactly four programs were started"

first=$(cat "$XDG_STATE_HOME"/liena/demo/*/pki/ca.crt)
run_it 0
[ "$(cat "$XDG_STATE_HOME"/liena/demo/*/pki/ca.crt)" = "$first" ] || fail "sound certificates were made again"
echo expired > "$(echo "$XDG_STATE_HOME"/liena/demo/*/pki)/robot.crt"
run_it 0
[ "$(cat "$XDG_STATE_HOME"/liena/demo/*/pki/robot.crt)" = new ] || fail "an expired certificate was kept"
sed 's/52110/52111/' "$source_dir/topologies/cerebrovascular.xml" > "$scratch/other.xml"
run_it 0 --topology "$scratch/other.xml"
[ "$(find "$XDG_STATE_HOME/liena/demo" -name ca.crt | wc -l)" -eq 2 ] || fail "another topology did not get its own certificates"

CONSOLE_STATUS=5 run_it 5
nothing_left "console failed"

BROKEN=arm run_it 1
expect "$scratch/output" 'the port is taken' "broken device"
nothing_left "broken device"
! grep -q console "$STARTED" || fail "the console was started beside a broken device"

: > "$STARTED.runtime"
runtime=$XDG_RUNTIME_DIR
unset XDG_RUNTIME_DIR
run_it 0
export XDG_RUNTIME_DIR=$runtime
[ "$(sort -u "$STARTED.runtime" | wc -l)" -eq 1 ] && ! grep -q none "$STARTED.runtime" || fail "not all programs have the same run-time folder"
expect "$scratch/output" "liena monitor --folder $(head -n 1 "$STARTED.runtime")/liena" "no run-time folder"

DEAF=robot run_it 0
expect "$scratch/output" 'is killed' "deaf device"
nothing_left "deaf device"

# A device that was killed is started again by the command that was said for it, and is what it was, from whatever folder.
: > "$STARTED"
: > "$STARTED.runtime"
STAY=yes "$source_dir/packaging/run" --programs "$programs" --dicom "$0" > "$scratch/output" 2>&1 &
runner=$!
until grep -q ' console ' "$STARTED"; do sleep 0.05; done
read -r killed first < <(grep ' xray ' "$STARTED")
kill -KILL "$killed"
again=$(sed -n 's/^run: xray: .*start it again with: bash //p' "$scratch/output")
[ -f "$again" ] || fail "it was not said how the X-ray system is started again"
(cd / && exec env -u XDG_RUNTIME_DIR bash "$again") > /dev/null 2>&1 &
restarted=$!
until [ "$(wc -l < "$STARTED.runtime")" -eq 5 ] || ! kill -0 "$restarted" 2> /dev/null; do sleep 0.05; done
read -r pid second < <(grep ' xray ' "$STARTED" | tail -n 1)
[ "$pid" != "$killed" ] && [ "$second" = "$first" ] || fail "the X-ray system was not started again as it was: $second"
[ "$(sort -u "$STARTED.runtime" | wc -l)" -eq 1 ] || fail "it has another run-time folder"
kill -KILL "$restarted" 2> /dev/null || true
wait "$restarted" 2> /dev/null || true
kill -TERM "$runner"
wait "$runner" || true
[ ! -e "$again" ] || fail "the command that starts the X-ray system again was left behind"
nothing_left "killed device"

for signal in INT TERM; do
    : > "$STARTED"
    # A background job of a script ignores INT; env gives it back.
    STAY=yes env --default-signal=INT "$source_dir/packaging/run" --programs "$programs" > "$scratch/output" 2>&1 &
    runner=$!
    until grep -q ' console ' "$STARTED"; do sleep 0.05; done
    kill -s "$signal" "$runner"
    status=0
    wait "$runner" || status=$?
    [ $status -eq $((128 + $(kill -l "$signal"))) ] || fail "after SIG$signal the status was $status"
    nothing_left "SIG$signal"
done

if command -v Xvfb > /dev/null && command -v matchbox-window-manager > /dev/null; then
    unset DISPLAY WAYLAND_DISPLAY
    run_it 0
    expect "$scratch/output" 'virtual screen :[0-9]+' "virtual screen"
    number=$(grep -o 'virtual screen :[0-9]*' "$scratch/output" | grep -o '[0-9]*$')
    [ ! -e "/tmp/.X$number-lock" ] || fail "the virtual screen :$number is still there"
    export DISPLAY=:none
fi

run_it 2 --seconds 0
run_it 2 --seconds
run_it 2 --dicom "$scratch/missing.dcm"
run_it 2 --nonsense
sed 's/siat-cockpit/other/' "$source_dir/topologies/cerebrovascular.xml" > "$scratch/headless.xml"
run_it 2 --topology "$scratch/headless.xml"
expect "$scratch/output" 'exactly one device' "topology without a console"

[ $failed -eq 0 ] && printf 'packaging/run does what it says\n'
exit $failed
