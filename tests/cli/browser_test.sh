#!/usr/bin/env bash
# browser_test.sh FRAGMARK: a small reproduction's report in headless Chromium: the page counts verdicts as
# claims.csv does, filters hide rows, links inside the page have a target, and nothing is wider than a
# phone. Without Chromium or Python it is skipped.
set -euo pipefail
program=$1
browser=$(command -v chromium || command -v chromium-browser || true)
[ -n "$browser" ] || { echo "no chromium: skipped"; exit 77; }
command -v python3 >/dev/null || { echo "no python3: skipped"; exit 77; }
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
code=0
"$program" reproduce kplus-03 kplus-table1 sbuffer-01 sbuffer-memory --smoke \
    -a frames=1 --quiet -o "$here/run" >"$here/out" 2>"$here/talk" || code=$?
[ "$code" = 0 ] || [ "$code" = 1 ] || { cat "$here/talk"; exit 1; } # 1: a claim fails, which is no matter here

# The page with a script at its end that writes what it finds into the document.
cat "$here/run/report.html" - >"$here/run/page.html" <<'HTML'
<script>
const found = {};
found.counts = [...document.querySelectorAll(".counts button")]
  .map(b => b.dataset.verdict + "=" + b.querySelector("b").textContent).join(",");
found.broken = [...document.querySelectorAll("a[href^='#']")]
  .filter(a => document.getElementById(a.getAttribute("href").slice(1)) === null).length;
const shown = () => document.querySelectorAll(".verdicts tbody tr:not([hidden])").length;
found.all = shown();
for (const b of document.querySelectorAll(".counts button[data-verdict=holds]")) b.click();
found.holds = shown();
for (const b of document.querySelectorAll(".counts button[data-verdict=holds]")) b.click();
for (const i of document.querySelectorAll("input.filter")) {
  i.value = "KP-26"; i.dispatchEvent(new Event("input"));
}
found.filtered = shown();
found.wide = document.documentElement.scrollWidth - document.documentElement.clientWidth;
document.title = JSON.stringify(found);
document.body.innerHTML = "<pre id=found>" + document.title + "</pre>";
</script>
HTML
# The essentials, at the width of a desktop and of a phone.
for size in 1280,800 500,800; do
    "$browser" --headless --no-sandbox --disable-gpu --window-size=$size --dump-dom \
        "file://$here/run/page.html" 2>/dev/null | sed -n 's/.*<pre id="found">\(.*\)<\/pre>.*/\1/p' >"$here/found"
    python3 - "$here/found" "$here/run/claims.csv" "$here/run" <<'PYTHON'
import csv, json, os, re, sys
found = json.load(open(sys.argv[1]))
rows = list(csv.DictReader(open(sys.argv[2])))
count = lambda verdict: sum(r["verdict"] == verdict for r in rows)
told = {}
for part in found["counts"].split(","):
    verdict, number = part.split("=")
    told[verdict] = told.get(verdict, 0) + int(number)
assert rows, "claims.csv is empty"
for verdict in ("holds", "fails", "unclear", "not testable here"):
    assert told[verdict] == count(verdict), (verdict, told, count(verdict))
assert found["all"] == len(rows), found
assert found["holds"] == count("holds"), found
assert found["filtered"] == sum("KP-26" in " ".join(r.values()) for r in rows) > 0, found
assert found["broken"] == 0, found
assert found["wide"] <= 0, found
html = open(sys.argv[3] + "/report.html").read()
for link in re.findall(r'(?:href|src)="([^"#:]+)"', html):
    assert os.path.exists(os.path.join(sys.argv[3], link)), link
assert not re.search(r'(?:src|href)="https?:', html), "the page needs the network"
print(sys.argv[1], "is as claims.csv says:", found)
PYTHON
done
