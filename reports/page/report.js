"use strict";

// The page works without this script, which adds downloads and opens the section of a link.
(() => {
  const tables = JSON.parse(document.getElementById("downloads").textContent);
  const types = { csv: "text/csv", tex: "application/x-tex" };

  const save = ({ table, format }) => {
    const blob = new Blob([tables[table][format]], { type: `${types[format]};charset=utf-8` });
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = `${table}.${format}`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };

  const reveal = () => {
    if (location.hash.startsWith("#cell=")) return; // scripts/cell.js opens these
    const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
    for (let node = target; node; node = node.parentElement) {
      if (node instanceof HTMLDetailsElement) node.open = true;
    }
    target?.scrollIntoView();
  };

  for (const group of document.querySelectorAll(".downloads")) group.hidden = false;
  for (const button of document.querySelectorAll("button[data-table]")) {
    button.addEventListener("click", () => save(button.dataset));
  }
  addEventListener("hashchange", reveal);
  if (location.hash) reveal();
})();
