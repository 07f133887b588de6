"use strict";

// Sort a table by a head, show one family of models, save a table as CSV or LaTeX.
(() => {
  const worth = (cell) => (cell?.dataset.v === undefined ? Infinity : Number(cell.dataset.v));

  const sort = (button) => {
    const head = button.closest("th"), table = head.closest("table");
    const heads = [...head.parentElement.children];
    const place = heads.indexOf(head) + (table.classList.contains("board") ? 1 : 0);
    const up = head.ariaSort !== "ascending";
    heads.forEach((other) => other.removeAttribute("aria-sort"));
    head.ariaSort = up ? "ascending" : "descending";
    for (const body of table.tBodies) {
      const rows = [...body.rows].filter((row) => row.dataset.model !== undefined);
      const first = (row) => row.cells[0].textContent.trim();
      rows.sort((a, b) => {
        if (!place) return up ? first(a).localeCompare(first(b)) : first(b).localeCompare(first(a));
        const [one, two] = [worth(a.cells[place]), worth(b.cells[place])];
        if (one === two) return 0;
        if (one === Infinity || two === Infinity) return one === Infinity ? 1 : -1;
        return up ? one - two : two - one;
      });
      body.append(...rows);
    }
  };

  const filter = (family) => {
    const others = [...document.querySelectorAll("tr[data-family]")];
    others.forEach((row) => { row.hidden = family !== "" && row.dataset.family !== family; });
  };

  const text = (cell) => cell.dataset.v ?? cell.textContent.replace(/\s+/g, " ").trim();
  const quoted = (value) => {
    const safe = /^[=+@-]/.test(value) && Number.isNaN(Number(value)) ? `'${value}` : value;
    return `"${safe.replaceAll('"', '""')}"`;
  };
  const escaped = (value) => value
    .replace(/[\\&%$#_{}~^]/g, (c) => ({ "\\": "\\textbackslash{}", "~": "\\textasciitilde{}", "^": "\\textasciicircum{}" })[c] ?? `\\${c}`)
    .replaceAll("±", "$\\pm$").replaceAll("−", "$-$").replaceAll("≈", "$\\approx$");

  const lines = (table, read) => [...table.rows].map((row) => [...row.cells].map(read));
  const formats = {
    csv: (table) => lines(table, (cell) => quoted(text(cell))).map((row) => row.join(",")).join("\r\n"),
    tex: (table) => {
      const rows = lines(table, (cell) => escaped(cell.textContent.replace(/\s+/g, " ").trim()));
      const shape = `l${"r".repeat(Math.max(...rows.map((row) => row.length)) - 1)}`;
      const [head, ...body] = rows.map((row) => `${row.join(" & ")} \\\\`);
      return [`\\begin{tabular}{${shape}}`, "\\toprule", head, "\\midrule", ...body, "\\bottomrule", "\\end{tabular}"].join("\n");
    },
  };
  const types = { csv: "text/csv", tex: "application/x-tex" };

  const save = (name, format, content) => {
    const blob = new Blob([content], { type: `${types[format]};charset=utf-8` });
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = `${name}.${format}`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };

  const show = (root) => root.querySelectorAll(".downloads").forEach((group) => { group.hidden = false; });
  document.addEventListener("click", ({ target }) => {
    const button = target.closest("button");
    if (button?.matches(".sort")) sort(button);
    if (button?.dataset.table) {
      const { table, format } = button.dataset;
      save(table, format, formats[format](document.getElementById(table)));
    }
  });
  document.addEventListener("filled", ({ target }) => show(target));
  document.querySelector(".filter select")?.addEventListener("change", ({ target }) => filter(target.value));
  show(document);
})();
