#pragma once

#include "Option.h"
#include "TissueMeshInput.h"
#include "sinew/Simulation/MeshTrial.h"

namespace sinew {

/// What a person chooses about the ends and the fibres of a tissue, in `sinew fibres` and `sinew simulate`.
struct FibreSettings {
  std::string tissue;             ///< name or label; empty: the only one of the mesh
  std::string origin, insertion;  ///< a mesh file, a tissue of the same mesh or a box; empty: an end
  double ends = 0.1;              ///< share of the length that an end takes
  std::optional<double> contact;  ///< how near a neighbour touches, mm; the mean boundary edge unless given
  std::optional<double> tendon;   ///< share of the length that the tendon takes at each end
  std::string spline;             ///< file of a B-spline solid; empty: none
};

/// The options of `settings`, as rows; the settings must outlive them.
std::vector<Option> fibreOptions(FibreSettings& settings);

/// Before anything is read.
/// @throws CLI::ValidationError naming the option
void checkFibreSettings(const FibreSettings& settings);

/// The ends of a tissue: what the options name, or else the ends along its long axis; for one alone the end
/// that is farther from it.
/// @throws std::runtime_error naming the file and the option
Attachments attachmentsOf(const TissueMeshInput& input, const FibreSettings& settings);

/// The fibres of a tissue.
struct TissueFibres {
  NodeVectors directions;       ///< of each tet; zero where nothing says one
  std::vector<double> tendons;  ///< share of tendon of each tet; empty for none
  const char* source = "";      ///< "spline", "mesh" or "harmonic"
  std::int64_t missing = 0;     ///< tets without
  std::int64_t outside = 0;     ///< of a spline: tets that lie farther from it than the mesh's edges are long

  /// What a person should know about them; empty: nothing.
  std::string warning() const;
};

enum class OwnFibres { Take, Ignore };

/// From the file of a B-spline solid when there is one, else the mesh's own array `fibres` when it is to be
/// taken and there, else the harmonic field between the attachments. Tendons as chosen, else from the mesh's
/// own array `tendon`.
/// @throws std::runtime_error naming the file, also when no tet gets a fibre or all lie outside of the spline
TissueFibres fibresOf(const TissueMeshInput& input, const Attachments& attachments,
                      const FibreSettings& settings, OwnFibres own);

/// Three floats for each vector.
MeshArray vectorArray(const std::string& name, const NodeVectors& vectors);

}  // namespace sinew
