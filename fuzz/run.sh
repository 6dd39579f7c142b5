#!/usr/bin/env bash
# Feeds every reader and detector with broken input: fuzz/run.sh [SECONDS OF EACH TARGET] [PROFILE]
# With a profile of cargo's, such as `checked`, what is built there already is used: inputs are changed at random. Without,
# everything is built once more so that the fuzzer sees which input reaches new code: for longer runs.
# Fails where one crashes, takes 20 s or 1.5 GB; that input is then in fuzz/artifacts.
# Needs a C++ compiler, for libFuzzer.
set -euo pipefail
cd "$(dirname "$0")"
seconds=${1:-15}
profile=${2:-}

if [ -n "$profile" ]; then
  cargo build -q --profile "$profile" --locked --features handeye/schema
  built=${CARGO_TARGET_DIR:-../target}/$profile
else
  if ! command -v cargo-fuzz >/dev/null; then
    CARGO_PROFILE_DEV_DEBUG=0 cargo install -q --debug --locked cargo-fuzz
  fi
  # Without the sanitizers, which need a nightly compiler: the program has no unsafe code of its own.
  # The seeds are built with the targets: apart from them, everything would be compiled twice.
  # Level 1 takes a fifth less to build; detection runs a third slower.
  export CARGO_PROFILE_RELEASE_OPT_LEVEL=1
  cargo fuzz build --sanitizer none --codegen-units 16 --target-dir target
  built=target/$(rustc -vV | sed -n 's/^host: //p')/release
fi

# Each run begins with the seeds alone: to read all that earlier ones kept takes long.
rm -rf corpus
"$built/seeds"
# Inputs are files; in memory where that is to be had.
HANDEYE_FUZZ_FOLDER=$(mktemp -d -p /dev/shm 2>/dev/null || mktemp -d)
export HANDEYE_FUZZ_FOLDER
log=$HANDEYE_FUZZ_FOLDER/log
trap 'rm -rf "$HANDEYE_FUZZ_FOLDER"' EXIT
# What is allocated and never touched is no resident memory, and found by this limit alone.
ulimit -v 2097152 2>/dev/null || echo "memory that is not used is not limited here"

for target in image scan camera poses touches manifest import bag detect lift; do
  mkdir -p "artifacts/$target"
  if ! "$built/$target" "corpus/$target" -artifact_prefix="artifacts/$target/" \
    -max_total_time="$seconds" -max_len=65536 -timeout=20 -rss_limit_mb=1536 \
    -verbosity=0 -print_final_stats=1 >"$log" 2>&1; then
    grep -m 1 -A 60 panicked "$log" || tail -n 40 "$log"
    echo "fuzzing found a fault in $target"
    exit 1
  fi
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  printf '%-9s %8d inputs in %d s\n' "$target" "$runs" "$seconds"
done
