#include "Targets.h"

#include <array>

namespace sinew::fuzz {
namespace {

constexpr std::array kTargets{
    Target{"segmentation", &runSegmentation},
    Target{"dicom", &runDicom},
    Target{"label-table", &runLabelTable},
    Target{"obj", [](std::string_view bytes) { return runTriangleMesh(bytes, ".obj"); }},
    Target{"ply", [](std::string_view bytes) { return runTriangleMesh(bytes, ".ply"); }},
    Target{"stl", [](std::string_view bytes) { return runTriangleMesh(bytes, ".stl"); }},
    Target{"vtp", [](std::string_view bytes) { return runTriangleMesh(bytes, ".vtp"); }},
    Target{"msh", [](std::string_view bytes) { return runTetMesh(bytes, ".msh"); }},
    Target{"vtk", [](std::string_view bytes) { return runTetMesh(bytes, ".vtk"); }},
    Target{"vtu", [](std::string_view bytes) { return runTetMesh(bytes, ".vtu"); }},
    Target{"repair-script", &runRepairScript},
};

}  // namespace

std::span<const Target> targets() { return kTargets; }

}  // namespace sinew::fuzz
