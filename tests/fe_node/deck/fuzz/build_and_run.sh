#!/bin/sh
# Builds the deck fuzzer with clang and runs it on the corpus: build_and_run.sh SECONDS [WORK_FOLDER]
# Needs clang-14 and libclang-rt-14-dev. Objects and new inputs stay in the work folder; shrink the
# inputs into the corpus with ./deck_fuzzer -merge=1 CORPUS found when they cover more.
set -eu
root=$(cd "$(dirname "$0")/../../../.." && pwd)
seconds=${1:?seconds to run}
work=${2:-$(mktemp -d)}
newest_header=$(find "$root/fe_node" "$root/common" -name '*.h' -printf '%T@ %p\n' | sort -n | tail -1 | cut -d' ' -f2-)
mkdir -p "$work/found" "$work/objects"
cd "$work"
flags="-std=c++20 -O1 -g1 -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all
  -include $root/tests/fe_node/deck/fuzz/source_location_for_clang14.h
  -I$root -isystem /usr/include/eigen3"
compile() {
  object=objects/$(echo "${1#"$root"/}" | tr / _).o
  # shellcheck disable=SC2086
  [ "$object" -nt "$1" ] && [ "$object" -nt "$newest_header" ] ||
    ${CXX:-clang++} $flags -c "$1" -o "$object"
}
running=0
for source in "$root"/tests/fe_node/deck/fuzz/deck_fuzzer.cpp "$root"/fe_node/deck/*.cpp \
  "$root"/fe_node/model_builder/*.cpp "$root"/fe_node/mesh/*.cpp "$root"/fe_node/material/*.cpp \
  "$root"/fe_node/element/*.cpp "$root"/fe_node/contact/*.cpp "$root"/fe_node/constraint/*.cpp \
  "$root"/fe_node/model.cpp "$root"/fe_node/state.cpp "$root"/fe_node/scratch.cpp "$root"/fe_node/solver.cpp \
  "$root"/fe_node/element_forces.cpp "$root"/fe_node/force_tiles.cpp "$root"/fe_node/stable_step.cpp \
  "$root"/fe_node/guided_body.cpp "$root"/fe_node/sleeper.cpp "$root"/fe_node/energy.cpp \
  "$root"/common/error.cpp "$root"/common/spatial.cpp "$root"/common/curve.cpp "$root"/common/rigid_fit.cpp; do
  compile "$source" &
  running=$((running + 1))
  [ $((running % ${JOBS:-2})) -ne 0 ] || wait
done
wait
${CXX:-clang++} -fsanitize=fuzzer,address,undefined objects/*.o -lfmt -o deck_fuzzer
exec ./deck_fuzzer -max_total_time="$seconds" -max_len=4096 -timeout=60 -rss_limit_mb=2048 \
  -dict="$root"/tests/fe_node/deck/fuzz/keywords.dict found "$root"/tests/fe_node/deck/fuzz/corpus
