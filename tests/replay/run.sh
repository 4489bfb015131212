#!/bin/sh
# SPDX-License-Identifier: MIT
# Tests the replay page in headless Chromium. Installs the one npm package it needs when that is missing.
# TAMIAS_REPLAY_PAGE  a page written by `tamias2d run ... --replay`, tested too when set
# TAMIAS_CHROMIUM     the browser, /usr/bin/chromium unless set
# Exit 0: all passed; 1: a test failed; 2: something is missing.
set -u
if [ -n "${TAMIAS_REPLAY_PAGE:-}" ]; then
    TAMIAS_REPLAY_PAGE=$(realpath "$TAMIAS_REPLAY_PAGE") || exit 2
    export TAMIAS_REPLAY_PAGE
fi
cd "$(dirname "$0")" || exit 2

for tool in node npm "${TAMIAS_CHROMIUM:-/usr/bin/chromium}"; do
    if ! command -v "$tool" >/dev/null 2>&1; then
        echo "tests/replay: $tool is missing (Debian: apt-get install nodejs npm chromium)" >&2
        exit 2
    fi
done
if [ ! -d node_modules/playwright-core ]; then
    npm ci --silent || { echo "tests/replay: npm could not install playwright-core" >&2; exit 2; }
fi
node --test replay_test.mjs || exit 1
