"use strict";

// "/" goes to the field that finds a task by its title, or a model in the scoreboard.
(() => {
  const field = document.querySelector(".finder input");
  const said = document.querySelector(".finder output");
  const name = (node) => (node.dataset.model ?? node.textContent.trim()).toLowerCase();

  // The first whose name is what was typed, else begins so, else contains it.
  const named = (selector, typed) => {
    const nodes = [...document.querySelectorAll(selector)];
    const fits = [(n) => n === typed, (n) => n.startsWith(typed), (n) => n.includes(typed)];
    return fits.map((fit) => nodes.find((node) => fit(name(node)))).find(Boolean);
  };

  const find = () => {
    const typed = field.value.trim().toLowerCase();
    const task = typed && (named(".contents li a", typed) ?? named(".answers li a", typed));
    const row = typed && !task && named("tr[data-model]", typed);
    said.textContent = typed && !task && !row ? "no model or task of that name" : "";
    if (task) { location.hash = task.hash; return; }
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
  document.addEventListener("click", ({ target }) => {
    const inside = target.closest(".contents details");
    document.querySelectorAll(".contents details[open]").forEach((menu) => {
      if (menu !== inside || target.closest("li a")) menu.open = false;
    });
  });
})();
