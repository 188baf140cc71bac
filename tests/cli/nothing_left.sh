# Whether plugins left something running: to be sourced by tests that define fail.
marker="fragmark-plugins-test-$$"
export FRAGMARK_TEST_MARKER=$marker # inherited by whatever a plugin starts

# What is still running of what the plugins started; the shell and this script are not.
expect_nothing_left() { # WHAT
    local pid left=
    for pid in /proc/[0-9]*; do
        pid=${pid#/proc/}
        if [ "$pid" != $$ ] && [ "$pid" != "${BASHPID:-0}" ] &&
            grep -qsz "^FRAGMARK_TEST_MARKER=$marker" "/proc/$pid/environ" &&
            grep -qs fragmark "/proc/$pid/cmdline"; then
            left+=" $pid"
        fi
    done
    [ -z "$left" ] || fail "$1 left running:$left"
}
