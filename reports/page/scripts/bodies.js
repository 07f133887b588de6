"use strict";

// Bodies that move: how the positions of their joints are decoded and how they are drawn.
// `reports/motions/encoding.py` says how positions are kept. The x axis points ahead, y up and z
// to the right of the body, in centimetres. Motions are numbered, the truths first.
const bodies = (() => {
  const N_STILLS = 8;
  const [GRID, REACH, HEAD] = [50, 150, 17]; // centimetres

  // ---- positions

  const unpack = async (data) => {
    const packed = Uint8Array.from(atob(data.positions), (letter) => letter.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    const n = bytes.length / 2;
    const steps = new Int16Array(n); // sums wrap around, as they did when differences were taken
    for (let i = 0; i < n; i++) {
      const code = bytes[i] | (bytes[n + i] << 8);
      steps[i] = (code >>> 1) ^ -(code & 1);
    }
    const row = data.frames, motion = data.parents.length * 3 * row;
    for (let i = 0; i < n; i++) if (i % row) steps[i] += steps[i - 1];
    for (let i = 0; i < n; i++) {
      const joint = Math.floor((i % motion) / (3 * row)), parent = data.parents[joint];
      if (parent >= 0) steps[i] += steps[i - (joint - parent) * 3 * row];
    }
    data.motions.forEach(([, against], k) => {
      const start = (data.truths.length + k) * motion;
      for (let i = 0; i < motion; i++) steps[start + i] += steps[against * motion + i];
    });
    return steps;
  };

  /** Return a function (motion, frame) → [[x, y, z], …] of all joints. */
  const reader = (data, steps) => (motion, frame) =>
    data.parents.map((_, joint) =>
      [0, 1, 2].map((axis) => {
        const row = (motion * data.parents.length + joint) * 3 + axis;
        return steps[row * data.frames + frame] * data.resolution;
      }));

  const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  const mean = (values) => values.reduce((sum, value) => sum + value, 0) / values.length;

  /** Return the width of each bone: the more hangs on it, the thicker a limb is. */
  const limbs = (data, joints) => {
    const lengths = data.parents.map((p, j) => (p < 0 ? 0 : distance(joints[j], joints[p])));
    const carried = [...lengths], leaf = data.parents.map(() => true);
    for (let j = data.parents.length - 1; j > 0; j--) {
      if (data.parents[j] < 0) continue;
      carried[data.parents[j]] += carried[j];
      leaf[data.parents[j]] = false;
    }
    const widths = carried.map((sum) => Math.min(1.5 + Math.sqrt(sum), 14));
    const head = leaf.findIndex((end, j) => end && !data.sides[j] && data.parents[j] >= 0);
    return { widths, head };
  };

  /** Return the mean error over joints at each frame, and what 5 % of all errors surpass. */
  const errors = (player, motion) => {
    const all = player.hidden.map((_, frame) => {
      const truth = player.at(player.against(motion), frame);
      return player.at(motion, frame).map((joint, j) => distance(joint, truth[j]));
    });
    const sorted = all.flat().sort((one, other) => one - other);
    return { means: all.map(mean), most: sorted[Math.floor(0.95 * sorted.length)] };
  };

  const extent = (player) => {
    let [height, reach] = [1, 1];
    for (let truth = 0; truth < player.data.truths.length; truth++) {
      for (let frame = 0; frame < player.data.frames; frame++) {
        const joints = player.at(truth, frame);
        height = Math.max(height, ...joints.map((joint) => joint[1]));
        const [x, , z] = joints[0];
        reach = Math.max(reach, ...joints.map((joint) => Math.hypot(joint[0] - x, joint[2] - z)));
      }
    }
    return { height, reach: reach + 10 };
  };

  // ---- drawing

  /** Return a function [x, y, z] → [right, up, towards the viewer], in centimetres. */
  const camera = ([yaw, pitch], [cx, cz]) => {
    const [c, s, cp, sp] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
    return ([x, y, z]) => {
      const near = -(x - cx) * s + (z - cz) * c;
      return [(x - cx) * c + (z - cz) * s, y * cp - near * sp, near * cp + y * sp];
    };
  };

  const mixed = (one, share, other) =>
    `color-mix(in oklab, ${one} ${Math.round(share * 100)}%, ${other})`;

  const line = (context, from, to, width, style) => {
    context.lineWidth = width;
    context.strokeStyle = style;
    context.beginPath();
    context.moveTo(from[0], from[1]);
    context.lineTo(to[0], to[1]);
    context.stroke();
  };

  /** Draw a body; `paint(joint)` colours the bone that ends there, and `thin` makes sticks. */
  const body = (context, place, joints, player, paint, thin) => {
    const seen = joints.map((joint) => place(joint)), scale = thin ? 0 : place.scale;
    const { widths, head } = player.limbs;
    const bones = player.data.parents.map((parent, joint) => {
      const start = parent < 0 ? seen[joint] : seen[parent];
      return { joint, start, end: seen[joint], depth: start[2] + seen[joint][2] };
    }).sort((one, other) => one.depth - other.depth);
    context.lineCap = "round";
    for (const { joint, start, end } of bones) {
      const width = Math.max((joint === head ? HEAD : widths[joint]) * scale, 2);
      const from = joint === head && !thin ? end : start;
      line(context, from, end, width + 1.6, player.colours.paper);
      line(context, from, end, width, paint(joint));
    }
  };

  const ground = (context, place, [cx, cz], colours) => {
    const first = (centre) => Math.ceil((centre - REACH) / GRID) * GRID;
    for (let x = first(cx); x <= cx + REACH; x += GRID) {
      line(context, place([x, 0, cz - REACH]), place([x, 0, cz + REACH]), 1, colours.rule);
    }
    for (let z = first(cz); z <= cz + REACH; z += GRID) {
      line(context, place([cx - REACH, 0, z]), place([cx + REACH, 0, z]), 1, colours.rule);
    }
  };

  /** Return a function from centimetres to pixels within a box, whose body stands at `centre`. */
  const placer = (player, box, centre) => {
    const turn = camera(player.angles, centre), { height, reach } = player.extent;
    const scale = Math.min((box.h * 0.8) / height, (box.w * 0.94) / (2 * reach));
    const place = (point) => {
      const [right, up, near] = turn(point);
      return [box.x + box.w / 2 + right * scale, box.y + box.h * 0.9 - up * scale, near];
    };
    place.scale = scale;
    return place;
  };

  /** Return the colour of a motion: ink for a truth, a hue for each of the two models. */
  const own = ({ data, chosen, colours }, motion) => {
    if (motion < data.truths.length) return colours.ink;
    return motion === chosen.a ? colours.a : colours.b;
  };

  /** Return how to colour the bones of a motion at a frame. */
  const painter = (player, motion, frame) => {
    const { data, colours, at } = player, n = data.truths.length;
    if (motion < n || !player.errors) {
      const right = own(player, motion), left = mixed(right, 0.55, colours.paper);
      return (joint) => (data.sides[joint] === "l" ? left : right);
    }
    const [truth, made] = [at(player.against(motion), frame), at(motion, frame)];
    const share = (joint) => Math.min(distance(truth[joint], made[joint]) / player.most, 1);
    return (joint) => mixed(colours.bad, share(joint), colours.good);
  };

  /** Draw some motions in one box that is centred on the truth, which is thin over others. */
  const draw = (context, box, motions, frame, player) => {
    const { colours } = player, root = player.at(player.against(motions[0]), frame)[0];
    const centre = [root[0], root[2]], place = placer(player, box, centre);
    context.save();
    context.beginPath();
    context.rect(box.x, box.y, box.w, box.h);
    context.clip();
    context.fillStyle = player.hidden[frame] ? colours.shade : colours.paper;
    context.fillRect(box.x, box.y, box.w, box.h);
    ground(context, place, centre, colours);
    for (const motion of motions) {
      const thin = motions.length > 1 && motion < player.data.truths.length;
      body(context, place, player.at(motion, frame), player, painter(player, motion, frame), thin);
    }
    context.restore();
  };

  const labels = (context, player, motions, left, top) => {
    motions.forEach((motion, k) => {
      context.font = "600 13px system-ui, sans-serif";
      context.fillStyle = own(player, motion);
      context.fillText(player.name(motion), left + 6, top + 15 + 17 * k);
    });
  };

  /** Return the motions of each panel: truths and models apart, or one over the other. */
  const panels = (player) => {
    const { a, b } = player.chosen, [one, other] = [player.against(a), player.against(b)];
    const all = [one, a, other, b].filter((motion, k, list) => list.indexOf(motion) === k);
    if (player.layout === "beside") return all.map((motion) => [motion]);
    return one === other ? [[...all.slice(1).reverse(), one]] : [[a, one], [b, other]];
  };

  const fit = (canvas, height) => {
    const ratio = devicePixelRatio || 1, context = canvas.getContext("2d");
    canvas.style.height = `${height}px`;
    canvas.width = Math.round(canvas.clientWidth * ratio);
    canvas.height = Math.round(height * ratio);
    context.scale(ratio, ratio);
    return context;
  };

  const paint = (player) => {
    const shown = panels(player), n = player.still ? N_STILLS : shown.length;
    const w = player.canvas.clientWidth / n;
    const h = player.still ? Math.max(w * 1.7, 100) : Math.min(Math.max(w * 1.1, 240), 400);
    const context = fit(player.canvas, player.still ? h * shown.length : h);
    shown.forEach((motions, k) => {
      if (!player.still) draw(context, { x: k * w, y: 0, w, h }, motions, player.frame, player);
      for (let still = 0; player.still && still < N_STILLS; still++) {
        const frame = Math.round((still * (player.data.frames - 1)) / (N_STILLS - 1));
        draw(context, { x: still * w, y: k * h, w, h }, motions, frame, player);
      }
      labels(context, player, motions, player.still ? 0 : k * w, player.still ? k * h : 0);
    });
  };

  const colours = (root) => {
    const styles = getComputedStyle(root);
    const get = (name) => styles.getPropertyValue(`--${name}`).trim();
    const [paper, ink, rule, a, b] = ["paper", "ink", "rule", "model-a", "model-b"].map(get);
    const [good, bad, shade] = [get("series-2"), get("bad"), mixed(get("series-4"), 0.1, paper)];
    return { paper, ink, rule, a, b, good, bad, shade };
  };

  return { colours, errors, extent, limbs, paint, reader, unpack };
})();
