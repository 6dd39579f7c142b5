#!/usr/bin/env bash
# Feeds every reader and detector with broken input: fuzz/run.sh [SECONDS OF EACH TARGET]
# Crashing inputs are kept in fuzz/artifacts.
set -euo pipefail
cd "$(dirname "$0")"
seconds=${1:-15}

if ! command -v cargo-fuzz >/dev/null; then cargo install -q --locked cargo-fuzz; fi
cargo run -q --release --locked --bin seeds
# without the sanitizers, which need a nightly compiler: the program has no unsafe code of its own
for target in image scan camera poses touches manifest detect lift; do
  echo "-- $target, $seconds s"
  cargo fuzz run --sanitizer none "$target" -- -max_total_time="$seconds" -max_len=65536 \
    -timeout=20 -rss_limit_mb=2048 -verbosity=0 -print_final_stats=1 2>&1 |
    { grep -E "stat::number_of_executed|SUMMARY|panicked|ERROR|error" || true; }
  [ "${PIPESTATUS[0]}" = 0 ]
done
