#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# TRACES("ADR2")
# Uses the library as a stranger would: consume.sh WAY SOURCE_DIR BUILD_DIR WORK_DIR
#   install        installs into WORK_DIR/prefix, then moves the tree: nothing may remember the first place
#   find_package   CMake finds it there
#   pkg_config     no build system at all
#   fetch_content  built from source inside another project, as a shared library
# Each builds the README's first program, as it stands there, and compares what it prints with the README.
set -euo pipefail
way=$1 source=$2 build=$3 work=$4
prefix=$work/moved

same() {
    diff -u "$1" <("$2") || { echo "$2 does not print what $1 says" >&2; exit 1; }
}

mkdir -p "$work/readme"
python3 "$source/tools/doc_snippets.py" --extract "$source/README.md" "$work/readme"
[ -s "$work/readme/expected.txt" ] || { echo "README.md says of no program what it prints" >&2; exit 1; }

case $way in
    install)
        rm -rf "$work/prefix" "$prefix"
        cmake --install "$build" --prefix "$work/prefix" >/dev/null
        mv "$work/prefix" "$prefix"
        ;;
    find_package | fetch_content)
        rm -rf "$work/$way"
        cmake -S "$source/tests/packaging/$way" -B "$work/$way" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
            -DPROGRAM="$work/readme/program.cpp" -DTAMIAS_SOURCE="$source" -DCMAKE_BUILD_TYPE=Release \
            -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=48
        cmake --build "$work/$way" --target first
        same "$work/readme/expected.txt" "$work/$way/first"
        if [ $way = find_package ]; then
            cmake --build "$work/$way"
            "$work/$way/both"
            "$work/$way/scene"
        fi
        ;;
    pkg_config)
        export PKG_CONFIG_PATH
        PKG_CONFIG_PATH=$(find "$prefix" -name pkgconfig -type d)
        for name in tamias2d tamias2d_f64; do
            c++ -std=c++20 -O2 $(pkg-config --cflags $name) "$work/readme/program.cpp" -o "$work/$name" \
                $(pkg-config --libs $name)
        done
        same "$work/readme/expected.txt" "$work/tamias2d"
        "$work/tamias2d_f64" >/dev/null
        ;;
    *)
        echo "consume.sh: no way named $way" >&2
        exit 2
        ;;
esac
