#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# TRACES("ADR6")
# One source, the same bits: builds probe.cpp and the core by several compilers, switches and processors, and
# compares the state hashes that each build prints with tests/golden/hashes.txt.
#
#   matrix.sh [--full] [--update] [--built F32 F64] [FOLDER]
#     --full    every compiler x -O0 to -O3 x SSE2 and AVX2, and aarch64 at -O0 to -O3, both precisions of each;
#               else a selection of these that has each of them once: compilers and processors in both precisions
#     --update  write the golden file from g++ -O3, then compare all with it
#     --built   the probe of each precision as it is linked with the library, run with lanes of each width: takes
#               the place of g++ -O3, or whatever has built it, which is then not built again
#     FOLDER    to build in; else a temporary one
# Exit 0: all agree. 1: some build failed or differs. A compiler or emulator that is missing is a failure.
set -uo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
golden=$root/tests/golden/hashes.txt

full= update= folder= built=()
while [ $# -gt 0 ]; do
    case $1 in
        --full) full=yes ;;
        --update) update=yes ;;
        --built) built=("${2:?}" "${3:?}"); shift 2 ;;
        -*) echo "matrix.sh: no option $1" >&2; exit 2 ;;
        *) folder=$1 ;;
    esac
    shift
done
[ -n "$folder" ] || { folder=$(mktemp -d); trap 'rm -rf "$folder"' EXIT; }
mkdir -p "$folder"

# compiler:optimisation:instructions:precision
library="g++:3:sse2"
if [ -n "$full" ]; then
    builds=$(for o in 0 1 2 3; do
        for isa in sse2 avx2; do printf '%s\n' "g++:$o:$isa:"{f32,f64} "clang++-22:$o:$isa:"{f32,f64}; done
        echo "aarch64-linux-gnu-g++:$o:neon:"{f32,f64}
    done)
elif [ "$(uname -m)" = x86_64 ]; then
    builds="aarch64-linux-gnu-g++:2:neon:f64 aarch64-linux-gnu-g++:1:neon:f32
            clang++-22:0:sse2:f64 clang++-22:3:avx2:f32 g++:1:avx2:f64"
else
    library="g++:3:native"
    builds="g++:0:native:f32 clang++-22:2:native:f64"
fi
if [ ${#built[@]} -gt 0 ]; then
    builds="built:lanes:scalar built:lanes:16 built:lanes:32 built:lanes:64 $builds"
else
    builds="$library:f32 $library:f64 $(printf '%s\n' $builds | grep -v "^$library:")"
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

# Builds and runs one line of the matrix; its hashes go to FOLDER/NAME.txt.
run_build() {
    local compiler optimisation isa precision name=${1//:/_} program
    IFS=: read -r compiler optimisation isa precision <<<"$1"
    if [ "$compiler" = built ]; then  # the third word is the width of lanes
        for program in $probes; do TAMIAS_LANES=$isa "$program" || return 1; done >"$folder/$name.txt" 2>"$folder/$name.log"
        return
    fi
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
    [ "$precision" = f32 ] || flags+=(-DTAMIAS_F64)
    program=$folder/$name
    "$compiler" "${flags[@]}" "$unity" -o "$program" 2>"$program.log" || return 1
    "${runner[@]}" "$program" >"$program.txt" || return 1
}
export -f run_build
probes=${built[*]}
export root folder unity probes

if [ -n "$update" ]; then
    first=$(printf '%s\n' $builds | if [ -n "$probes" ]; then head -n 1; else head -n 2; fi)
    for build in $first; do
        run_build "$build" || { echo "$build: FAILED"; cat "$folder"/*.log | head -n 20; exit 1; }
    done
    cat $(printf "$folder/%s.txt " ${first//:/_}) >"$golden"
fi

printf '%s\n' $builds | xargs -P "$(nproc)" -I{} bash -c 'run_build {} || rm -f "$folder/$(tr : _ <<<{}).txt"'

# The golden hashes of the precision of a build; of both, if it has both.
hashes_of() {
    case $1 in
        *:f32 | *:f64) grep "^${1##*:} " "$golden" ;;
        *) cat "$golden" ;;
    esac
}

failed=0
for build in $builds; do
    name=${build//:/_}
    if [ ! -e "$folder/$name.txt" ]; then
        echo "$build: does not build or run"
        head -n 20 "$folder/$name.log"
        failed=1
    elif ! diff -u <(hashes_of "$build") "$folder/$name.txt" >"$folder/$name.diff"; then
        echo "$build: other bits than the golden ones"
        cat "$folder/$name.diff"
        failed=1
    else
        echo "$build: same bits"
    fi
done
exit $failed
