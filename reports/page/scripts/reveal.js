"use strict";

// What is folded stands in a template until it is opened, so that the page is there at once.
(() => {
  const fill = (details) => details.querySelectorAll(":scope > template").forEach((template) => {
    template.replaceWith(template.content);
    details.dispatchEvent(new Event("filled", { bubbles: true }));
  });

  const holder = (id) => [...document.querySelectorAll("details > template")].find(
    (template) => template.content.getElementById(id),
  );

  const reveal = () => {
    const id = location.hash.slice(1); // ids have letters, digits and hyphens alone
    if (!id || id.startsWith("cell=")) return;
    const folded = holder(id);
    if (folded) fill(folded.parentElement);
    const target = document.getElementById(id);
    for (let node = target; node; node = node.parentElement) {
      if (node instanceof HTMLDetailsElement) node.open = true;
    }
    if (target) land(target);
  };

  // Sections are laid out when they come near, which moves what is below them.
  const land = (target, times = 40) => {
    const before = target.getBoundingClientRect().top;
    target.scrollIntoView({ behavior: "instant" });
    const moved = Math.abs(target.getBoundingClientRect().top - before) > 1;
    if (times && (moved || times > 34)) requestAnimationFrame(() => land(target, times - 1));
  };

  document.addEventListener("toggle", ({ target }) => target.open && fill(target), true);
  let folded = [];
  addEventListener("beforeprint", () => {
    folded = [...document.querySelectorAll("details:not([open])")];
    folded.forEach((details) => { fill(details); details.open = true; });
  });
  addEventListener("afterprint", () => folded.forEach((details) => { details.open = false; }));
  // Where a cell was opened, cell.js brings back what was in view; elsewhere its links lead.
  let behind = null;
  addEventListener("hashchange", ({ oldURL }) => {
    const left = new URL(oldURL).hash, ofCell = left.startsWith("#cell=");
    if (!ofCell) behind = left;
    if (!ofCell || location.hash !== behind) reveal();
  });
  document.addEventListener("click", ({ target }) => {
    const link = target.closest('a[href^="#"]');
    if (link && link.hash === location.hash) reveal();
  });
  reveal();
})();
