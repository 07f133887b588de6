"use strict";

// Pointing at a model, or focusing it, dims all others in every figure and table. Escape clears.
(() => {
  const root = document.documentElement;
  const rule = document.head.appendChild(document.createElement("style"));
  let shown = null;

  const show = (model) => {
    if (model === shown) return;
    shown = model;
    root.classList.toggle("highlighting", model !== null);
    rule.textContent = model === null ? "" : ruleOf(`[data-model="${CSS.escape(model)}"]`);
  };

  const ruleOf = (chosen) => `
    .highlighting :is(figure g, .strip)[data-model]:not(${chosen}) { opacity: .15; }
    .highlighting .legend ${chosen} { text-decoration: underline; }
    .highlighting tr${chosen} > * { background: var(--tint); }`;

  const modelOf = (target) => target.closest?.("[data-model]")?.dataset.model ?? null;

  document.addEventListener("pointerover", (event) => show(modelOf(event.target)));
  document.addEventListener("focusin", (event) => show(modelOf(event.target)));
  document.addEventListener("focusout", (event) => event.relatedTarget || show(null));

  // One key of each legend is in the tab order; arrows move among the others.
  const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 };
  const legends = [...document.querySelectorAll(".legend:has([data-model])")];
  for (const legend of legends) {
    const keys = [...legend.querySelectorAll("[data-model]")];
    keys.forEach((key, place) => (key.tabIndex = place ? -1 : 0));
    legend.addEventListener("keydown", (event) => {
      const next = keys[keys.indexOf(document.activeElement) + (step[event.key] ?? NaN)];
      if (!next) return;
      event.preventDefault();
      for (const key of keys) key.tabIndex = key === next ? 0 : -1;
      next.focus();
    });
  }

  addEventListener("keydown", (event) => event.key === "Escape" && show(null));
})();
