#!/usr/bin/env bash
# chain_test.sh PROGRAM PLUGINS COMPARE: the program with real devices. PLUGINS: the folder of the bad
# plugins; COMPARE: compare_images. Devices that this machine does not have are left out.
set -uo pipefail
program=$1 plugins=$2 compare=$3
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
failed=0
small=(-a width_px=33 -a height_px=21 -a n=7 -a launches=1 -a frames=1 -a warmup=0
    --no-report)
exact=kplus-array,kplus-heap,ab-array,ab-ll,exact,z-buffer

complain() {
    echo "FAILED: $1"
    sed 's/^/    /' "$here/out"
    failed=1
}

run() { # FOLDER EXPECTED_CODE ARGUMENTS...
    local folder=$here/$1 expected=$2
    shift 2
    "$program" run "$@" -o "$folder" >"$here/out" 2>&1 </dev/null
    local code=$?
    [ "$code" -eq "$expected" ] || complain "run $*: exit code $code, not $expected"
}

count_rows() { # FOLDER PATTERN: whole rows begin with the schema
    grep -cE "^1,[0-9a-f]{16},$2" "$here/$1/summary.csv"
}

expect_rows() { # FOLDER COUNT PATTERN
    local rows
    rows=$(count_rows "$1" "$3")
    [ "$rows" -eq "$2" ] || complain "$1: $rows rows of '$3', not $2: $(cat "$here/$1/summary.csv")"
}

devices=$("$program" list devices | grep -oE '\b(vulkan|osmesa)\b' | sort -u | paste -sd,)
if [ -z "$devices" ]; then
    echo "skipped: neither vulkan nor osmesa is here"
    exit 77
fi
one=${devices%%,*}

# Each bad plugin is refused with a message of its own; the good ones beside it are measured.
run bad 4 --plugin-dir "$plugins" --device "$one" "${small[@]}" -a k=3 \
    --method wrong-abi,no-symbol,zero-buffer,unknown-pass,broken-shader,kplus-array,ab-array
expect_rows bad 1 'plugin_error,"?wrong-abi.so: abi: '
expect_rows bad 1 "plugin_error,\"?no-symbol.so: no symbol 'fm_method'"
expect_rows bad 1 "plugin_error,\"?zero-buffer.so: resource '.*zero-sized buffer"
expect_rows bad 1 "plugin_error,\"?unknown-pass.so: .*no such pass"
expect_rows bad 1 "plugin_error,\"?broken-shader: pass 'resolve': .*shader, line [0-9]+: 'this_fun"
expect_rows bad 5 'plugin_error,'
expect_rows bad 1 'ok,,kplus-array,'
expect_rows bad 1 'ok,,ab-array,'

# Devices agree on what every exact method shows.
image_of() { # METHOD DEVICE
    local id
    id=$(grep -E "^1,[0-9a-f]{16},ok,,$1,[^,]*,$2," "$here/both/summary.csv" | cut -d, -f2)
    echo "$here/both/images/$id.rgba32f"
}
run both 0 --device "$devices" --method "$exact" "${small[@]}" -a k=3
if [ "$devices" = osmesa,vulkan ]; then
    expect_rows both 12 ok,
    for method in ${exact//,/ }; do
        apart=$("$compare" "$(image_of "$method" vulkan)" "$(image_of "$method" osmesa)" 1e-6) ||
            complain "$method: the images of vulkan and osmesa are $apart apart"
        echo "$method: images at most $apart apart"
    done
fi

# Killed in the middle, the same command ends with the rows of a run that was not.
rows_of() { cut -d, -f1-3 "$here/$1/summary.csv" | grep -E '^1,[0-9a-f]{16},' | sort; }
many=(--device "$devices" --method "$exact" --feed "raster,compute-pixel" "${small[@]}" -a "k=2,5")
run whole 0 "${many[@]}"
"$program" run "${many[@]}" -o "$here/killed" >"$here/out" 2>&1 </dev/null &
victim=$!
for _ in $(seq 600); do
    [ "$(grep -cs '"end"' "$here/killed/journal.jsonl")" -ge 3 ] 2>/dev/null && break
    kill -0 "$victim" 2>/dev/null || break
    sleep 0.05
done
kill -s KILL "$victim" 2>/dev/null
wait "$victim" 2>/dev/null
done_before=$(grep -c '"end"' "$here/killed/journal.jsonl")
run killed 0 "${many[@]}"
done_after=$(grep -c '"end"' "$here/killed/journal.jsonl")
echo "killed after $done_before of $done_after launches"
[ "$done_before" -lt "$done_after" ] || complain "killed: the run was over before it was killed"
[ "$(rows_of whole)" = "$(rows_of killed)" ] ||
    complain "killed: other rows: $(diff <(rows_of whole) <(rows_of killed))"
# An option that only a refused plugin could know is not called unknown.
"$program" plan --plugin-dir "$plugins" --method wrong-abi -a depth_scale=3 >"$here/out" 2>&1
[ $? -eq 2 ] && grep -q "method 'wrong-abi' is refused: .*abi" "$here/out" ||
    complain "an option of a refused plugin"
exit "$failed"
