"use strict";

// Sort a table by a head, show one family of models.
(() => {
  // What is absent, or not compared as it is incomplete, comes last.
  const worth = (cell) => (
    cell?.dataset.v === undefined || cell.matches(".incomplete") ? Infinity : Number(cell.dataset.v)
  );

  const sort = (button) => {
    const head = button.closest("th"), table = head.closest("table");
    const heads = [...head.parentElement.children];
    const place = heads.indexOf(head) + (table.classList.contains("board") ? 1 : 0);
    const up = head.ariaSort !== "ascending";
    heads.forEach((other) => other.removeAttribute("aria-sort"));
    head.ariaSort = up ? "ascending" : "descending";
    const first = (row) => row.cells[0].textContent.trim();
    const byName = (a, b) => (up ? 1 : -1) * first(a).localeCompare(first(b));
    const byWorth = (a, b) => {
      const [one, two] = [worth(a.cells[place]), worth(b.cells[place])];
      if (one === two) return 0;
      if (one === Infinity || two === Infinity) return one === Infinity ? 1 : -1;
      return up ? one - two : two - one;
    };
    // Families of the scoreboard become one list, of which references stay apart.
    const [below, above] = [true, false].map((last) => [...table.tBodies].filter(
      (body) => body.classList.contains("below") === last,
    ));
    for (const bodies of [above, below].filter((group) => group.length)) {
      const rows = bodies.flatMap((body) => [...body.rows]).filter((row) => "model" in row.dataset);
      bodies[0].append(...rows.sort(place ? byWorth : byName));
    }
    table.querySelectorAll("tbody:not(.below) .family").forEach((row) => row.remove());
  };

  const choice = document.querySelector(".filter select");
  const filter = () => document.querySelectorAll("tr[data-family]").forEach((row) => {
    row.hidden = choice.value !== "" && row.dataset.family !== choice.value;
    const heading = row.parentElement.querySelector(".family");
    if (heading) heading.hidden = row.hidden;
  });

  document.addEventListener("click", ({ target }) => {
    const button = target.closest(".sort");
    if (button) sort(button);
  });
  choice.addEventListener("change", filter);
  document.addEventListener("filled", filter);
})();
