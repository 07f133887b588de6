"use strict";

// Draws matrices and point clouds from the data beside them, again when the colours change.
(() => {
  const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const styles = getComputedStyle(document.documentElement);
  const colour = (name) => styles.getPropertyValue(`--${name}`).trim();
  const rgb = (name) => [1, 3, 5].map((at) => parseInt(colour(name).slice(at, at + 2), 16));
  const mixed = (one, other, share) => one.map((part, i) => part + share * (other[i] - part));

  const drawMatrix = (canvas) => {
    const rows = Number(canvas.dataset.rows);
    const cells = new Int8Array(bytes(canvas.dataset.cells).buffer);
    const size = Math.max(3, Math.floor(520 / rows)); // pixels a cell
    const levels = [...Array(9).keys()].map((level) => rgb(`level-${level}`));
    const ink = rgb("ink");
    canvas.width = canvas.height = rows * size;
    const context = canvas.getContext("2d");
    const image = context.createImageData(canvas.width, canvas.height);
    for (let y = 0, at = 0; y < canvas.height; y += 1) {
      for (let x = 0; x < canvas.width; x += 1, at += 4) {
        const value = cells[Math.floor(y / size) * rows + Math.floor(x / size)];
        const place = (value / 127 + 1) * 4;
        const below = Math.min(7, Math.floor(place));
        const plain = mixed(levels[below], levels[below + 1], place - below);
        const hatched = value < -14 && (x + y) % 6 === 0;
        image.data.set(hatched ? mixed(plain, ink, 0.4) : plain, at);
        image.data[at + 3] = 255;
      }
    }
    context.putImageData(image, 0, 0);
  };

  const names = { ht: "ink", hr: "series-reference" };
  const points = (text) => new Int16Array(bytes(text).buffer);
  const place = (at, list, view, side) => {
    const [up, around] = view.map((angle) => (angle * Math.PI) / 180);
    const [x, y, z] = [0, 1, 2].map((axis) => list[3 * at + axis] / 32767);
    const right = -Math.sin(around) * x + Math.cos(around) * y;
    const above = -Math.sin(up) * (Math.cos(around) * x + Math.sin(around) * y) + Math.cos(up) * z;
    return [side / 2 + (right * side) / 3.6, side / 2 - (above * side) / 3.6];
  };

  // The corner of least values, and the ends of the three axes.
  const AXES = [-1, -1, -1, 1, -1, -1, -1, 1, -1, -1, -1, 1].map((end) => end * 32767);
  const drawSpace = (canvas, space) => {
    const context = canvas.getContext("2d");
    const side = canvas.width;
    context.clearRect(0, 0, side, side);
    context.strokeStyle = context.fillStyle = colour("quiet");
    const corner = place(0, AXES, space.view, side);
    ["x₁", "x₂", "x₃"].forEach((name, at) => {
      const end = place(at + 1, AXES, space.view, side);
      context.beginPath();
      context.moveTo(...corner);
      context.lineTo(...end);
      context.stroke();
      context.fillText(name, ...end);
    });
    context.globalAlpha = 0.8;
    space.levels.forEach((level, at) => {
      context.fillStyle = colour(`level-${level}`);
      context.fillRect(...place(at, space.points, space.view, side).map((x) => x - 1.5), 3, 3);
    });
    context.globalAlpha = 1;
    for (const { hue, list } of space.lines) {
      context.strokeStyle = colour(names[hue] ?? `series-${hue.slice(1)}`);
      context.lineWidth = 1.5;
      context.beginPath();
      let broken = true;
      for (let at = 0; at < list.length / 3; at += 1) {
        if (list[3 * at] === -32768) broken = true;
        else {
          context[broken ? "moveTo" : "lineTo"](...place(at, list, space.view, side));
          broken = false;
        }
      }
      context.stroke();
    }
  };

  const turnable = (canvas) => {
    const space = JSON.parse(canvas.dataset.space);
    space.points = points(space.cloud);
    space.lines = space.paths.map(([hue, , list]) => ({ hue, list: points(list) }));
    const turn = (up, around) => {
      space.view = [Math.max(-90, Math.min(90, space.view[0] + up)), space.view[1] + around];
      drawSpace(canvas, space);
    };
    const keys = { ArrowLeft: [0, -5], ArrowRight: [0, 5], ArrowUp: [5, 0], ArrowDown: [-5, 0] };
    canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons) turn(event.movementY / 2, -event.movementX / 2);
    });
    canvas.addEventListener("keydown", (event) => {
      if (!(event.key in keys)) return;
      event.preventDefault();
      turn(...keys[event.key]);
    });
    return () => drawSpace(canvas, space);
  };

  // What is far down the page is drawn when it comes near.
  const drawn = new Map();
  const near = new IntersectionObserver(
    (entries) => {
      for (const { target, isIntersecting } of entries) {
        if (!isIntersecting || drawn.has(target)) continue;
        drawn.set(target, target.dataset.rows ? () => drawMatrix(target) : turnable(target));
        drawn.get(target)();
      }
    },
    { rootMargin: "50%" },
  );
  const canvases = document.querySelectorAll("canvas[data-rows], canvas[data-space]");
  for (const canvas of canvases) {
    canvas.hidden = false; // what is hidden never comes near
    near.observe(canvas);
  }

  const again = () => drawn.forEach((draw) => draw());
  const all = () => {
    for (const canvas of canvases) {
      if (canvas.dataset.rows && !drawn.has(canvas)) drawn.set(canvas, () => drawMatrix(canvas));
    }
    again();
  };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", again);
  matchMedia("print").addEventListener("change", all);
  addEventListener("beforeprint", all);
})();
