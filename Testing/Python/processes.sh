# For scripts that run ParaView in several processes; to be sourced. Needs mpiexec and pvbatch, which the caller was given.
programs=$(dirname "$pvbatch")
options=(--oversubscribe)
if [ "$(id -u)" -eq 0 ]; then
  options+=(--allow-run-as-root)
fi

# Starts a server of two processes and waits until it listens: start_server PORT LOG.
start_server() {
  timeout 200 "$mpiexec" "${options[@]}" -np 2 "$programs/pvserver" --force-offscreen-rendering \
    --server-port="$1" >"$2" 2>&1 &
  server=$!
  for _ in $(seq 100); do
    grep -q "Accepting connection" "$2" && break
    sleep 0.2
  done
}
