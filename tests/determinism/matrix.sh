#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# TRACES("ADR6")
# One source, the same bits: builds probe.cpp and the core by several compilers, switches and processors, and
# compares the state hashes that each build prints with tests/golden/hashes.txt.
#
#   matrix.sh [--full] [--update] [FOLDER]
#     --full    every compiler x -O0 to -O3 x SSE2 and AVX2, and aarch64 at -O0 to -O3; else a selection
#     --update  write the golden file from the first build, then compare all others with it
#     FOLDER    to build in; else a temporary one
# Exit 0: all agree. 1: some build failed or differs. A compiler or emulator that is missing is a failure.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
golden=$root/tests/golden/hashes.txt

full= update= folder=
for word in "$@"; do
    case $word in
        --full) full=yes ;;
        --update) update=yes ;;
        -*) echo "matrix.sh: no option $word" >&2; exit 2 ;;
        *) folder=$word ;;
    esac
done
[ -n "$folder" ] || { folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT; }
mkdir -p "$folder"

# compiler:optimisation:instructions
if [ -n "$full" ]; then
    builds=$(for o in 0 1 2 3; do
        for isa in sse2 avx2; do printf '%s\n' "g++:$o:$isa" "clang++-22:$o:$isa"; done
        echo "aarch64-linux-gnu-g++:$o:neon"
    done)
elif [ "$(uname -m)" = x86_64 ]; then
    builds="g++:0:sse2 g++:3:avx2 clang++-22:1:avx2 clang++-22:3:sse2 aarch64-linux-gnu-g++:1:neon"
else
    builds="g++:0:native g++:3:native clang++-22:2:native"
fi

# The whole core and the probe as one translation unit: quick to build at any optimisation.
unity=$folder/unity.cpp
layers=$(sed -n 's/^\([a-z]*\) *= *\[.*/\1/p' "$root/tools/layers.toml" | grep -v '^scene$')
for layer in $layers; do
    for source in "$root"/src/"$layer"/*.cpp; do
        [ -e "$source" ] && echo "#include \"$source\""
    done
done >"$unity"
echo "#include \"$root/tests/determinism/probe.cpp\"" >>"$unity"

# Builds and runs one line of the matrix, both precisions; its hashes go to FOLDER/NAME.txt.
run_build() {
    local compiler optimisation isa name=${1//:/_}
    IFS=: read -r compiler optimisation isa <<<"$1"
    local flags=(-std=c++20 -ffp-contract=off "-O$optimisation" "-I$root/include" "-I$root/src" -Wno-psabi -pthread) runner=()
    case $isa in
        sse2 | avx2) flags+=("-m$isa") ;;
        neon) flags+=(-static); runner=(qemu-aarch64) ;;
    esac
    # FMA is there to be used, if the compiler were allowed to; g++ takes no leave, see src/CMakeLists.txt.
    case $compiler:$isa in
        clang*:avx2) flags+=(-mfma) ;;
        g++*:avx2) flags+=(-mfma -mno-fma) ;;
    esac
    for precision in f32 f64; do
        local program=$folder/$name.$precision define=()
        [ $precision = f64 ] && define=(-DTAMIAS_F64)
        "$compiler" "${flags[@]}" "${define[@]}" "$unity" -o "$program" 2>"$program.log" || return 1
        "${runner[@]}" "$program" || return 1
    done >"$folder/$name.txt"
}
export -f run_build
export root folder unity

first=$(set -- $builds; echo "$1")
if [ -n "$update" ]; then
    run_build "$first" || { echo "$first: FAILED"; cat "$folder"/*.log | head -n 20; exit 1; }
    cp "$folder/${first//:/_}.txt" "$golden"
fi

printf '%s\n' $builds | xargs -P "$(nproc)" -I{} bash -c 'run_build {} || rm -f "$folder/$(tr : _ <<<{}).txt"'

failed=0
for build in $builds; do
    name=${build//:/_}
    if [ ! -e "$folder/$name.txt" ]; then
        echo "$build: does not build or run"
        head -n 20 "$folder/$name".*.log
        failed=1
    elif ! diff -u "$golden" "$folder/$name.txt" >"$folder/$name.diff"; then
        echo "$build: other bits than the golden ones"
        cat "$folder/$name.diff"
        failed=1
    else
        echo "$build: same bits"
    fi
done
exit $failed
