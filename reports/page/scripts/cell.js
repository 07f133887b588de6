"use strict";

// Opens what is known of a cell of a score table at its address, #cell=task/case/label.
(() => {
  const dialog = document.getElementById("cell");
  const { columns, tasks, shared } = JSON.parse(document.getElementById("cells").textContent);
  const part = (name) => dialog.querySelector(`[data-cell="${name}"]`);
  const title = document.getElementById("cell-title");

  const element = (name, attributes = {}, ...children) => {
    const node = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
    node.append(...children);
    return node;
  };
  const digits = (value) => value === null ? "–" : String(+value.toPrecision(4)).replace("-", "−");
  const address = (...names) => `#cell=${names.map(encodeURIComponent).join("/")}`;

  const cellsOf = (task) => tasks[task].rows.map((row) => {
    const cell = Object.fromEntries(columns.map((name, place) => [name, row[place]]));
    for (const name of ["case", "label", "model", "parameters", "recordings"]) {
      cell[name] = shared[cell[name]];
    }
    return cell;
  });

  const keysOf = ({ keys, folds }) => {
    const bytes = Array.from(atob(keys), (byte) => byte.charCodeAt().toString(16).padStart(2, "0"));
    const each = bytes.length / folds.length;
    return folds.map((_, place) => bytes.slice(place * each, (place + 1) * each).join(""));
  };

  const drawing = (values, mean, half, published) => {
    const marks = [...values, mean - half, mean + half, ...published].filter((value) => value !== null);
    const [low, high] = [Math.min(...marks), Math.max(...marks)];
    const x = (value) => (high > low ? 6 + 128 * (value - low) / (high - low) : 70).toFixed(1);
    const dots = values.filter((value) => value !== null).map((value) => `<circle cx="${x(value)}" cy="9" r="3"/>`);
    const interval = half ? `<path class="interval" d="M${x(mean - half)} 9H${x(mean + half)}"/>` : "";
    const diamonds = published.map((value) => `<path class="published" d="M${x(value)} 4l5 5-5 5-5-5z"/>`);
    const drawn = element("span");
    drawn.innerHTML = `<svg width="140" height="18" aria-hidden="true">${interval}${diamonds.join("")}${dots.join("")}<path class="mean" d="M${x(mean)} 2v14"/></svg>`;
    return drawn;
  };

  const besides = ([value, twoSd, source, verdict, reason, erratum]) => {
    const spread = twoSd === null ? "" : ` ± ${digits(twoSd)}`;
    const remarks = [shared[source], shared[verdict], shared[reason], shared[erratum]].filter(Boolean);
    return [`${digits(value)}${spread}`, element("small", {}, remarks.join(" · "))];
  };

  const scoreRow = ([, name, goal], score) => {
    const [values, mean, half, published] = score ?? [[], null, null];
    const head = element("th", { scope: "row" }, name, element("small", {}, goal));
    const interval = half === null ? "–" : `${digits(mean - half)} to ${digits(mean + half)}`;
    const drawn = score ? [drawing(values, mean, half, published ? [published[0]] : [])] : ["no score"];
    const n = values.filter((value) => value !== null).length;
    return element("tr", {}, head, element("td", {}, ...drawn), element("td", {}, String(n)),
      element("td", {}, digits(mean)), element("td", {}, interval),
      element("td", { class: "text" }, ...(published ? besides(published) : ["–"])));
  };

  const foldRow = (cell, place) => {
    const fold = cell.folds[place];
    const failure = cell.failures.find(([failed]) => failed === fold);
    const [, status, message, id] = failure ?? [];
    const ending = failure ? shared[status] : "ok";
    const state = document.getElementById(id ?? "") ? element("a", { href: `#${id}` }, ending) : ending;
    const costs = ["fit_seconds", "predict_seconds", "peak_memory_mb"].map((name) => cell[name][place]);
    const numbers = [...cell.scores.map((score) => score?.[0][place] ?? null), ...costs];
    const note = failure ? [element("small", {}, shared[message])] : [];
    return element("tr", {}, element("th", { scope: "row" }, String(fold + 1)),
      element("td", { class: "text" }, state, ...note),
      ...numbers.map((value) => element("td", {}, digits(value))));
  };

  const origin = (cell) => [
    ["model", cell.model], ["parameters", cell.parameters || "none"], ["seed", String(cell.seed)],
    ...keysOf(cell).map((key, place) => [`key, fold ${cell.folds[place] + 1}`, element("code", {}, key)]),
    ...cell.recordings.map(([uri, digest]) => [uri, element("code", {}, digest)]),
  ].flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]);

  const neighbour = (name, task, cell, sign) => {
    part(name).hidden = !cell;
    if (!cell) return;
    part(name).href = address(task, cell.case, cell.label);
    part(name).textContent = sign(cell.label);
  };

  const ofCases = (task, cell, cells) => cells.map((other) => element("a", {
    href: address(task, other.case, other.label),
    ...(other.case === cell.case ? { "aria-current": "true" } : {}),
  }, other.case));

  const fill = (task, cell) => {
    const { metrics } = tasks[task], cells = cellsOf(task);
    const row = cells.filter((other) => other.case === cell.case);
    const column = cells.filter((other) => other.label === cell.label);
    part("cases").hidden = column.length === 1;
    part("cases").replaceChildren(...ofCases(task, cell, column));
    const place = row.findIndex((other) => other.label === cell.label);
    neighbour("previous", task, row[place - 1], (label) => `← ${label}`);
    neighbour("next", task, row[place + 1], (label) => `${label} →`);
    part("scores").replaceChildren(...metrics.map((metric, index) => scoreRow(metric, cell.scores[index])));
    const names = [...metrics.map(([, name]) => name), "fit, s", "predict, s", "memory, MB"];
    part("fold-columns").replaceChildren(element("tr", {}, ...["fold", "status", ...names].map(
      (name) => element("th", { scope: "col", class: name === "status" ? "text" : "" }, name))));
    part("folds").replaceChildren(...cell.folds.map((_, place) => foldRow(cell, place)));
    part("command").replaceChildren(...cell.command.flatMap(
      (piece, index) => [index ? " " : "", element("span", {}, shared[piece])]));
    part("origin").replaceChildren(...origin(cell));
    part("copied").textContent = "";
  };

  const named = (hash) => {
    if (!hash.startsWith("#cell=")) return null;
    try {
      return hash.slice(6).split("/").slice(0, 3).map(decodeURIComponent);
    } catch {
      return [hash.slice(6)]; // not an address that any page has
    }
  };

  let before = null; // where a link of this page opened the dialog, so that going back closes it
  const show = ([task, name, label]) => {
    const known = Object.hasOwn(tasks, task) ? cellsOf(task) : [];
    const cell = known.find((other) => other.label === label && (other.case === name || name === ""));
    title.textContent = cell ? `${label} · ${cell.case}` : "No such cell";
    part("where").textContent = cell ? `${tasks[task].title} · ${task}`
      : `This report has no cell “${[task, name, label].filter((each) => each !== undefined).join("/")}”. A cell is task/case/model, as the tables name them.`;
    part("known").hidden = !cell;
    if (cell) fill(task, cell);
    if (!dialog.open) dialog.showModal();
    dialog.scrollTop = 0;
    title.focus();
  };

  const follow = () => {
    const names = named(location.hash);
    if (names) return show(names);
    dialog.close();
    if (before?.hash === location.hash) scrollTo({ top: before.top, behavior: "instant" });
    before = null;
  };

  const leave = () => {
    if (before) return history.back();
    history.replaceState(null, "", location.pathname + location.search);
    dialog.close();
  };

  const select = () => {
    getSelection().selectAllChildren(part("command"));
    part("copied").textContent = "Selected; copy it with the keyboard.";
  };

  const copy = async () => {
    try {
      await navigator.clipboard.writeText(part("command").textContent);
      part("copied").textContent = "Copied.";
    } catch { // a page from a file may not be allowed to
      select();
    }
  };

  addEventListener("hashchange", ({ oldURL }) => {
    if (!dialog.open) before = { hash: new URL(oldURL).hash, top: scrollY };
    follow();
  });
  dialog.addEventListener("cancel", (event) => { event.preventDefault(); leave(); });
  dialog.addEventListener("click", (event) => {
    const link = event.target.closest("nav a");
    if (event.target === dialog) leave();
    if (!link) return;
    event.preventDefault(); // one entry in the history, however many cells are looked at
    location.replace(link.href);
  });
  part("close").addEventListener("click", leave);
  part("copy").addEventListener("click", copy);
  follow();
})();
