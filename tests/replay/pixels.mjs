// SPDX-License-Identifier: MIT
// What the browser really painted: screenshots as pixels, and questions about them. Coordinates are CSS pixels.
import { painted } from './browser.mjs';

/// The picture of a page as {width, height, ratio, rgba}. The browser itself decodes the PNG, in a page of its own.
export async function screenshot(tab) {
  await painted(tab);
  const png = (await tab.screenshot({ animations: 'disabled' })).toString('base64');
  const ratio = await tab.evaluate(() => window.devicePixelRatio);
  const browser = tab.context().browser();
  if (!decoders.has(browser)) decoders.set(browser, browser.newPage());
  const { width, height, text } = await (await decoders.get(browser)).evaluate(async data => {
    const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height), c = canvas.getContext('2d');
    c.drawImage(bitmap, 0, 0);
    const bytes = c.getImageData(0, 0, bitmap.width, bitmap.height).data, parts = [];
    for (let i = 0; i < bytes.length; i += 32768) parts.push(String.fromCharCode(...bytes.subarray(i, i + 32768)));
    return { width: bitmap.width, height: bitmap.height, text: btoa(parts.join('')) };
  }, png);
  return { width, height, ratio, rgba: Buffer.from(text, 'base64') };
}
const decoders = new WeakMap();

export function parseColor(text) {
  const hex = text.trim().slice(1);
  return [0, 2, 4].map(i => parseInt(hex.length === 3 ? hex[i / 2].repeat(2) : hex.slice(i, i + 2), 16));
}

function rgbAt(shot, x, y) {
  const i = 4 * (y * shot.width + x);
  return [shot.rgba[i], shot.rgba[i + 1], shot.rgba[i + 2]];
}

export const colorAt = (shot, x, y) => rgbAt(shot, Math.floor(x * shot.ratio), Math.floor(y * shot.ratio));

/// The largest difference in any of the three channels.
export const colorGap = (a, b) => Math.max(...a.map((v, i) => Math.abs(v - b[i])));

/// How many pixels of a box have a color within `slack` of one.
export function countNear(shot, box, color, slack) {
  let count = 0;
  eachPixel(shot, box, (x, y) => { count += colorGap(rgbAt(shot, x, y), color) < slack; });
  return count;
}

/// How many pixels of a box differ clearly between two pictures.
export function differing(a, b, box) {
  let count = 0;
  eachPixel(a, box, (x, y) => { count += colorGap(rgbAt(a, x, y), rgbAt(b, x, y)) > 24; });
  return count;
}

function eachPixel(shot, box, look) {
  const [left, top, right, bottom] = [box.x, box.y, box.x + box.width, box.y + box.height].map(v => Math.round(v * shot.ratio));
  for (let y = top; y < Math.min(bottom, shot.height); y++) for (let x = left; x < Math.min(right, shot.width); x++) look(x, y);
}

/// The box around the patch of one color that holds the point (x, y), found by flooding from there.
export function boundsOfPatch(shot, x, y) {
  const start = [Math.floor(x * shot.ratio), Math.floor(y * shot.ratio)], color = rgbAt(shot, ...start);
  const seen = new Uint8Array(shot.width * shot.height), open = [start];
  const box = { left: start[0], right: start[0] + 1, top: start[1], bottom: start[1] + 1 };
  while (open.length) {
    const [px, py] = open.pop();
    if (px < 0 || py < 0 || px >= shot.width || py >= shot.height || seen[py * shot.width + px]) continue;
    seen[py * shot.width + px] = 1;
    if (colorGap(rgbAt(shot, px, py), color) > 16) continue;
    box.left = Math.min(box.left, px);
    box.right = Math.max(box.right, px + 1);
    box.top = Math.min(box.top, py);
    box.bottom = Math.max(box.bottom, py + 1);
    open.push([px + 1, py], [px - 1, py], [px, py + 1], [px, py - 1]);
  }
  for (const side of Object.keys(box)) box[side] /= shot.ratio;
  return box;
}
