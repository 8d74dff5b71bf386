#!/usr/bin/env bash
# Usage: run.sh BUILD_FOLDER SECONDS JOBS NAME...
# Runs the fuzzers Fuzz<NAME> for some seconds each, a number of them at a time, on the committed corpora and
# on what was found before (BUILD_FOLDER/found). Fails when one of them finds something: a crash, a hang of
# more than a second, or memory beyond a quarter of a gigabyte. The input then lies in BUILD_FOLDER/crash.
set -euo pipefail
corpus="$(cd "$(dirname "$0")" && pwd)/Corpus"
cd "$1"
seconds=$2
jobs=$3
shift 3

limits=(-timeout=1 -max_len=4096 -rss_limit_mb=1024 -malloc_limit_mb=256)

fuzz()
{
  local name=$1 end=$((SECONDS + seconds)) runs=0 input
  mkdir -p "found/$name" "crash/$name"
  rm -f "crash/$name"/*
  while ((SECONDS < end)); do
    local status=0
    "./Fuzz$name" "${limits[@]}" -max_total_time=$((end - SECONDS)) -print_final_stats=1 -verbosity=0 \
      "-artifact_prefix=crash/$name/" "found/$name" "$corpus/$name" >"$name.log" 2>&1 || status=$?
    runs=$((runs + $(sed -n 's/^stat::number_of_executed_units: *//p' "$name.log" | tail -1)))
    ((status != 0)) || break
    # A process that a busy machine let wait did not hang: an input is too slow when it takes the
    # processor for more than a second, and another is for the program's own beginning.
    input=$(find "crash/$name" -name 'timeout-*' -print -quit)
    if [[ -z $input ]] ||
      ! (ulimit -t 2 && "./Fuzz$name" "${limits[@]}" -timeout=600 "$input") >/dev/null 2>&1; then
      tail -n 40 "$name.log"
      echo "Fuzz$name: $runs executions, and a find in $PWD/crash/$name"
      return 1
    fi
    rm "$input"
  done
  echo "Fuzz$name: $runs executions, nothing found"
}

failed=0
running=0
for name in "$@"; do
  if ((running == jobs)); then
    wait -n || failed=1
    running=$((running - 1))
  fi
  fuzz "$name" &
  running=$((running + 1))
done
while ((running > 0)); do
  wait -n || failed=1
  running=$((running - 1))
done
exit $failed
