#!/usr/bin/env bash
# cli_test.sh PROGRAM: exit codes and messages of the program, on the dummy device. What is checked
# stands in each line: check NAME EXPECTED_CODE WORDS COMMAND...; WORDS are sought in both streams.
set -uo pipefail
# When leaks are looked for, drivers are closed: only whole stacks name them to the suppressions.
export ASAN_OPTIONS="${ASAN_OPTIONS-}:fast_unwind_on_malloc=0"
program=$1
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
failed=0
small=(--device dummy -a n=4 -a k=2 -a width_px=16 -a height_px=16 -a frames=2 -a warmup=0
    --no-images --no-report)

complain() {
    echo "FAILED: $1"
    sed 's/^/    /' "$here/out" "$here/talk"
    failed=1
}

check() {
    local name=$1 expected=$2 words=$3
    shift 3
    "$@" >"$here/out" 2>"$here/talk" </dev/null
    local code=$?
    if [ "$code" -ne "$expected" ]; then
        complain "$name: exit code $code, not $expected: $*"
    elif ! cat "$here/out" "$here/talk" | tr '\n' ' ' | grep -qF -- "$words"; then
        complain "$name: '$words' is missing: $*"
    fi
}

check no_arguments_are_a_usage_error 2 "Usage: fragmark" "$program"
check help_is_data 0 "Exit codes" "$program" --help
[ -s "$here/talk" ] && complain "help_is_data: on stdout only"
check version_is_told 0 "fragmark " "$program" --version
check unknown_command_names_the_nearest 2 "the nearest is 'run'" "$program" rum
check unknown_list_names_the_nearest 2 "the nearest is 'methods'" "$program" list methds
check unknown_option_is_a_usage_error 2 "--metod" "$program" run --metod kb
for command in list doctor plan run reproduce report dump; do
    check "help_of_${command}_tells_exit_codes" 0 "Exit codes" "$program" "$command" --help
done
check help_of_run_has_the_axes 0 "pixel_density" "$program" run --help

check help_of_run_has_the_precision 0 "0.01%..100% (none)" "$program" run --help
check precision_is_a_percentage 2 "-a precision=2: precision: '2' is not a legal value; legal: 0.01%..100%" \
    "$program" plan "${small[@]:0:2}" -a precision=2
check precision_needs_its_first_look 2 "launches = 3: with precision it is the most that there may be" \
    "$program" plan "${small[@]:0:2}" -a precision=2% -a launches=3
check precision_has_a_range_of_launches 0 "1 to run: 5 to 40 launches of 2 frames each, seed 1; about 5 s to 40 s" \
    "$program" plan --method exact "${small[@]:0:14}" -a precision=2%
check equal_times_are_precise 0 "precise enough after 5 of at most 40 launches" \
    "$program" run --method exact,kplus-array "${small[@]}" -a precision=2% -o "$here/precise"
[ "$(grep -c 'precision 2%: reached, 0% after 5 launches' "$here/precise/summary.csv")" = 2 ] ||
    complain "equal_times_are_precise: rows say so"
check precise_rows_are_not_measured_again 0 "2 ok, 0 not supported, 0 failed" \
    "$program" run --method exact,kplus-array "${small[@]}" -a precision=2% -o "$here/precise"
[ "$(grep -c '"event":"end"' "$here/precise/journal.jsonl")" = 10 ] ||
    complain "precise_rows_are_not_measured_again: launches"

check methods_are_listed 0 "null" "$program" list methods
check methods_are_listed_with_their_traits 0 "[exact, bounded, sorts in resolve, emits either way] Vasilakis" \
    "$program" list methods
check devices_are_listed 0 "dummy" "$program" list devices
check scenes_are_listed 0 "layers" "$program" list scenes
check figures_are_listed 0 "" "$program" list figures
check methods_as_json 0 '"family": "control"' "$program" list methods --json
check doctor_knows_the_machine 0 "memory_bytes" "$program" doctor --json

for variable in FRAGMARK_SCENE_PATH FRAGMARK_PLUGIN_PATH; do
    check "a_folder_of_${variable}_must_be_one" 2 "$variable: " env "$variable=/dev/zero" "$program" plan
done
check a_folder_of_scenes_must_be_there 2 "FRAGMARK_SCENE_PATH: /nowhere: No such file" \
    env FRAGMARK_SCENE_PATH=/nowhere "$program" plan
check a_folder_of_figures_must_be_one 2 "FRAGMARK_FIGURE_PATH: /dev/zero: is not a folder" \
    env FRAGMARK_FIGURE_PATH=/dev/zero "$program" list figures
mkfifo "$here/pipe"
check a_spec_must_be_a_file 2 "pipe: is a pipe, not a file" timeout 60 "$program" plan "$here/pipe"
{ printf 'a: '; head -c 100000 /dev/zero | tr '\0' '['; } >"$here/deep.yml"
check a_deep_spec_is_refused_at_once 2 "deep.yml:1: nested deeper than 16" timeout 20 "$program" plan "$here/deep.yml"

check plan_lists_cases 0 "k=8" "$program" plan --method kplus-array -a k=4,8 -a n=16
printf 'generator: mesh\nmesh: absent.obj\n' >"$here/absent.yml"
printf 'generator: mesh\nmesh: cut.obj\n' >"$here/cut.yml"
printf 'v 0 0 0\nf 1 2 3\n' >"$here/cut.obj"
check plan_of_a_missing_mesh_says_so 3 "absent.obj" \
    "$program" plan --method kplus-array --scene "$here/absent.yml"
check plan_of_a_damaged_mesh_says_so 3 "not loaded" \
    "$program" plan --method kplus-array --scene "$here/cut.yml"
check plan_tells_one_missing_mesh_of_several 4 "absent.obj" \
    "$program" plan --method kplus-array --scene "$here/absent.yml,layers"
check plan_says_it_estimates 0 "an estimate" "$program" plan --method kplus-array
check plan_as_json 0 '"case_id"' "$program" plan --method kplus-array --json
check unknown_method_names_the_nearest 2 "nearest is 'kplus-array'" \
    "$program" plan --method kplus-aray
check unknown_device_number_names_those_there_are 2 "there is dummy" \
    "$program" run --device dummy:77 --method null -o "$here/unknown-device"
[ -e "$here/unknown-device" ] && complain "unknown_device_number: nothing is run"
check unknown_axis_names_the_nearest 2 "pixel_density" "$program" plan -a pixel_densty=1
check bad_value_names_the_range 2 "1..64" "$program" plan -a tessellation=65
check missing_spec_is_a_spec_error 2 "none.yml" "$program" plan "$here/none.yml"
printf 'methods: [kplus-array]\nkk: 3\n' >"$here/bad.yml"
check spec_error_names_file_and_line 2 "bad.yml:2" "$program" run "$here/bad.yml" -o "$here/bad"
[ -e "$here/bad" ] && complain "spec_error: a folder was made"
check bad_memory_limit_is_a_usage_error 2 "4G" "$program" run --memory-limit 4X
check bad_timeout_is_a_usage_error 2 "seconds" "$program" run --timeout 0
check unknown_figure_names_the_nearest 2 "kplus-05" "$program" reproduce kplus-5
check unknown_paper_names_the_nearest 2 "nearest is 'sbuffer'" "$program" reproduce sbufer
check unknown_claim_names_the_nearest 2 "nearest is 'KP-20'" "$program" reproduce KP20
check claim_names_its_figure 0 "4 ok" "$program" reproduce KP-26 --smoke --device dummy --no-report -o "$here/claim"
grep -q '^kplus-03,' "$here/claim/figures.csv" || complain "claim_names_its_figure: figures.csv does not"

check figure_on_an_unknown_device_is_refused 2 "vulkan:99" \
    "$program" reproduce kplus-05 --smoke --device vulkan:99 -o "$here/refused"
[ -e "$here/refused" ] && complain "figure_on_an_unknown_device: something is left"

# Each figure's cases are measured as often as it says; what two want, as often as either wants.
mkdir "$here/two"
chart='charts: [{ id: c, title: c, x: k, y: frame_ms }]'
head='methods: [kplus-array], scenes: [layers], feeds: [raster], n: 3, width_px: 9, height_px: 9'
printf 'id: one-1\npaper: one\ntitle: t\nrun: { %s, k: [2, 3], launches: 2, frames: 1, warmup: 0 }\n%s\n' \
    "$head" "$chart" >"$here/two/one-1.yml"
printf 'id: one-2\npaper: one\ntitle: t\nrun: { %s, k: [3, 4], launches: 1, frames: 3, warmup: 0 }\n%s\n' \
    "$head" "$chart" >"$here/two/one-2.yml"
check figures_keep_their_launches 0 "3 ok" env FRAGMARK_FIGURE_PATH="$here/two" "$program" \
    reproduce one --device dummy --no-report -o "$here/both"
counts=$(cut -d, -f2,18 "$here/both/summary.csv" | tail -n +2 | sort -t, -k2n | while IFS=, read -r id _; do
    grep -c ",$id,.*,frame_ms," "$here/both/samples.csv"; done | sort -n | paste -sd,)
[ "$counts" = 2,3,6 ] || complain "figures_keep_their_launches: $counts frames, not 2,3,6"
# The same cases may be for other figures than before: the later command says so.
printf 'id: one-3\npaper: one\ntitle: t\nrun: { %s, k: [2, 3], launches: 2, frames: 1, warmup: 0 }\n%s\n' \
    "$head" "$chart" >"$here/two/one-3.yml"
for figure in one-1 one-3; do
    check cases_are_for_what_is_asked_for 0 "2 ok" env FRAGMARK_FIGURE_PATH="$here/two" "$program" \
        reproduce "$figure" --device dummy --no-report -o "$here/later"
    [ "$(grep -c "^$figure," "$here/later/figures.csv")" = 2 ] || complain "cases_are_for_what_is_asked_for: $figure"
done

# A table of memory is a figure like others: nothing is measured, claims are judged.
check table_is_reproduced 0 "0 differ" "$program" reproduce kplus-table1 -o "$here/table"
grep -q '^kplus-table1,' "$here/table/memory.csv" || complain "table_is_reproduced: no memory.csv"
check table_is_reproduced_again 0 "0 differ" "$program" reproduce kplus-table1 -o "$here/table"
if [ -x "$(dirname "$program")/fragmark-report" ]; then
    grep -q '^KP-20,.*,holds,' "$here/table/claims.csv" || complain "table_is_judged: KP-20"
    check table_is_reported 0 "report.html" "$program" report "$here/table"
    mkdir "$here/figures"
    sed 's/equals: -8388608/equals: -8388607/' "$(dirname "$program")/figures/kplus-table1.yml" \
        >"$here/figures/kplus-table1.yml"
    check required_claim_of_a_table_fails 1 "must hold" \
        env FRAGMARK_FIGURE_PATH="$here/figures" "$program" reproduce KP-20 -o "$here/wrong"
fi
if [ -x "$(dirname "$program")/fragmark-report" ]; then
    mkdir -p "$here/blocked/report.html"
    check report_that_fails_is_told 5 "again with" "$program" run --method z-buffer --device dummy \
        -a n=4 -a width_px=16 -a height_px=16 -a frames=1 -a launches=1 --no-images -o "$here/blocked"
    mkdir -p "$here/both-fail/report.html"
    check report_that_fails_is_told_beside_cases_that_do 5 "again with" "$program" run --method z-buffer \
        --device dummy --memory-limit 60M -a n=4 -a width_px=4000 -a height_px=4000 -a frames=1 -a launches=1 \
        --no-images -o "$here/both-fail"
fi
# What is asked for and missing is told before anything is measured, and nothing is left.
plain() { "$program" run --method z-buffer "${small[@]}" -a launches=1 -o "$here/absent" "$@"; }
table() { "$program" reproduce kplus-table1 -o "$here/absent" "$@"; }
check missing_reference_is_told_first 2 "the nearest is 'h100'" table --reference h10
check missing_reference_without_a_report_too 2 "the nearest is 'h100'" table --reference h10 --no-report
check missing_reference_folder_is_told_first 2 "$here/none: No such file" table --reference "$here/none"
if [ -x "$(dirname "$program")/fragmark-report" ]; then
    mkdir "$here/undrawn"
    sed 's/x: k, //' "$here/two/one-1.yml" >"$here/undrawn/one-1.yml"
    check figure_that_cannot_be_drawn_is_told_first 2 "nothing was measured" \
        env FRAGMARK_FIGURE_PATH="$here/undrawn" "$program" reproduce one-1 --device dummy -o "$here/absent"
fi
for kind in PLUGIN SCENE FIGURE REFERENCE; do
    check "folder_in_${kind}_PATH_that_is_missing_is_told" 2 "FRAGMARK_${kind}_PATH: $here/none: No such file" \
        env "FRAGMARK_${kind}_PATH=$here/none" "$program" reproduce kplus-03 --smoke --device dummy \
        --reference h100 --no-report -o "$here/absent"
done
[ -e "$here/absent" ] && complain "what is missing is told first: a folder was made"
check report_needs_a_folder 2 "which DIR" "$program" report

# Folders and files that are not what they are taken for.
mkdir -p "$here/odd/empty" "$here/odd/runs/one"
: >"$here/odd/file.yml"
echo words >"$here/odd/text"
echo 'schema' >"$here/odd/runs/one/summary.csv"
if [ -x "$(dirname "$program")/fragmark-report" ]; then
    check report_of_no_folder 2 "odd/none: No such file" "$program" report "$here/odd/none"
    check report_of_a_file 2 "odd/text: is not a folder" "$program" report "$here/odd/text"
    check report_of_an_empty_folder 2 "odd/empty: is empty" "$program" report "$here/odd/empty"
    check report_of_a_folder_of_runs 2 "did you mean $here/odd/runs/one?" "$program" report "$here/odd/runs"
    check report_of_a_folder_without_results 2 "holds no results: no summary.csv" "$program" report "$here/odd"
    check reference_that_holds_nothing 2 "odd/empty: is empty" table --reference "$here/odd/empty"
fi
check empty_scene_is_refused 2 "file.yml: is empty" plain --scene "$here/odd/file.yml"
check empty_spec_is_refused 2 "file.yml: is empty" plain "$here/odd/file.yml"
check plugin_folder_without_plugins 2 "no plugin lies there as ID/ID.so" plain --plugin-dir "$here/odd/empty"
check plugin_folder_that_is_a_file 2 "odd/text: is not a folder" plain --plugin-dir "$here/odd/text"
check output_that_is_a_file 2 "odd/text: is there, and is no folder" "$program" reproduce kplus-table1 --no-report \
    -o "$here/odd/text"
check output_below_what_is_not_there 0 "0 differ" "$program" reproduce kplus-table1 --no-report -o "$here/odd/a/b"

# Who may not read or write is told so; root may all.
mkdir -m 000 "$here/barred"
printf 'generator: layers\n' >"$here/barred.yml"
chmod 000 "$here/barred.yml"
chmod 711 "$here"
as_nobody() {
    if [ "$(id -u)" -eq 0 ]; then setpriv --reuid=65534 --regid=65534 --clear-groups "$@"; else "$@"; fi
}
if as_nobody test -x "$program"; then
    check barred_plugin_folder 2 "barred: Permission denied" as_nobody "$program" list methods --plugin-dir "$here/barred"
    check barred_scene_folder 2 "barred: Permission denied" as_nobody env FRAGMARK_SCENE_PATH="$here/barred" \
        "$program" list scenes
    for what in --scene ""; do
        check "barred_file_after_run_$what" 2 "barred.yml: Permission denied" as_nobody "$program" run \
            --method z-buffer "${small[@]}" $what "$here/barred.yml" -o "$here/barred/x"
    done
    check barred_output 2 "barred/x: cannot be made: Permission denied" as_nobody "$program" reproduce kplus-table1 \
        --no-report -o "$here/barred/x"
    check barred_reference 2 "barred: Permission denied" as_nobody "$program" reproduce kplus-table1 --no-report \
        --reference "$here/barred" -o "$here/absent"
fi

run() { "$program" run --method kplus-array,z-buffer "${small[@]}" -a launches="$1" -o "$here/$2"; }
check run_measures 0 "2 ok" run 2 first
[ -s "$here/out" ] && grep -qv '^$' "$here/out" && grep -q "launch" "$here/out" &&
    complain "run_measures: progress belongs to stderr"
check run_again_has_nothing_to_do 0 "2 ok" run 2 first
check other_plan_is_refused 2 "another plan" run 3 first
echo damage >>"$here/first/journal.jsonl"
check damage_is_told_apart 8 "damaged" run 2 first
check folder_that_cannot_be_made 2 "/proc" "$program" run --method z-buffer "${small[@]}" \
    -o /proc/fragmark
check unsupported_only_is_nothing 3 "1 not supported" "$program" run --method kplus-array \
    "${small[@]}" --feed triangles -o "$here/unsupported"
# Why, in a word: what the plan says, and what a worker does.
check refusals_have_a_reason 0 "5 ok" "$program" run --method kb,kb-sr,z-buffer --feed raster,triangles --device dummy \
    -a n=4 -a width_px=512 -a height_px=512 -a k=4,4096 -a depth=normal,reversed -a frames=1 -a warmup=0 -a launches=1 \
    --no-images --no-report -o "$here/refused"
reasons=$(sed 's/"[^"]*"/quoted/g' "$here/refused/summary.csv" | awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    { print $at["method"], $at["feed"], $at["status"], $at["reason"] }' | sort -u | paste -sd/)
[ "$reasons" = "kb raster not_supported device-limit/kb raster ok /kb triangles not_supported feed/\
kb-sr raster not_supported setting/kb-sr raster ok /kb-sr triangles not_supported feed/\
z-buffer raster not_supported depth-test/z-buffer raster ok /z-buffer triangles not_supported feed" ] ||
    complain "refusals_have_a_reason: $reasons"

# On the dummy device a timer costs something, and one for all passes is less than one for each.
check frames_may_have_one_timer 0 "2 ok" "$program" run --method kplus-array "${small[@]}" \
    -a timers=passes,frame -a launches=1 -o "$here/timers"
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    { ms[NR] = $at["frame_ms"]; passes[NR] = $at["clear_ms"] $at["store_ms"] $at["resolve_ms"] }
    END { exit !(NR == 3 && passes[2] != "" && passes[3] == "" && ms[3] > 0 && ms[3] < ms[2]) }' \
    "$here/timers/summary.csv" || complain "frames_may_have_one_timer: times in summary.csv"
id=$(awk -F, 'NR == 3 { print $2 }' "$here/timers/summary.csv")
metrics=$(grep ",$id,0,0," "$here/timers/samples.csv" | cut -d, -f6 | sort | paste -sd,)
[ "$metrics" = canary_ns,floor_frame_ms,frame_cpu_ms,frame_ms,frame_wall_ms ] ||
    complain "frames_may_have_one_timer: samples of $metrics"

# Killed at any moment, the same command continues and ends with the same rows.
for signal in INT TERM KILL; do
    env --default-signal=INT "$program" run --method kplus-array,z-buffer "${small[@]}" \
        -a launches=100 -o "$here/$signal" >"$here/out" 2>"$here/talk" &
    victim=$!
    for _ in $(seq 100); do
        grep -qs '"end"' "$here/$signal/journal.jsonl" && break
        sleep 0.05
    done
    kill -s "$signal" "$victim"
    wait "$victim"
    code=$?
    case $signal in INT) expected=130 ;; TERM) expected=143 ;; KILL) expected=137 ;; esac
    [ "$code" -eq "$expected" ] || complain "SIG$signal: exit code $code, not $expected"
    [ "$signal" = KILL ] || grep -q "continue with the same command" "$here/talk" ||
        complain "SIG$signal: does not say how to continue"
    check "run_continues_after_SIG$signal" 0 "2 ok" run 100 "$signal"
    rows=$(grep -c ',frame_ms,' "$here/$signal/samples.csv")
    [ "$rows" -eq 400 ] || complain "SIG$signal: $rows rows of frame_ms, not 400"
done
exit "$failed"
