#!/usr/bin/env bash
# Builds the program, makes a phantom of an upper arm, and meshes its tissues: demo.sh [FOLDER, default ./sinew-demo]
set -euo pipefail
source "$(dirname -- "${BASH_SOURCE[0]}")/common.sh"

folder=${1:-sinew-demo}
mkdir -p -- "$folder"
folder=$(cd -- "$folder" && pwd)
sinew=$repository/build/release/Applications/sinew/sinew
phantom=$folder/upper-arm.seg.nrrd

say "Packages"
"$repository"/Scripts/install-dependencies.sh

say "Program"
cd -- "$repository"
cmake --preset release "${at_once[@]}" -D SINEW_BUILD_TESTING=OFF
cmake --build --preset release --parallel "$(compilers)" --target sinew

say "Phantom"
"$sinew" phantom upper-arm --output "$phantom" --force
"$sinew" info "$phantom"

say "Meshes"
"$sinew" mesh "$phantom" --output "$folder" --force

cat <<END

Done. In $folder:

  upper-arm.seg.nrrd   the phantom: open it in 3D Slicer as a segmentation
$(cd -- "$folder" && for mesh in *.vtu; do printf '  %-20s tetrahedral mesh, %s\n' "$mesh" "$(du -h -- "$mesh" | cut -f1)"; done)
  scene.mrml           all of them, with names and colours: drop it onto 3D Slicer
  report.json          quality, topology and fidelity of every mesh

To look at the meshes: paraview $folder/*.vtu
  Apply; Representation: Surface With Edges; Coloring: labels; Filters > Clip, with "Crinkle clip" on, shows the inside.
To mesh a segmentation of your own: $sinew mesh FILE --output FOLDER
END
