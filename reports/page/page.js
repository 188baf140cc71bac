// Tables sort by a click on a heading and filter as one types; without scripts they only stand still.
"use strict";
function value(row, column) {
  const cell = row.cells[column];
  const text = cell.dataset.v ?? cell.textContent;
  const number = parseFloat(text);
  return text === "" ? null : text === "inf" ? Infinity : Number.isNaN(number) ? text.toLowerCase() : number;
}
function compare(a, b, sign) {
  if (a === null || b === null) return (a === null) - (b === null); // empty cells stay last
  if (typeof a !== typeof b) return typeof a === "number" ? -1 : 1;
  return a < b ? -sign : a > b ? sign : 0;
}
function sort(table, heading) {
  const column = heading.cellIndex;
  const sign = heading.getAttribute("aria-sort") === "ascending" ? -1 : 1;
  for (const other of heading.parentNode.cells) other.removeAttribute("aria-sort");
  heading.setAttribute("aria-sort", sign > 0 ? "ascending" : "descending");
  const rows = [...table.tBodies[0].rows];
  rows.sort((a, b) => compare(value(a, column), value(b, column), sign));
  table.tBodies[0].append(...rows);
}
// A row is shown when it has all the words and, of a table of verdicts, the verdict that is pressed.
function choose(table) {
  const words = (table.filterText ?? "").toLowerCase().split(/\s+/);
  for (const row of table.tBodies[0].rows)
    row.hidden = !words.every(word => row.textContent.toLowerCase().includes(word)) ||
      (table.wantedVerdict !== undefined && row.dataset.verdict !== table.wantedVerdict);
}
function addVerdicts(counts, table) {
  for (const button of counts.children)
    button.addEventListener("click", () => {
      const verdict = button.dataset.verdict;
      table.wantedVerdict = table.wantedVerdict === verdict ? undefined : verdict;
      for (const other of counts.children)
        other.setAttribute("aria-pressed", other.dataset.verdict === table.wantedVerdict);
      choose(table);
    });
}
function addFilter(table) {
  const input = document.createElement("input");
  input.className = "filter";
  input.placeholder = "filter rows, e.g. K+B ok";
  input.setAttribute("aria-label", "filter rows");
  input.addEventListener("input", () => {
    table.filterText = input.value;
    choose(table);
  });
  table.parentNode.before(input);
}
for (const table of document.querySelectorAll(".table table")) {
  table.classList.add("sortable");
  for (const heading of table.tHead.rows[0].cells)
    heading.addEventListener("click", () => sort(table, heading));
  if (table.tBodies[0].rows.length > 8 || table.matches(".verdicts")) addFilter(table);
}
for (const counts of document.querySelectorAll(".counts"))
  addVerdicts(counts, counts.parentNode.querySelector(`#${CSS.escape(counts.dataset.table)}`));
