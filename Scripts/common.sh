# shellcheck shell=bash
# Sourced by the scripts: the repository's folder, how many compilers fit, how they build, and ccache where there is one.
repository=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '\n==> %s\n' "$*"; }

# Several files per compiler run: nobody waits for a single one here, and all together take half the time.
# shellcheck disable=SC2034
at_once=(-D CMAKE_UNITY_BUILD=ON -D CMAKE_UNITY_BUILD_BATCH_SIZE=8)

# One compiler per processor, but none without 1.8 GB of memory: what instantiates OpenVDB's grids takes 1.7 GB.
compilers() {
  local processors memory
  processors=$(nproc)
  memory=$(awk '/^MemAvailable:/ { print int($2 / 1800000) }' /proc/meminfo)
  echo $((memory < 1 ? 1 : memory < processors ? memory : processors))
}

if command -v ccache >/dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
