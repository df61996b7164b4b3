#!/usr/bin/env bash
# Installs what Sinew is built from, as Debian 12 packages; with --testing also the programs that its tests show files
# to. Asks for nothing, and does nothing when all is there.
set -euo pipefail

packages=(
  g++ cmake ninja-build
  libinsighttoolkit5-dev libvtk9-dev libopenvdb-dev libboost-dev libeigen3-dev libtbb-dev zlib1g-dev libisal-dev
  libcli11-dev nlohmann-json3-dev libqhull-dev liblua5.4-dev
  libdcmtk-dev  # DICOM segmentations
  libgtest-dev libbenchmark-dev
)
# Others' readers of what Sinew writes, run by Testing/exchange.
testing=(
  python3-meshio   # the common converter of mesh files
  python3-vtk9     # the library below 3D Slicer and ParaView
  python3-nibabel  # NIfTI
  gmsh             # .msh
  calculix-ccx     # .inp: it solves
  locales          # makes the language with a decimal comma that files must not depend on
)
case "${1-}" in
  "") ;;
  --testing) packages+=("${testing[@]}") ;;
  *) echo "usage: install-dependencies.sh [--testing]" >&2; exit 2 ;;
esac

if ! command -v apt-get >/dev/null; then
  echo "install-dependencies: there is no apt-get here. Install what these Debian 12 packages hold: ${packages[*]}" >&2
  exit 1
fi

installed=$(dpkg-query --show --showformat='${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null || true)
missing=()
for package in "${packages[@]}"; do
  grep --quiet --line-regexp --fixed-strings "installed $package" <<<"$installed" || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  echo "All ${#packages[@]} packages are installed."
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  if ! command -v sudo >/dev/null; then
    echo "install-dependencies: run this as root, or install sudo. Missing: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
  [[ -t 0 ]] || as_root+=(--non-interactive)
fi

apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get --quiet --yes --option Acquire::Retries=3 \
    --option DPkg::Lock::Timeout=600 --option Dpkg::Use-Pty=0 "$@" </dev/null
}

echo "Installing ${missing[*]}"
apt update
apt install --no-install-recommends "${missing[@]}"
