// SPDX-License-Identifier: MIT
// `node screenshot.mjs PAGE OUT.png [FRAME] [WIDTHxHEIGHT] [light|dark] [KEYS] [BODY]` takes a picture of a replay page;
// KEYS are pressed first ("tci" shows trails, contacts and impulses), BODY is selected by its name.
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch } from './browser.mjs';

const [page, out, frame = '0', size = '1280x800', colorScheme = 'light', keys = '', body = ''] = process.argv.slice(2);
if (!page || !out) {
  console.error('usage: node screenshot.mjs PAGE OUT.png [FRAME] [WIDTHxHEIGHT] [light|dark] [KEYS] [BODY]');
  process.exit(2);
}
const [width, height] = size.split('x').map(Number);
const browser = await launch();
const tab = await browser.newPage({ viewport: { width, height }, colorScheme });
await tab.goto(`${pathToFileURL(resolve(page))}#frame=${frame}`);
for (const key of keys) await tab.keyboard.press(key);
if (body) await tab.selectOption('#who', { label: body });
await tab.evaluate(() => document.activeElement?.blur());
await tab.waitForTimeout(200);
await tab.screenshot({ path: out });
await browser.close();
