#include "sinew/MeshIO/MeshPresets.h"

#include <algorithm>
#include <array>

namespace sinew {
namespace {

constexpr WriteMeshOptions kPlain{.spaceTag = false};
constexpr WriteMeshOptions kWithMaterial{.spaceTag = false, .material = true};

/// FEBio Studio, meshio (on the way to FEniCS) and MFEM stumble over the text that marks the space in .vtu;
/// SOFA reads legacy VTK up to 4.2; FEniCS takes regions from the physical groups of Gmsh.
constexpr std::array kPresets{
    MeshPreset{"slicer", ".vtu", {}, true},    MeshPreset{"paraview", ".vtu", {}},
    MeshPreset{"febio", ".feb", kPlain},       MeshPreset{"sofa", ".vtk", kPlain},
    MeshPreset{"abaqus", ".inp", kPlain},      MeshPreset{"fenics", ".msh", kPlain},
    MeshPreset{"mfem", ".vtu", kWithMaterial},
};

}  // namespace

std::span<const MeshPreset> meshPresets() { return kPresets; }

const MeshPreset* findMeshPreset(std::string_view name) {
  const auto found = std::ranges::find(kPresets, name, &MeshPreset::name);
  return found == kPresets.end() ? nullptr : &*found;
}

}  // namespace sinew
