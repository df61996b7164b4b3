#!/usr/bin/env bash
# Fuzzes one target: fuzz.sh TARGET SECONDS [libFuzzer options]. Needs the preset fuzz built; keeps what it finds, and
# inputs that reach new code, in build/fuzz/found.
set -euo pipefail
here=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
build=$here/../../build/fuzz
target=$1 seconds=$2
found=$build/found/$target
mkdir -p -- "$found"

if [[ -d /dev/shm ]]; then
  export TMPDIR=/dev/shm  # the files that the readers read lie in memory
fi
exec "$build/Testing/fuzz/fuzz-$target" -dict="$here/dictionaries/$target.dict" -max_total_time="$seconds" \
  -max_len=4096 -timeout=10 -rss_limit_mb=2000 -print_final_stats=1 -artifact_prefix="$found-" "${@:3}" \
  "$found" "$here/corpus/$target"
