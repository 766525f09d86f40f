#!/bin/sh
# Builds the deck fuzzer with clang and runs it on the corpus: build_and_run.sh SECONDS [WORK_FOLDER]
# Needs clang-14 and libclang-rt-14-dev. New inputs stay in the work folder; shrink them into the
# corpus with -merge=1 when they cover more.
set -eu
root=$(cd "$(dirname "$0")/../../../.." && pwd)
seconds=${1:?seconds to run}
work=${2:-$(mktemp -d)}
mkdir -p "$work/found"
clang++ -std=c++20 -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all \
  -include "$root"/tests/fe_node/deck/fuzz/source_location_for_clang14.h \
  -I"$root" -isystem /usr/include/eigen3 \
  "$root"/tests/fe_node/deck/fuzz/deck_fuzzer.cpp "$root"/fe_node/deck/*.cpp \
  "$root"/common/error.cpp "$root"/common/spatial.cpp -lfmt -o "$work/deck_fuzzer"
cd "$work"
exec ./deck_fuzzer -max_total_time="$seconds" -max_len=4096 -timeout=10 -rss_limit_mb=2048 \
  -dict="$root"/tests/fe_node/deck/fuzz/keywords.dict found "$root"/tests/fe_node/deck/fuzz/corpus
