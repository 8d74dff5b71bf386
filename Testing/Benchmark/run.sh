#!/usr/bin/env bash
# Builds and runs the benchmark, each case in a process of its own, and plots what came out.
# Usage: bash Testing/Benchmark/run.sh [case...] [-- driver's options]
# Results go to Testing/Benchmark/results (SMOKEVISIBILITY_RESULTS names another folder).
set -euo pipefail
cd "$(dirname "$0")/../.."
. .ci/setup.sh
cases=()
while [ $# -gt 0 ] && [ "$1" != "--" ]; do
  cases+=("$1")
  shift
done
if [ $# -gt 0 ]; then
  shift
fi
if [ ${#cases[@]} -eq 0 ]; then
  cases=(tunnel hall12 fire12 hall110 hall10m office growth threads steps skips thick)
fi
results=${SMOKEVISIBILITY_RESULTS:-Testing/Benchmark/results}
smokevisibility_build SmokeBenchmark
mkdir -p "$results"
{
  lscpu | grep -E '^(Model name|CPU\(s\)|Thread|L1d|L2|L3)'
  grep MemTotal /proc/meminfo
  c++ --version | head -1
  echo "Commit: $(git rev-parse --short HEAD)$(git diff --quiet HEAD -- . ':!Testing/Benchmark/results' || echo ', changed')"
  echo "Load when it began: $(cut -d' ' -f1 /proc/loadavg)"
} >"$results/machine.txt"
for case in "${cases[@]}"; do
  "$SMOKEVISIBILITY_BUILD/bin/SmokeBenchmark" --case "$case" --out "$results" "$@"
done
/usr/bin/python3 Testing/Benchmark/plot.py "$results"
