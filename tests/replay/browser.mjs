// SPDX-License-Identifier: MIT
// Chromium, started without a window, for the tests and the screenshots.
import { chromium } from 'playwright-core';

export function launch() {
  return chromium.launch({
    executablePath: process.env.TAMIAS_CHROMIUM || '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
      '--disable-component-update', '--disable-sync'],
  });
}

// Asks the page until it answers true. Playwright's own waitForFunction may use eval, which the page forbids.
export async function waitUntil(tab, question, milliseconds = 30000) {
  for (const end = Date.now() + milliseconds; Date.now() < end;) {
    if (await tab.evaluate(question)) return;
    await new Promise((resolve) => { setTimeout(resolve, 20); });
  }
  throw new Error(`still false after ${milliseconds} ms: ${question}`);
}

// Waits for what was asked last to be drawn and shown: one animation frame draws it, the next shows it.
export function painted(tab) {
  return tab.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
}
