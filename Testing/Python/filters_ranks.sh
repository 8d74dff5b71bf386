#!/usr/bin/env bash
# Runs filters_ranks.py with 1, 2 and 3 processes and against a server of 2, and compares what they get.
# Usage: filters_ranks.sh MPIEXEC PVBATCH PLUGIN DATA_FOLDER WORK_FOLDER
set -euo pipefail
mpiexec=$1 pvbatch=$2 plugin=$3 data=$4 work=$5
script=$(dirname "$0")/filters_ranks.py
. "$(dirname "$0")/processes.sh"
for processes in 1 2 3; do
  timeout 150 "$mpiexec" "${options[@]}" -np "$processes" "$pvbatch" --symmetric \
    --force-offscreen-rendering "$script" "$plugin" "$data" "$work/ranks$processes.txt"
  cmp "$work/ranks1.txt" "$work/ranks$processes.txt"
done

port=$((20000 + $$ % 20000))
start_server "$port" "$work/server.txt"
timeout 150 "$programs/pvpython" --force-offscreen-rendering "$script" "$plugin" "$data" \
  "$work/server_arrays.txt" "$port"
wait "$server" || true
cmp <(grep -v '^light\|^time\|^after' "$work/ranks1.txt") "$work/server_arrays.txt"
echo "The same bits with 1, 2 and 3 processes and from a server of 2."
