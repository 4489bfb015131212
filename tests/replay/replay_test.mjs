// SPDX-License-Identifier: MIT
// The replay page in headless Chromium: a page of closed-form motions, and the page TAMIAS_REPLAY_PAGE when set.
import { after, before, describe, test } from 'node:test';
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch, painted, waitUntil } from './browser.mjs';
import { crowd, motionOf, pageOf, sample } from './sample.mjs';
import { boundsOfPatch, colorAt, colorGap, countNear, differing, parseColor, screenshot } from './pixels.mjs';

const folder = mkdtempSync(join(tmpdir(), 'tamias-replay-'));
const samplePage = join(folder, 'sample.html');
writeFileSync(samplePage, pageOf(sample()));
const pages = { 'sample page': samplePage };
if (process.env.TAMIAS_REPLAY_PAGE) pages['page of the command line'] = process.env.TAMIAS_REPLAY_PAGE;

let browser;
before(async () => { browser = await launch(); });
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
});

function dataOf(file) {
  const text = /<script id="data" type="application\/json">([\s\S]*?)<\/script>/.exec(readFileSync(file, 'utf8'))[1];
  return JSON.parse(text);
}

/// Opens a page still at a frame (or playing, with frame null), gives it to `use`, and fails on any complaint.
async function withPage(file, options, use) {
  const { frame = 0, ...rest } = options;
  const tab = await browser.newPage({ viewport: { width: 1280, height: 800 }, ...rest });
  tab.setDefaultTimeout(60000);  // a busy machine is no fault of the page
  const complaints = [], requests = [];
  tab.on('console', m => { if (m.type() === 'error' || m.type() === 'warning') complaints.push(m.text()); });
  tab.on('pageerror', e => complaints.push(String(e)));
  tab.on('request', r => { if (!r.url().startsWith('data:')) requests.push(r.url()); });
  const url = pathToFileURL(file).href + (frame === null ? '' : `#frame=${frame}`);
  await tab.goto(url);
  const api = (name, ...args) => tab.evaluate(([n, a]) => window.tamiasReplay[n](...a), [name, args]);
  try {
    await use(tab, api);
    assert.deepEqual(complaints, [], 'console errors, warnings or exceptions');
    assert.equal(requests.length, 1, `requests besides the page itself: ${requests}`);
  } finally {
    await tab.close();
  }
}

const turnBetween = (a, b) => Math.abs(Math.atan2(Math.sin(a - b), Math.cos(a - b)));
const numberIn = text => Number(text.replace('−', '-').replace(/[^\d.e+-]/g, ''));

function assertPose(pose, frame, index, what) {
  const [x, y, angle] = frame.poses.slice(3 * index, 3 * index + 3);
  assert.ok(Math.hypot(pose.x - x, pose.y - y) <= 1e-9 * (1 + Math.hypot(x, y)) && turnBetween(pose.angle, angle) < 1e-9,
    `${what}: drawn ${JSON.stringify(pose)}, recorded ${x} ${y} ${angle}`);
}

const fillColors = tab => tab.evaluate(() => [0, 1, 2, 3, 4, 5].map(
  i => getComputedStyle(document.documentElement).getPropertyValue(`--body-${i}-fill`)));

// A dynamic body whose origin lies inside its one round or convex shape, well inside the stage.
async function visibleBody(tab, api, data) {
  const box = await tab.locator('#stage').boundingBox();
  for (const [index, b] of data.bodies.entries()) {
    if (b.type !== 'dynamic' || b.shapes.length !== 1 || !['circle', 'polygon'].includes(b.shapes[0].kind)) continue;
    const s = b.shapes[0], n = s.points.length;
    const middle = [0, 1].map(k => s.points.reduce((sum, p) => sum + p[k], 0) / n);
    if (Math.hypot(...middle) > 1e-3) continue;
    const at = await api('screenOf', index);
    if (at.x > box.x + 30 && at.x < box.x + box.width - 30 && at.y > box.y + 60 && at.y < box.y + box.height - 50)
      return { index, body: b, at };
  }
  return assert.fail('no dynamic body in view');
}

for (const [name, file] of Object.entries(pages)) describe(name, () => {
  const data = dataOf(file), last = data.frames.length - 1, middle = Math.round(last / 2);

  test('plays by itself once opened, pauses, and stops at the end', () => withPage(file, { frame: null }, async (tab, api) => {
    assert.equal(await api('isPlaying'), true);
    await waitUntil(tab, () => window.tamiasReplay.frame() >= 3);
    await tab.click('#play');
    const frame = await api('frame');
    await tab.waitForTimeout(250);
    assert.equal(await api('isPlaying'), false);
    assert.equal(await api('frame'), frame, 'a paused page stays where it is');
    await api('setFrame', last - 2);
    await api('play');
    await waitUntil(tab, () => !window.tamiasReplay.isPlaying());
    assert.equal(await api('frame'), last);
    await tab.click('#play');
    assert.ok(await api('frame') < last, 'play at the end begins anew');
  }));

  test('shows the recorded pose of every body at the frame scrubbed to', () => withPage(file, {}, async (tab, api) => {
    const bar = await tab.locator('#scrub').boundingBox();
    for (const share of [0.25, 0.5, 0.9]) {
      await tab.mouse.click(bar.x + 8 + share * (bar.width - 16), bar.y + bar.height / 2);
      const frame = await api('frame');
      assert.ok(Math.abs(frame - share * last) <= 0.02 * last + 1, `scrubbed to ${share} of ${last}, came to ${frame}`);
      const poses = await tab.evaluate(n => Array.from({ length: n }, (_, i) => window.tamiasReplay.poseOf(i)), data.bodies.length);
      poses.forEach((pose, i) => assertPose(pose, data.frames[frame], i, `body ${i} at frame ${frame}`));
    }
  }));

  test('paints a body where it says it is', () => withPage(file, {}, async (tab, api) => {
    const fills = (await fillColors(tab)).map(parseColor);
    for (const frame of [0, 1, Math.min(last, 20)]) {
      await api('setFrame', frame);
      const { at, body } = await visibleBody(tab, api, data);
      const shot = await screenshot(tab);
      let painted = 0;
      // Beside the center: through the center of a disc goes its mark.
      for (const [dx, dy] of [[-3, 0], [3, 0], [0, -3], [0, 3], [2, 2], [-2, -2]])
        painted += fills.some(fill => colorGap(colorAt(shot, at.x + dx, at.y + dy), fill) < 12);
      assert.ok(painted >= 3, `${body.name} at frame ${frame}: ${painted} of 6 points around ${at.x}, ${at.y} have its color`);
    }
  }));

  test('steps with buttons and keys', () => withPage(file, { frame: middle }, async (tab, api) => {
    const expectFrame = async (frame, what) => assert.equal(await api('frame'), frame, what);
    await tab.click('#forward');
    await expectFrame(middle + 1, 'forward button');
    await tab.click('#back');
    await tab.click('#back');
    await expectFrame(middle - 1, 'back button, twice');
    await tab.keyboard.press('ArrowRight');
    await expectFrame(middle, 'right arrow');
    await tab.keyboard.press('ArrowLeft');
    await expectFrame(middle - 1, 'left arrow');
    await tab.keyboard.press('Home');
    await expectFrame(0, 'Home');
    await tab.keyboard.press('ArrowLeft');
    await expectFrame(0, 'no frame before the first');
    await tab.keyboard.press('End');
    await expectFrame(last, 'End');
    await api('setFrame', 0);
    await tab.keyboard.press(' ');
    assert.equal(await api('isPlaying'), true, 'space plays');
    await tab.keyboard.press(' ');
    assert.equal(await api('isPlaying'), false, 'space pauses');
    await tab.focus('#scrub');
    await api('setFrame', 5);
    await tab.keyboard.press('ArrowRight');
    await expectFrame(6, 'right arrow on the scrub bar goes one frame, not two');
  }));

  test('shows the numbers of a body that is clicked', () => withPage(file, { frame: Math.min(last, 10) }, async (tab, api) => {
    const { index, body, at } = await visibleBody(tab, api, data), frame = data.frames[await api('frame')];
    await tab.mouse.click(at.x, at.y);
    assert.equal(await tab.inputValue('#who'), String(index), `clicked ${body.name}`);
    await painted(tab);
    const [x, y, angle] = frame.poses.slice(3 * index), [vx, vy, w] = frame.velocities.slice(3 * index);
    const expected = { x, y, rad: angle, vx, vy, speed: Math.hypot(vx, vy), w };
    for (const [key, value] of Object.entries(expected)) {
      const shown = numberIn(await tab.textContent(`#n-${key}`));
      // Numbers keep five digits of the largest of their kind.
      const kind = 'xy'.includes(key) ? 'poses' : 'velocities';
      const largest = frame[kind].reduce((top, v) => Math.max(top, Math.abs(v)), 1);
      assert.ok(Math.abs(shown - value) <= 2e-3 * largest, `${key}: shown ${shown}, recorded ${value}`);
    }
    await tab.keyboard.press('Escape');
    assert.equal(await tab.inputValue('#who'), '-1');
  }));

  test('draws both plots, and a click in one goes to its time', () => withPage(file, { frame: 0 }, async (tab, api) => {
    const shot = await screenshot(tab);
    const lines = { energy: ['kinetic', 'potential', 'total'], momentum: ['px', 'py', 'spin'] };
    for (const [plot, names] of Object.entries(lines)) {
      const box = await tab.locator(`#${plot}`).boundingBox();
      for (const key of names) {
        const ink = parseColor(await tab.evaluate(k => getComputedStyle(document.documentElement).getPropertyValue(`--${k}`), key));
        const count = countNear(shot, box, ink, 60);
        assert.ok(count > 20, `${plot}, ${key}: ${count} pixels of its color`);
      }
      await tab.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
      const frame = await api('frame');
      assert.ok(Math.abs(frame / last - 0.5) < 0.1, `a click in the middle of ${plot} came to frame ${frame} of ${last}`);
      await api('setFrame', 0);
    }
    assert.equal(numberIn((await tab.textContent('#energy-legend b')).replace(/ .*/, '')) >= 0, true, 'kinetic energy is told');
  }));

  test('adds trails, contacts and impulses when asked', () => withPage(file, { frame: middle }, async tab => {
    const busiest = data.frames.reduce((best, f, i) => (f.contacts.length > data.frames[best].contacts.length ? i : best), middle);
    const motion = f => f.energy[0];
    const liveliest = data.frames.reduce((best, f, i) => (i > 5 && motion(f) > motion(data.frames[best]) ? i : best), 6);
    for (const [key, id] of [['t', 'trails'], ['c', 'contacts'], ['i', 'impulses']]) {
      await tab.evaluate(f => window.tamiasReplay.setFrame(f), key === 't' ? liveliest : busiest);
      const plain = await screenshot(tab);
      await tab.keyboard.press(key);
      assert.equal(await tab.getAttribute(`#${id}`, 'aria-pressed'), 'true');
      const changed = differing(plain, await screenshot(tab), { x: 0, y: 110, width: 920, height: 560 });
      if (id === 'trails' || data.frames[busiest].contacts.length) assert.ok(changed > 20, `${id}: ${changed} pixels changed`);
      await tab.click(`#${id}`);
      assert.equal(await tab.getAttribute(`#${id}`, 'aria-pressed'), 'false');
    }
  }));

  test('zooms towards the pointer, pans by dragging, and fits again', () => withPage(file, {}, async (tab, api) => {
    const { index, at } = await visibleBody(tab, api, data), box = await tab.locator('#stage').boundingBox();
    await tab.mouse.move(Math.round(at.x), Math.round(at.y));
    await tab.mouse.wheel(0, -400);
    await tab.waitForTimeout(100);
    const zoomed = await api('screenOf', index);
    assert.ok(Math.hypot(zoomed.x - at.x, zoomed.y - at.y) < 1.5, 'the body under the pointer stays under it');
    await tab.mouse.move(box.x + 40, box.y + box.height - 80);
    await tab.mouse.down();
    await tab.mouse.move(box.x + 110, box.y + box.height - 120, { steps: 5 });
    await tab.mouse.up();
    const panned = await api('screenOf', index);
    assert.ok(Math.hypot(panned.x - zoomed.x - 70, panned.y - zoomed.y + 40) < 6, `moved by ${panned.x - zoomed.x}, ${panned.y - zoomed.y}`);
    await tab.keyboard.press('f');
    const fitted = await api('screenOf', index);
    assert.ok(Math.hypot(fitted.x - at.x, fitted.y - at.y) < 1e-6, 'fit brings back the first view');
  }));

  test('fits a phone, in the dark too', () => withPage(file,
    { viewport: { width: 390, height: 844 }, colorScheme: 'dark', hasTouch: true, deviceScaleFactor: 2 }, async (tab, api) => {
      const wide = await tab.evaluate(() => document.documentElement.scrollWidth);
      assert.equal(wide, 390, 'nothing sticks out to the side');
      const shot = await screenshot(tab), box = await tab.locator('#stage').boundingBox();
      const corner = colorAt(shot, box.x + box.width - 6, box.y + 6);
      assert.ok(corner.every(v => v < 60), `the stage is dark: ${corner}`);
      const { index, at } = await visibleBody(tab, api, data);
      await tab.touchscreen.tap(at.x, at.y);
      assert.equal(await tab.inputValue('#who'), String(index), 'a tap selects');
    }));
});

describe('known motions', () => {
  test('bodies are painted where physics puts them, to a pixel', () => withPage(samplePage, {}, async (tab, api) => {
    // The painted patch of the ball against its closed form: one scale and one shift must explain every frame.
    const ball = 4, seen = [];
    for (const frame of [0, 45, 130, 260, 399, 520]) {
      await api('setFrame', frame);
      const at = await api('screenOf', ball), shot = await screenshot(tab), truth = motionOf(ball, frame / 60);
      // Seed beside the orientation mark, on the far side of the center.
      const bounds = boundsOfPatch(shot, at.x - 8 * Math.cos(truth.angle), at.y + 8 * Math.sin(truth.angle));
      seen.push({ sx: (bounds.left + bounds.right) / 2, sy: (bounds.top + bounds.bottom) / 2, wide: bounds.right - bounds.left, ...truth });
    }
    const [a, b] = [seen[0], seen[4]], scale = (b.sx - a.sx) / (b.x - a.x);
    for (const s of seen) {
      const dx = s.sx - a.sx - scale * (s.x - a.x), dy = s.sy - a.sy + scale * (s.y - a.y);
      assert.ok(Math.hypot(dx, dy) < 1.5, `ball at ${s.x}, ${s.y}: ${dx}, ${dy} pixels off`);
      assert.ok(Math.abs(s.wide - 1.2 * scale) < 4, `its width is ${s.wide}, 1.2 m are ${1.2 * scale}`);
    }
  }));

  test('a joint is drawn between its anchors until it breaks, and not when told so', () => {
    const file = join(folder, 'joints.html'), tied = [[6, 0, 0], [8, 0, 0]];  // crate to dumbbell
    writeFileSync(file, pageOf({ ...sample(), joints: [{ line: tied, dots: tied, dashed: false }], breaks: [[0, 2]] }));
    return withPage(file, {}, async (tab, api) => {
      const ink = parseColor(await tab.evaluate(() => getComputedStyle(document.documentElement).getPropertyValue('--joint')));
      const isDrawn = async frame => {
        await api('setFrame', frame);
        const a = await api('screenOf', 6), b = await api('screenOf', 8), shot = await screenshot(tab);
        const x = (a.x + b.x) / 2, y = (a.y + b.y) / 2;
        return [-1, 0, 1].some(dx => [-1, 0, 1].some(dy => colorGap(colorAt(shot, x + dx, y + dy), ink) < 60));
      };
      assert.equal(await isDrawn(0), true, 'at the start');
      await tab.keyboard.press('j');
      assert.equal(await isDrawn(0), false, 'switched off');
      await tab.click('#joints');
      assert.equal(await isDrawn(119), true, 'just before it breaks');
      assert.equal(await isDrawn(121), false, 'broken');
    });
  });

  test('a turned rod is painted turned', () => withPage(samplePage, {}, async (tab, api) => {
    const rod = 5, [fill] = (await fillColors(tab)).slice(1, 2).map(parseColor);
    for (const frame of [0, 33, 75, 140]) {
      await api('setFrame', frame);
      const at = await api('screenOf', rod), { angle } = motionOf(rod, frame / 60), shot = await screenshot(tab);
      const along = turn => colorAt(shot, at.x + 30 * Math.cos(angle + turn), at.y - 30 * Math.sin(angle + turn));
      for (const turn of [0, Math.PI]) assert.ok(colorGap(along(turn), fill) < 12, `frame ${frame}: not along ${angle + turn}`);
      for (const turn of [-1, 1]) assert.ok(colorGap(along(turn * Math.PI / 2), fill) > 40, `frame ${frame}: painted across`);
    }
  }));

  test('between frames an angle goes the short way over the full turn', () => withPage(samplePage, {}, async (tab, api) => {
    // The rod passes a full turn at t = 2.513 s, between frames 150 and 151.
    await tab.selectOption('#speed', '0.1');
    await api('setFrame', 149);
    await api('play');
    const seen = await tab.evaluate(() => new Promise(done => {
      const seen = [];
      const look = () => {
        seen.push({ t: window.tamiasReplay.time(), ...window.tamiasReplay.poseOf(5) });
        if (window.tamiasReplay.frame() < 152) requestAnimationFrame(look); else done(seen);
      };
      look();
    }));
    const between = seen.filter(s => s.t > 150 / 60 && s.t < 151 / 60);
    assert.ok(between.length > 0, `of ${seen.length} pictures none lay between frames 150 and 151`);
    for (const s of seen) assert.ok(turnBetween(s.angle, 2.5 * s.t) < 1e-6, `at ${s.t} the angle is ${s.angle}, not ${2.5 * s.t}`);
  }));

  test('the speed chosen is the speed of the clock', () => withPage(samplePage, {}, async (tab, api) => {
    const rate = async speed => {
      await tab.selectOption('#speed', speed);
      await api('setFrame', 0);
      await api('play');
      return tab.evaluate(() => new Promise(done => {
        let began = null;
        const look = now => {
          began ??= { now, t: window.tamiasReplay.time() };
          if (now - began.now < 400) requestAnimationFrame(look);
          else done((window.tamiasReplay.time() - began.t) / (now - began.now) * 1000);
        };
        requestAnimationFrame(look);
      }));
    };
    const slow = await rate('0.5'), fast = await rate('4');
    assert.ok(fast / slow > 4 && fast / slow < 16, `0.5x ran at ${slow}, 4x at ${fast} seconds a second`);
  }));

  test('three hundred bodies stay light', async () => {
    const file = join(folder, 'crowd.html');
    writeFileSync(file, pageOf(crowd(300, 400)));
    await withPage(file, { frame: 100 }, async tab => {
      for (const key of 'tci') await tab.keyboard.press(key);
      const cost = await tab.evaluate(() => {
        const costs = [];
        for (let f = 0; f < 60; f++) {
          const from = performance.now();
          window.tamiasReplay.setFrame(200 + f);
          costs.push(performance.now() - from);
        }
        return costs.sort((a, b) => a - b)[30];
      });
      // About 5 ms on one quiet core; the bound only catches a page that lost its head.
      assert.ok(cost < 60, `a picture takes ${cost} ms`);
    });
  });

  test('a template without a recording says so', async () => {
    const file = join(folder, 'empty.html');
    writeFileSync(file, pageOf(sample(2)).replace(/(<script id="data"[^>]*>)[\s\S]*?<\/script>/, '$1</script>'));
    await withPage(file, {}, async tab => assert.match(await tab.textContent('#empty'), /no recording/));
  });
});
