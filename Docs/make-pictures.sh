#!/usr/bin/env bash
# Makes the pictures of the README anew: make-pictures.sh SINEW [FROGTISSUE.mhd]
# Needs python3-vtk9, xvfb and xauth. The frog is Data/froggy/frogtissue.mhd of VTK's data; without it its picture stays.
set -euo pipefail
docs=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd)
sinew=${1:?the program sinew}
frog=${2:-}
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

"$sinew" phantom upper-arm --output "$work/upper-arm.seg.nrrd"
"$sinew" mesh "$work/upper-arm.seg.nrrd" --output "$work/upper-arm" --edge-length 2 --curvature 0 --size skin=0.8 \
  --size "biceps tendons=1" --size "triceps tendons=1"
"$sinew" phantom torus --output "$work/torus.seg.nrrd"
"$sinew" mesh "$work/torus.seg.nrrd" --output "$work/torus" --edge-length 1 --curvature 0
"$sinew" fibres "$work/upper-arm/biceps.vtu" --output "$work/muscle/fibres.vtu" --tendon 0.1
"$sinew" simulate "$work/muscle/fibres.vtu" --contract --output "$work/contraction"
cp "$work/upper-arm/humerus.vtu" "$work/muscle/humerus.vtu"
cp "$work/contraction/contract-020.vtu" "$work/muscle/contracted.vtu"
for method in optimization springs fem hybrid; do
  "$sinew" mesh "$work/upper-arm.seg.nrrd" --output "$work/methods/$method" --tissue biceps --edge-length 2 --curvature 0 \
    --method "$method"
done
"$sinew" simulate "$work"/methods/*/biceps.vtu --compare --contract --tendon 0.1 --no-series --output "$work/compared"
cp "$work/compared/contract.svg" "$docs/contract.svg"
for phantom in drilled-femur gapped-muscle torn-vessel speckled-liver overlapping-muscles; do
  "$sinew" phantom "$phantom" --output "$work/$phantom.seg.nrrd"
  "$sinew" repair "$work/$phantom.seg.nrrd" "$docs/../Data/$phantom.lua" --output "$work/$phantom-repaired.seg.nrrd"
  "$sinew" mesh "$work/$phantom.seg.nrrd" --output "$work/repair/$phantom-before" --edge-length 1.5 --curvature 0
  "$sinew" mesh "$work/$phantom-repaired.seg.nrrd" --output "$work/repair/$phantom-after" --edge-length 1.5 --curvature 0
done
if [[ $frog ]]; then
  tissues=()
  for label in {1..15}; do tissues+=(--tissue "$label"); done
  "$sinew" mesh "$frog" --lut "$docs/frog.ctbl" "${tissues[@]}" --output "$work/frog" --edge-length 5 --curvature 0 \
    --size skeleton=3.5 --size blood=3 --size nerve=3
fi
xvfb-run --auto-servernum --server-args "-screen 0 1280x1024x24" /usr/bin/python3 "$docs/pictures.py" "$work"
