#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# ./dev explains itself and its exit codes mean something. usage.sh SOURCE_DIR
set -uo pipefail
cd "$1"
failed=0

# expect CODE TEXT WORD...: `./dev WORD...` ends with CODE and prints TEXT.
expect() {
    local code=$1 text=$2 got printed
    shift 2
    printed=$(./dev "$@" 2>&1)
    got=$?
    if [ $got != "$code" ] || [[ $printed != *"$text"* ]]; then
        echo "./dev $*: exit $got instead of $code, or no \"$text\" in:"
        echo "$printed"
        failed=1
    fi
}

expect 0 "Usage: ./dev VERB"
expect 0 "Usage: ./dev VERB" --help
for verb in run test check verify bench build clean; do
    expect 0 "Usage: ./dev $verb" help $verb
    expect 0 "Usage: ./dev $verb" $verb --help
done
expect 2 'no verb "dance"' dance
expect 2 "Usage: ./dev VERB" help dance
expect 2 "Usage: ./dev build" build no-such-preset
expect 2 "Usage: ./dev clean" clean everything
expect 2 "Usage: ./dev test" test one two

# A package that is missing, no root and no sudo: the line to type, and exit 1.
bare=$(mktemp -d)
trap 'rm -rf "$bare"' EXIT
for tool in bash dirname cat env apt-get mktemp; do ln -s "$(command -v $tool)" "$bare/$tool"; done
printf '#!/bin/bash\necho 1000\n' >"$bare/id"
chmod +x "$bare/id"
printed=$(PATH=$bare ./dev run 2>&1)
got=$?
if [ $got != 1 ] || [[ $printed != *"apt-get install -y --no-install-recommends "*ninja-build* ]]; then
    echo "without packages and rights: exit $got and"
    echo "$printed"
    failed=1
fi
exit $failed
