"use strict";

// Save a table as CSV or LaTeX, and the numbers of all cells as CSV.
(() => {
  const plain = (node) => node.textContent.replace(/\s+/g, " ").trim();

  // A difference and its interval are two columns; a drawing is none.
  const parts = (cell) => {
    if (cell.matches(".drawn")) return [];
    const number = cell.dataset.v ?? plain(cell);
    if (!cell.matches(".lag")) return [number];
    const note = cell.querySelector("small");
    return [cell.dataset.v ?? plain(cell.firstChild ?? cell), note ? plain(note) : ""];
  };

  // What a spreadsheet would take for a formula gets an apostrophe (reports/spreadsheet.py).
  const quoted = (value) => {
    const number = value !== "" && !Number.isNaN(Number(value));
    const safe = number || !/^'*[-=+@\t\r\n＝＋－＠]/.test(value) ? value : `'${value}`;
    return `"${safe.replaceAll('"', '""')}"`;
  };
  const csv = (rows) => rows.map((row) => row.map(quoted).join(",")).join("\r\n");

  const LATEX = { "\\": "\\textbackslash{}", "~": "\\textasciitilde{}", "^": "\\textasciicircum{}",
    "|": "\\textbar{}", "<": "$<$", ">": "$>$", "±": "$\\pm$", "−": "$-$", "≈": "$\\approx$" };
  const escaped = (value) => value
    .replace(/[\\&%$#_{}~^|<>±−≈]/g, (c) => LATEX[c] ?? `\\${c}`)
    .replace(/^[[*]/, "{}$&"); // else an argument of the line break before
  const latex = (rows) => {
    const shape = `l${"r".repeat(Math.max(...rows.map((row) => row.length)) - 1)}`;
    const [head, ...body] = rows.map((row) => `${row.map(escaped).join(" & ")} \\\\`);
    return [`\\begin{tabular}{${shape}}`, "\\toprule", head, "\\midrule", ...body, "\\bottomrule", "\\end{tabular}", ""].join("\n");
  };

  const shown = (cell) => (cell.matches(".drawn") ? [] : [plain(cell)]);
  const rows = (id, read) => [...document.getElementById(id).rows].map((row) => [...row.cells].flatMap(read));
  const formats = { csv: (id) => csv(rows(id, parts)), tex: (id) => latex(rows(id, shown)) };

  const everyNumber = () => {
    const { columns, tasks, shared } = JSON.parse(document.getElementById("cells").textContent);
    const place = Object.fromEntries(columns.map((name, index) => [name, index]));
    const numbers = [["task", "case", "fold", "label", "metric", "value"]];
    for (const [task, { metrics, rows: cells }] of Object.entries(tasks)) {
      for (const cell of cells) {
        const [name, label] = [shared[cell[place.case]], shared[cell[place.label]]];
        metrics.forEach(([metric], which) => cell[place.scores][which]?.[0].forEach((value, nth) => {
          const fold = cell[place.folds][nth];
          if (value !== null) numbers.push([task, name, String(fold), label, metric, String(value)]);
        }));
      }
    }
    return csv(numbers);
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

  document.addEventListener("click", ({ target }) => {
    const button = target.closest("button");
    if (button?.matches("[data-all-numbers]")) save("all-numbers", "csv", everyNumber());
    if (button?.dataset.table) {
      const { table, format } = button.dataset;
      save(table, format, formats[format](table));
    }
  });

  const show = (root) => root.querySelectorAll(".downloads, [data-all-numbers]").forEach((offer) => { offer.hidden = false; });
  document.addEventListener("filled", ({ target }) => show(target));
  show(document);
})();
