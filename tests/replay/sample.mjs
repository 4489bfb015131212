// SPDX-License-Identifier: MIT
// A recording whose every pose is a closed form, for testing the replay page without the engine.
// `node sample.mjs OUT.html [BODIES FRAMES]` writes a page; with two numbers, a crowd of bouncing discs.
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const template = join(here, '../../apps/cli/replay/replay.html');
const TAU = 2 * Math.PI, g = 9.81;

/// The page of a recording: the template with the data in its place.
export function pageOf(recording) {
  const json = JSON.stringify(recording, (key, v) => (typeof v === 'number' ? +v.toPrecision(9) : v)).replaceAll('<', '\\u003c');
  return readFileSync(template, 'utf8').replace('/*TAMIAS_REPLAY_DATA*/', () => json);
}

// Back and forth between low and high, from `at`, after a way of `gone`.
function between(low, high, at, gone) {
  const span = high - low, phase = (at - low + gone) / span;
  const p = phase - 2 * Math.floor(phase / 2);
  return p <= 1 ? { x: low + p * span, sign: 1 } : { x: high - (p - 1) * span, sign: -1 };
}

// Thrown up from the floor again and again, losing nothing: height and speed at a time.
function bounce(peak, t, start) {
  const period = 2 * Math.sqrt(2 * peak / g), s = (t + start * period) % period;
  return { y: peak - g / 2 * (s - period / 2) ** 2, vy: -g * (s - period / 2) };
}

const box = (w, h) => [[-w / 2, -h / 2], [w / 2, -h / 2], [w / 2, h / 2], [-w / 2, h / 2]];
const regular = (n, r) => Array.from({ length: n }, (_, i) => [r * Math.cos(TAU * i / n), r * Math.sin(TAU * i / n)]);

// Each body: what is drawn, its mass and inertia, and its motion {x, y, angle, vx, vy, w} at a time.
function cast() {
  const still = (x, y, angle = 0) => () => ({ x, y, angle, vx: 0, vy: 0, w: 0 });
  return [
    { name: 'ground', type: 'static', motion: still(0, -0.5),
      shapes: [{ kind: 'polygon', points: box(24, 1), radius: 0 }] },
    { name: 'left wall', type: 'static', motion: still(-12, 4),
      shapes: [{ kind: 'segment', points: [[0, -4], [0, 4]], radius: 0 }] },
    { name: 'right wall', type: 'static', motion: still(12, 4),
      shapes: [{ kind: 'capsule', points: [[0, -3.9], [0, 3.9]], radius: 0.12 }] },
    { name: 'lift', type: 'kinematic', shapes: [{ kind: 'polygon', points: box(3, 0.3), radius: 0.06 }],
      motion: t => ({ x: 8, y: 2.2 + Math.sin(1.5 * t), angle: 0, vx: 0, vy: 1.5 * Math.cos(1.5 * t), w: 0 }) },
    { name: 'ball', type: 'dynamic', mass: 1, inertia: 0.18, floor: 0.6,
      shapes: [{ kind: 'circle', points: [[0, 0]], radius: 0.6 }],
      motion: t => {
        const b = bounce(4.4, t, 0.5), across = between(-11.4, 3.4, -9, 2.4 * t);
        return { x: across.x, y: b.y + 0.6, angle: -0.8 * t, vx: 2.4 * across.sign, vy: b.vy, w: -0.8 };
      } },
    { name: 'rod', type: 'dynamic', mass: 2, inertia: 1, shapes: [{ kind: 'capsule', points: [[-1.2, 0], [1.2, 0]], radius: 0.25 }],
      motion: t => ({ x: 4.6, y: 5.4, angle: 2.5 * t, vx: 0, vy: 0, w: 2.5 }) },
    { name: 'crate', type: 'dynamic', mass: 4, inertia: 1, resting: 0.7,
      shapes: [{ kind: 'polygon', points: box(1.2, 1.2), radius: 0.1 }], motion: still(5, 0.7) },
    { name: 'hexagon', type: 'dynamic', mass: 1.5, inertia: 0.4, shapes: [{ kind: 'polygon', points: regular(6, 0.7), radius: 0 }],
      motion: t => ({ x: -3 + 1.6 * Math.cos(1.1 * t), y: 6.8 + 0.9 * Math.sin(1.1 * t), angle: 0.6 * t,
        vx: -1.76 * Math.sin(1.1 * t), vy: 0.99 * Math.cos(1.1 * t), w: 0.6 }) },
    { name: 'dumbbell', type: 'dynamic', mass: 2, inertia: 1.3,
      shapes: [{ kind: 'capsule', points: [[-0.9, 0], [0.9, 0]], radius: 0.12 },
        { kind: 'circle', points: [[-0.9, 0]], radius: 0.38 }, { kind: 'circle', points: [[0.9, 0]], radius: 0.38 }],
      motion: t => ({ x: 9, y: 6.4, angle: 1 - 0.7 * t, vx: 0, vy: 0, w: -0.7 }) },
    { name: 'triangle', type: 'dynamic', mass: 1, inertia: 0.2, shapes: [{ kind: 'polygon', points: regular(3, 0.7), radius: 0.12 }],
      motion: t => ({ x: -10.2, y: 7, angle: 0.4 * Math.sin(t), vx: 0, vy: 0, w: 0.4 * Math.cos(t) }) },
  ];
}

function record(title, actors, count, view) {
  const dt = 1 / 60, frames = [];
  for (let i = 0; i < count; i++) {
    const t = i * dt, frame = { t, poses: [], velocities: [], contacts: [], hits: [], energy: [0, 0, 0], momentum: [0, 0, 0] };
    for (const a of actors) {
      const m = a.motion(t), turn = m.angle - TAU * Math.floor(m.angle / TAU);
      frame.poses.push(m.x, m.y, turn);
      frame.velocities.push(m.vx, m.vy, m.w);
      if (a.type !== 'dynamic') continue;
      frame.energy[0] += a.mass * (m.vx ** 2 + m.vy ** 2) / 2 + a.inertia * m.w ** 2 / 2;
      frame.energy[1] += a.mass * g * m.y;
      frame.momentum[0] += a.mass * m.vx;
      frame.momentum[1] += a.mass * m.vy;
      frame.momentum[2] += a.mass * (m.x * m.vy - m.y * m.vx) + a.inertia * m.w;
      const before = a.motion(Math.max(0, t - dt));
      if (a.floor && before.vy < 0 && m.vy > 0) frame.hits.push([m.x, m.y - a.floor, 0, 1, 2 * a.mass * m.vy]);
      for (const side of a.resting ? [-1, 1] : [])
        frame.contacts.push([m.x + side * 0.6, m.y - a.resting, 0, 1, a.mass * g * dt / 2]);
    }
    frame.energy[2] = frame.energy[0] + frame.energy[1];
    frames.push(frame);
  }
  const bodies = actors.map(({ name, type, shapes }) => ({ name, type, shapes }));
  return { title, precision: 'f64', rate: 60, substeps: 4, version: '0.1.0', bodies, view, dt, frames };
}

/// Ten bodies that show every kind of shape, each on a motion known in closed form.
export function sample(count = 600) {
  return record('A sample of every shape', cast(), count, { lower: [-12.2, -1], upper: [12.2, 8.2] });
}

/// The motion behind body `index` of the sample, at time t.
export const motionOf = (index, t) => cast()[index].motion(t);

/// Many discs that bounce in a wide room, to see whether the page stays smooth.
export function crowd(bodies = 300, count = 1500) {
  const actors = [cast()[0]];
  for (let i = 1; i < bodies; i++) {
    const r = 0.12 + 0.1 * ((i * 7) % 11) / 10, peak = 1 + 6 * ((i * 13) % 29) / 29, way = 0.4 + ((i * 5) % 17) / 8;
    actors.push({ name: `disc ${i}`, type: 'dynamic', mass: r * r, inertia: r ** 4 / 2, floor: r, resting: r,
      shapes: [{ kind: 'circle', points: [[0, 0]], radius: r }],
      motion: t => {
        const b = bounce(peak, t, (i * 0.377) % 1), across = between(-11.7, 11.7, (i * 2.3) % 23 - 11.7, way * t);
        return { x: across.x, y: b.y + r, angle: 2 * t, vx: way * across.sign, vy: b.vy, w: 2 };
      } });
  }
  return record(`${bodies} bodies`, actors, count, { lower: [-12.2, -1], upper: [12.2, 8.2] });
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [out, bodies, count] = process.argv.slice(2);
  if (!out) {
    console.error('usage: node sample.mjs OUT.html [BODIES FRAMES]');
    process.exit(2);
  }
  writeFileSync(out, pageOf(bodies ? crowd(+bodies, +count || 600) : sample()));
}
