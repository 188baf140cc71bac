#!/usr/bin/env bash
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source .ci/setup.sh

usage() {
    cat <<'USAGE'
Usage: ./reproduce.sh [-o DIR] [--set-up-only] [--help]

Installs what is missing (Debian 12, apt), builds fragmark and reproduces a first figure in a few
minutes, without a GPU: k+-buffer's Fig. 5 in its smoke size, and eight methods on the Stanford
bunny. Says where report.html is. Run again, it builds what changed, measures what is missing and
reports again; to measure anew, remove DIR or give another.

  -o DIR         where results go (default: out)
  --set-up-only  install and build, run nothing
  --help         this text

Exit codes: 0 done; 2 something is missing and cannot be installed here (the command for an
administrator is printed), or a wrong option; 1 the build failed; else that of fragmark (runner/README.md).
USAGE
}

out=out
set_up_only=false
while [ $# -gt 0 ]; do
    case $1 in
    --help | -h) usage; exit 0 ;;
    --set-up-only) set_up_only=true ;;
    -o) [ $# -ge 2 ] || { say "reproduce.sh: -o needs a directory"; exit 2; }
        out=$2; shift ;;
    *) say "reproduce.sh: unknown option '$1' (see --help)"; exit 2 ;;
    esac
    shift
done

start=$SECONDS
install_packages build || exit $?
build_preset bench
$set_up_only && exit 0

status=0
build/bench/fragmark reproduce kplus-05 quick-bunny --smoke -o "$out" || status=$?

say "reproduce.sh: took $(since "$start") in all"
[ -f "$out/report.html" ] && echo "report: $(realpath "$out/report.html")"
exit "$status"
