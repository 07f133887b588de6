"use strict";

// Sort a table by a head, show one family of models.
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

  const choice = document.querySelector(".filter select");
  const filter = () => document.querySelectorAll("tr[data-family]").forEach((row) => {
    row.hidden = choice.value !== "" && row.dataset.family !== choice.value;
  });

  document.addEventListener("click", ({ target }) => {
    const button = target.closest(".sort");
    if (button) sort(button);
  });
  choice.addEventListener("change", filter);
  document.addEventListener("filled", filter);
})();
