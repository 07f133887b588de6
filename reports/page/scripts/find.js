"use strict";

// "/" goes to the field that finds a task by its title, or a model in the scoreboard.
(() => {
  const field = document.querySelector(".finder input");
  const named = (selector, name) => [...document.querySelectorAll(selector)].find(
    (node) => (node.dataset.model ?? node.textContent.trim()) === name,
  );

  const find = () => {
    const name = field.value.trim();
    const task = named(".contents li a", name);
    if (task) { location.hash = task.hash; return; }
    const row = named("#scoreboard tr[data-model]", name) ?? named("tr[data-model]", name);
    if (!row) return;
    row.scrollIntoView({ block: "center" });
    (row.querySelector("a, button") ?? row).focus();
  };

  field.addEventListener("change", find);
  document.addEventListener("keydown", (event) => {
    if (event.key !== "/" || event.target.closest("input, select, textarea")) return;
    event.preventDefault();
    field.focus();
    field.select();
  });
  document.querySelector(".contents")?.addEventListener("click", ({ target }) => {
    const link = target.closest("li a");
    if (link) link.closest("details").open = false;
  });
})();
