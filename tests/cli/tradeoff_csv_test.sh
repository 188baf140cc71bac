#!/usr/bin/env bash
# tradeoff_csv_test.sh FRAGMARK: who is dominated in tradeoff.csv of a real run, worked out again from the
# file's own numbers; and its errors are those of summary.csv.
set -euo pipefail
fragmark=${1:?usage: tradeoff_csv_test.sh FRAGMARK}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
fail() { echo "tradeoff_csv_test: $*" >&2; exit 1; }

"$fragmark" run -q --method kplus-array,ab-ll,wboit,null -a n=12 -a k=2,16 -a width_px=48 -a height_px=32 \
    -a launches=2 -a frames=1 -a warmup=0 --no-images -o "$out" >/dev/null 2>&1 || fail "the run failed"

# Options and messages hold no comma here; quotes are dropped.
awk -F, '
    function number(text, missing) { return text == "" ? missing : text + 0 }
    FNR == 1 { delete at; for (i = 1; i <= NF; i++) at[$i] = i; next }
    { gsub(/"[^"]*"/, "x") }
    FILENAME ~ /summary/ { total[$at["case_id"]] = $at["total_rmse"]; cut[$at["case_id"]] = $at["truncation_rmse"]; next }
    {
        n++
        id[n] = $at["case_id"]; error[n] = $at["error"] + 0; standing[n] = $at["standing"]
        low[n] = number($at["frame_ms_low"], 0); high[n] = number($at["frame_ms_high"], 1e300)
        beaten_by[n] = $at["beaten_by"]; method[n] = $at["method"]; k[n] = $at["k"]; layers[n] = $at["n"]
        wanted = total[id[n]] <= 1e-6 ? 0 : total[id[n]]
        if (error[n] - wanted > 1e-9 || wanted - error[n] > 1e-9) { print id[n] ": error " error[n] ", not " wanted; bad = 1 }
        if (cut[id[n]] > 0.01 && error[n] < 0.001) { print method[n] " of k " k[n] " is cut off, and exact"; bad = 1 }
    }
    END {
        for (a = 1; a <= n; a++) {
            if (method[a] == "null") { if (standing[a] != "") { print "a control competes"; bad = 1 } continue }
            is_beaten = 0; is_clear = 1; names_one = 0
            for (b = 1; b <= n; b++) {
                if (a == b || method[b] == "null" || error[b] > error[a] || layers[b] != layers[a]) continue
                if (high[b] < low[a]) { is_beaten = 1; names_one = names_one || beaten_by[a] == id[b] }
                if (!(high[a] < low[b])) is_clear = 0
            }
            expected = is_beaten ? "dominated" : is_clear ? "frontier" : "tied"
            if (standing[a] != expected) { print id[a] " is " standing[a] ", not " expected; bad = 1 }
            if (is_beaten && !names_one) { print id[a] " is not beaten by " beaten_by[a]; bad = 1 }
            if (method[a] == "kplus-array" && k[a] == 2 && error[a] > 0.01) has_cut = 1
        }
        if (n < 5) { print n " rows"; bad = 1 }
        if (!has_cut) { print "two layers of twelve have no error"; bad = 1 }
        exit bad
    }' "$out/summary.csv" "$out/tradeoff.csv" || fail "see above"
echo "tradeoff_csv_test: passed"
