#!/usr/bin/env bash
# stability_csv_test.sh FRAGMARK [all]: each error in stability.csv has the kind and the size that the
# method's traits declare, worked out again from the file's own numbers: of a run on both software
# devices (some methods and scenes; all: the whole figure), and of the GPU whose table is kept.
set -euo pipefail
fragmark=${1:?usage: stability_csv_test.sh FRAGMARK [all]}
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
fail() { echo "stability_csv_test: $*" >&2; exit 1; }

check() { # FILE FEWEST_ROWS
    awk -F, -v fewest="$2" '
        function say(what) { print FILENAME ": " $at["method"] " on " $at["scene"] ", " $at["device_name"] ", " $at["feed"] ": " what; bad = 1 }
        function has(list, word) { return index(" " list " ", " " word " ") > 0 }
        function n(name) { return $at[name] + 0 }
        # One error: whether the kind is there, and whether one may be.
        function kind(word, is_there, may_be) {
            if (is_there != has($at["wrong"], word)) say("wrong: " $at["wrong"] ", but " word " is " is_there)
            if (is_there && !may_be) say(word " is allowed by none of: " $at["traits"])
        }
        { gsub(/"[^"]*"/, "x") }
        FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
        { rows++; verdicts[$at["verdict"]]++ }
        $at["status"] == "not_supported" {
            if ($at["reasons"] == "" || $at["reasons"] == "not recorded") say("no reason")
            next
        }
        $at["status"] != "ok" { say("status " $at["status"]); next }
        {
            traits = $at["traits"]
            flight = $at["feed"] != "compute-pixel" && !($at["feed"] == "raster" && $at["is_software"] == 1)
            sloped = $at["order"] == "" || has($at["options"], "depths=sloped")
            tied = n("tied_pixels") > 0
            races = has(traits, "racy") && flight
            sorts = has(traits, "sorted_input")
            late = sorts && (flight || sloped || $at["order"] != "ascending")
            rough = has(traits, "approximate")
            samples = has(traits, "multisampled") && sloped
            ties = n("lost_ties"); one = n("lost_at_one")
            if (rough) { # judged by its image alone
                rounding = 2 ^ -23 * sqrt(n("n")); if (rounding < 1e-6) rounding = 1e-6
                if (has($at["wrong"], "missing") || has($at["wrong"], "extra") || has($at["wrong"], "misordered")) say("fragments of an approximation are compared")
                kind("image", n("max_abs") > rounding, 1)
                expected = $at["wrong"] != "" ? "wrong" : n("max_abs") <= 2 ^ -23 ? "exact" : "within tolerance"
                if ($at["verdict"] != expected) say($at["verdict"] ", not " expected)
                if ($at["unexplained"] != "") say("unexplained: " $at["unexplained"])
                next
            }
            any = races || late || samples
            missing = n("missing") > n("missing_max") ? n("missing") : n("missing_max")
            if (ties > 0 && !has(traits, "loses_ties") && !has(traits, "passes_lose_ties")) say("loses " ties " ties")
            if (one > 0 && !has(traits, "loses_depth_one")) say("loses " one " at depth 1")
            if (ties > n("declared_ties") || one > n("declared_at_one")) say("lost more than is declared")
            if (!any && ((ties != n("declared_ties") && !has(traits, "passes_lose_ties")) || one != n("declared_at_one")))
                say("lost " ties " and " one ", not " $at["declared_ties"] " and " $at["declared_at_one"])
            if (missing > n("fragments_wanted")) say("more are missing than wanted")
            varies = races || (sorts && flight) || (ties > 0 && flight && tied)
            kind("missing", missing > 0, missing == ties + one || any)
            kind("extra", n("extra") > 0, races || samples || (has(traits, "emits_back") && n("extra") <= ties))
            kind("misordered", n("misordered") > 0, races)
            kind("lost", n("fragments_lost") > 0, races)
            rounding = 2 ^ -23 * sqrt(n("n")); if (rounding < 1e-6) rounding = 1e-6
            kind("image", n("self_beyond") > rounding, varies)
            kind("unstable", ((n("distinct_images") > 1 || n("distinct_fragments") > 1) && !tied) ||
                n("frames_rmse_max") - n("rmse") > 2 ^ -23 || n("missing_max") > n("missing"), varies)
            right = $at["wrong"] == ""
            expected = !right ? "wrong" : n("self_max_abs") <= 2 ^ -23 ? "exact" : "within tolerance"
            if ($at["verdict"] != expected) say($at["verdict"] ", not " expected)
            if (!right && $at["reasons"] == "") say("no reason")
            if ($at["unexplained"] != "") say("unexplained: " $at["unexplained"])
        }
        END {
            if (rows < fewest) { print FILENAME ": " rows " rows, not " fewest; bad = 1 }
            if (verdicts["exact"] == 0 || verdicts["wrong"] == 0 || verdicts["not supported"] == 0) { print FILENAME ": a verdict is missing"; bad = 1 }
            exit bad
        }' "$1" || fail "see above"
}

if [ "${2-}" = all ]; then
    "$fragmark" reproduce stability -q --no-images -o "$out/run" >/dev/null 2>"$out/log" || fail "$(tail -3 "$out/log")"
    check "$out/run/stability.csv" 3500
else
    "$fragmark" run -q --device vulkan,osmesa --feed raster,compute-adjacent \
        --method dual-k,f2b-k,kb,kb-mdt32,kb-sr-counter,kb-sr-multipass,kplus-array,wboit \
        --scene hard/ascending,hard/coplanar,hard/ends-reversed,hard/sloped \
        -a k=8 -a launches=1 -a frames=2 -a warmup=0 --no-images -o "$out/run" >/dev/null 2>"$out/log" ||
        fail "$(tail -3 "$out/log")"
    check "$out/run/stability.csv" 120
fi
check "$root/reports/reference/h200-stability.csv" 2100

# All hard scenes are in the figure.
for scene in "$root"/scenes/hard/*.yml; do
    grep -q "hard/$(basename "$scene" .yml)[],]" "$root/reports/figures/stability.yml" ||
        fail "$(basename "$scene" .yml) is not in the figure stability"
done

# What the check above cannot pass, each of one kind: an exact method without a fragment, samples of flat
# layers, frames that differ, a tie too few, no reason.
spoil() { # AWK_PROGRAM METHOD SCENE
    awk -F, -v OFS=, -v method="$2" -v scene="$3" 'FNR == 1 { for (i = 1; i <= NF; i++) at[$i] = i }
        $at["method"] == method && $at["scene"] == scene { '"$1"' } { print }' \
        "$root/reports/reference/h200-stability.csv" >"$out/spoilt.csv"
    (check "$out/spoilt.csv" 1 >/dev/null 2>&1) && fail "not seen: $1" || true
}
spoil '$at["missing"]++; $at["wrong"] = "missing"; $at["verdict"] = "wrong"; $at["reasons"] = "x"' kplus-array hard/ulp
spoil '$at["extra"]++; $at["wrong"] = "missing extra"' kb-sr hard/descending
spoil '$at["distinct_fragments"]++; $at["wrong"] = "unstable"; $at["verdict"] = "wrong"; $at["reasons"] = "x"' kplus-heap hard/ulp
spoil '$at["lost_ties"]--; $at["missing"]--' f2b-k hard/coplanar
spoil '$at["reasons"] = ""' f2b-k hard/ends-reversed
echo "stability_csv_test: passed"
