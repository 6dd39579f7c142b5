#!/usr/bin/env bash
# Feeds every reader and detector with broken input: fuzz/run.sh [SECONDS OF EACH TARGET] [FOLDER]
# With the folder of the programs `seeds` and `shake`, good input is changed at random.
# Without, libFuzzer sees which input reaches new code: for longer runs. It needs a C++ compiler and a build of its own.
# Fails where one crashes, takes 20 s or 1.5 GB (2 GB without libFuzzer); that input is then in fuzz/artifacts.
set -euo pipefail
cd "$(dirname "$0")"
seconds=${1:-15}
built=${2:-}
guided=$([ -n "$built" ] || echo yes)

if [ -n "$guided" ]; then
  if ! command -v cargo-fuzz >/dev/null; then
    CARGO_PROFILE_DEV_DEBUG=0 cargo install -q --debug --locked cargo-fuzz
  fi
  # Without the sanitizers, which need a nightly compiler: the program has no unsafe code of its own.
  # Level 1 takes a fifth less to build; detection runs a third slower.
  export CARGO_PROFILE_RELEASE_OPT_LEVEL=1
  cargo fuzz build --sanitizer none --codegen-units 16 --target-dir target --features guided
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

# runs one target; its output is in the log
run() {
  if [ -z "$guided" ]; then
    "$built/shake" "$1" "$seconds" >"$log" 2>&1
  else
    "$built/$1" "corpus/$1" -artifact_prefix="artifacts/$1/" -max_total_time="$seconds" -max_len=65536 -timeout=20 \
      -rss_limit_mb=1536 -verbosity=0 -print_final_stats=1 >"$log" 2>&1
  fi
}

for target in image scan camera poses touches manifest import bag detect lift; do
  mkdir -p "artifacts/$target"
  if ! run "$target"; then
    # where memory runs out, the program cannot keep its input itself
    if [ -f "$HANDEYE_FUZZ_FOLDER/current" ]; then cp "$HANDEYE_FUZZ_FOLDER/current" "artifacts/$target/current"; fi
    grep -m 1 -A 60 panicked "$log" || tail -n 40 "$log"
    echo "fuzzing found a fault in $target"
    exit 1
  fi
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  printf '%-9s %8d inputs in %d s\n' "$target" "$runs" "$seconds"
done
