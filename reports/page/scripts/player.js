"use strict";

// Motion players: the truth and two models as bodies that move, and their controls. Each is decoded
// and drawn when it comes near the part of the page that is seen.
(() => {
  const { colours, errors, extent, limbs, paint, reader, unpack } = bodies;
  const VIEWS = { side: [0, 0.09], front: [-Math.PI / 2, 0.09], free: [-0.7, 0.22] };
  const KEYS = { 1: "side", 2: "front", 3: "free" };
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const dark = matchMedia("(prefers-color-scheme: dark)");

  const ENDS = [1, 2, 5, 10, 15, 20, 30, 40, 50, 75, 100];
  const nice = (value) => ENDS.find((end) => value <= end) ?? 150;

  const hiddenFrames = (data) => {
    const hidden = new Array(data.frames).fill(false);
    for (const [first, stop] of data.hidden) hidden.fill(true, first, stop);
    return hidden;
  };

  /** Return the background of the scrubber, where a frame's place is that of the thumb. */
  const bands = (data) => {
    const colour = "color-mix(in oklab, var(--series-4) 45%, var(--paper))";
    const percent = (frame) => `${((100 * frame) / (data.frames - 1)).toFixed(2)}%`;
    const stops = data.hidden.map(([first, stop]) => {
      const [from, to] = [percent(first), percent(stop - 1)];
      return `transparent ${from}, ${colour} ${from}, ${colour} ${to}, transparent ${to}`;
    });
    return stops.length ? `linear-gradient(90deg, ${stops.join(", ")})` : "none";
  };

  class Player {
    constructor(root, data, steps) {
      Object.assign(this, { root, data, frame: 0, playing: false });
      Object.assign(this, { errors: false, layout: "beside" });
      this.at = reader(data, steps);
      this.hidden = hiddenFrames(data);
      this.limbs = limbs(data, this.at(0, 0));
      this.extent = extent(this);
      this.still = calm.matches;
      this.colours = colours(root);
      this.angles = [...VIEWS.side];
      this.canvas = this.find("canvas");
      this.slider = this.find("input[type=range]");
      this.view = this.find("[data-view]");
      this.slider.max = data.frames - 1;
      this.find(".player-shade").style.backgroundImage = bands(data);
      this.listen();
      this.choose();
    }

    find(selector) { return this.root.querySelector(selector); }

    against(motion) {
      const n = this.data.truths.length;
      return motion < n ? motion : this.data.motions[motion - n][1];
    }

    name(motion) {
      const n = this.data.truths.length;
      return motion < n ? this.data.truths[motion] : this.data.motions[motion - n][0];
    }

    show() {
      const find = (selector) => this.find(selector), still = this.still;
      this.slider.value = this.frame;
      this.slider.setAttribute("aria-valuetext", `${this.seconds()} seconds`);
      find("[data-play]").textContent = this.playing ? "Pause" : "Play";
      find(".player-playback").hidden = still;
      find(".player-strip-note").hidden = !still || !calm.matches;
      find(".player-scale").hidden = !this.errors;
      find("[data-most]").textContent = `${this.most} cm or more`;
      find("output").textContent = still ? "" : this.sentence();
      this.root.classList.toggle("is-free", this.view.value === "free");
      paint(this);
    }

    seconds() { return (this.frame * this.data.interval).toFixed(2); }

    sentence() {
      const where = `${this.seconds()} s, frame ${this.frame + 1} of ${this.data.frames}`;
      const gap = this.hidden[this.frame] ? ", hidden" : "";
      const [a, b] = ["a", "b"].map((side) =>
        `${this.name(this.chosen[side])} ${this.means[side][this.frame].toFixed(1)} cm`);
      return `${where}${gap}. Mean distance of joints from the recording: A ${a}, B ${b}.`;
    }

    choose() {
      const number = (side) => Number(this.find(`[data-choice=${side}]`).value);
      const [a, b] = ["a", "b"].map((side) => this.data.truths.length + number(side));
      const [one, other] = [errors(this, a), errors(this, b)];
      this.chosen = { a, b };
      this.means = { a: one.means, b: other.means };
      this.most = nice(Math.max(one.most, other.most));
      this.show();
    }

    look(view) {
      this.view.value = view;
      this.angles = [...VIEWS[view]];
      this.show();
    }

    run(playing) {
      this.playing = playing;
      this.clock = this.frame * this.data.interval;
      this.last = performance.now();
      cancelAnimationFrame(this.next);
      if (playing) this.next = requestAnimationFrame((now) => this.step(now));
      this.show();
    }

    step(now) {
      const { frames, interval } = this.data, speed = Number(this.find("[data-speed]").value);
      const passed = Math.max(now - this.last, 0) / 1000; // the first frame may have begun before
      this.clock = (this.clock + passed * speed) % (frames * interval);
      this.last = now;
      this.frame = Math.min(Math.floor(this.clock / interval), frames - 1);
      this.next = requestAnimationFrame((later) => this.step(later));
      this.show();
    }

    jump(frame) {
      this.frame = Math.min(Math.max(frame, 0), this.data.frames - 1);
      this.run(false);
    }

    animate(moving) {
      this.still = !moving;
      this.run(false);
    }

    press(event) {
      const { key, target, altKey, ctrlKey, metaKey } = event;
      if (this.still || altKey || ctrlKey || metaKey || target.matches("select")) return;
      if (key === " " && target.matches("button, [type=checkbox]")) return;
      const [left, right] = [this.frame - 1, this.frame + 1];
      const moves = { ArrowLeft: left, ArrowRight: right, Home: 0, End: Infinity };
      if (key === " ") this.run(!this.playing);
      else if (key in KEYS) this.look(KEYS[key]);
      else if (key in moves && target !== this.slider) this.jump(moves[key]);
      else return;
      event.preventDefault();
    }

    grab(event) {
      this.held = [event.clientX, event.clientY];
      this.canvas.setPointerCapture(event.pointerId);
    }

    drag({ clientX, clientY, buttons }) {
      if (this.view.value !== "free" || !buttons || !this.held) return;
      const [x, y] = this.held, pitch = this.angles[1] + (clientY - y) * 0.01;
      this.angles = [this.angles[0] - (clientX - x) * 0.01, Math.min(Math.max(pitch, -0.2), 1.5)];
      this.held = [clientX, clientY];
      this.show();
    }

    listen() {
      const on = (target, name, act) => target.addEventListener(name, (event) => act(event));
      const set = (change) => Object.assign(this, change) && this.show();
      on(this.root, "keydown", (event) => this.press(event));
      on(this.slider, "input", () => this.jump(Number(this.slider.value)));
      on(this.find("[data-play]"), "click", () => this.run(!this.playing));
      on(this.find("[data-layout]"), "change", ({ target }) => set({ layout: target.value }));
      on(this.find("[data-errors]"), "change", ({ target }) => set({ errors: target.checked }));
      on(this.view, "change", () => this.look(this.view.value));
      on(this.find("[data-choice=a]"), "change", () => this.choose());
      on(this.find("[data-choice=b]"), "change", () => this.choose());
      on(this.canvas, "pointerdown", (event) => this.grab(event));
      on(this.canvas, "pointermove", (event) => this.drag(event));
      on(this.find("[data-animate]"), "click", () => {
        this.animate(true);
        this.run(true);
        this.root.focus();
      });
      on(dark, "change", () => set({ colours: colours(this.root) }));
      on(calm, "change", () => this.animate(!calm.matches));
      on(window, "beforeprint", () => this.animate(false));
      on(window, "afterprint", () => this.animate(!calm.matches));
      this.watch();
    }

    /** Draw again when the width changes, and rest while out of sight. */
    watch() {
      new ResizeObserver(() => {
        if (this.width === this.canvas.clientWidth) return;
        this.width = this.canvas.clientWidth;
        this.show();
      }).observe(this.canvas);
      new IntersectionObserver(([{ isIntersecting }]) => {
        if (!isIntersecting && this.playing) this.run(false);
      }).observe(this.root);
    }
  }

  const start = async (root) => {
    const data = JSON.parse(document.querySelector(`script[data-player="${root.id}"]`).textContent);
    new Player(root, data, await unpack(data));
    root.dataset.ready = "";
  };

  const near = new IntersectionObserver((entries) => {
    for (const { isIntersecting, target } of entries) {
      if (!isIntersecting) continue;
      near.unobserve(target);
      start(target);
    }
  }, { rootMargin: "300px" });
  for (const root of document.querySelectorAll(".player")) {
    root.hidden = false;
    near.observe(root);
  }
})();
