#pragma once

#include "sinew/Elasticity/ElasticBody.h"
#include "sinew/Elasticity/Muscle.h"
#include "sinew/Simulation/Attachments.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// What is done to a mesh, from nothing to the full amount and back.
enum class Trial : std::uint8_t {
  Contract,  ///< isometric contraction: both ends held, activation up to `amount`, 1 unless given
  Compress,  ///< the ends are pushed together by `amount` of the distance between them, 0.3
  Indent,   ///< a round patch is pushed inwards by `amount` of the thickness there, 0.3; the far side is held
  Stretch,  ///< the ends are pulled apart by `amount` of the distance between them, 0.3
  Twist,    ///< the ends are turned against each other by `amount` degrees about the long axis, 90
};

inline constexpr std::array kTrials{Trial::Contract, Trial::Compress, Trial::Indent, Trial::Stretch,
                                    Trial::Twist};

/// "contract", "compress", "indent", "stretch", "twist"
std::string_view trialName(Trial trial);
/// What `amount` is when none is given, in the unit stated at the trial.
double usualAmount(Trial trial);

/// The tissue of every trial but Contract, neo-Hookean: skeletal muscle at rest across its fibres, about E =
/// 29 kPa and a Poisson ratio of 0.45.
struct SoftTissue {
  double shear = 10;  ///< mu, kPa
  double bulk = 100;  ///< K, kPa
};

struct TrialOptions {
  Trial trial = Trial::Contract;
  std::optional<double> amount = {};         ///< at its height, in the unit stated above; else usualAmount()
  double duration = 2;                       ///< s, of the way there and back
  int frames = 40;                           ///< evenly in time, after the first at rest; at least 2
  MuscleOptions muscle = {};                 ///< of Contract
  SoftTissue tissue = {};                    ///< of the others
  std::optional<Eigen::Vector3d> axis = {};  ///< long axis; from origin to insertion unless given
  std::optional<Eigen::Vector3d> push = {};  ///< Indent: where to; the thinnest way through unless given
  double tolerance = 1e-4;  ///< of a frame's balance of forces, over the largest force of a tet on a node
  int halvings = 5;         ///< of a step between frames that finds no balance, before the trial stops
  std::function<void()> onStep = {};  ///< called before each Newton step; what it throws ends the trial
};

struct TrialSetup {
  Attachments attachments = {};
  NodeVectors fibres = {};           ///< unit vector per tet; Contract only
  std::vector<double> tendons = {};  ///< share of tendon per tet in [0, 1]; empty for none; Contract only
};

/// A tet by its number and where its middle is at rest.
struct TrialSpot {
  std::int64_t tet = -1;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< mm
};

/// What a mesh is like at one time of a trial.
struct TrialFrame {
  double time = 0;    ///< s
  double amount = 0;  ///< now, in the unit of the trial: the activation of Contract
  double maxAspectRatio = 0;
  double minVolumeRatio = 1;  ///< least J: volume of a tet now over that at rest
  double minDihedralDeg = 0, maxDihedralDeg = 0;
  double energy =
      0;  ///< elastic, uJ; of Contract with what the active fibres hold, so that it may be negative
  double volume = 0;  ///< of the mesh, mm^3
  /// That moves the insertion (Contract: holds it against the pull; Twist: moment about the axis, mN mm) or
  /// the patch, mN.
  double force = 0;
  double residual = 0;  ///< largest force out of balance over the largest of a tet on a node
  int newtonSteps = 0, cgIterations = 0;  ///< since the frame before
  bool converged = false;
  TrialSpot worst;     ///< of maxAspectRatio
  TrialSpot flattest;  ///< of minVolumeRatio
};

struct TrialReport {
  std::vector<TrialFrame> frames;                       ///< up to where the trial stopped
  bool completed = false;                               ///< every frame is in balance
  std::string verdict;                                  ///< one line
  double largestAspectRatio = 0;                        ///< of all frames and tets
  double growth = 0;                                    ///< of it over that of the first frame, - 1
  double leastVolumeRatio = 1;                          ///< of all frames and tets
  double leastDihedralDeg = 0, largestDihedralDeg = 0;  ///< of all frames and tets
  TrialSpot worst;                                      ///< of the largest aspect ratio of all frames
  std::int64_t loosePieces = 0, looseTets = 0;          ///< of the mesh that nothing holds: they stood still
  std::optional<double> stoppedAt;  ///< the last amount in balance, of a trial that stopped
};

/// @throws std::invalid_argument saying what is out of range
void checkTrialOptions(const TrialOptions& options);

/// @throws std::invalid_argument when there is none, or with the number of tets that are flat or inverted, and
/// where the first is
void checkTetsAtRest(const TetMesh& mesh);

using OnTrialFrame = std::function<void(const TrialFrame&, const NodeVectors& places)>;

/// Puts a mesh to a trial and measures its tets: a row of states in balance (findEquilibrium), one per frame,
/// each from the ones before. Inertia is left out: of a muscle of 300 mm with shear waves of 3 m/s it is
/// about (0.1 s / 2 s)^2, below 1 %. Explicit time steps would be bound by the smallest tet: some 1e5 of
/// them.
/// @param onFrame  called in order of time with the places of the nodes, mm; may be empty
/// @return with completed = false, and the frames up to there, when a step finds no balance
///
/// @throws std::invalid_argument for tets that are flat or inverted; ends that are missing, touch or name
/// nodes the mesh has not; pieces that nothing holds with most of the tets; fibres of the wrong number or length;
/// options out of range
///
/// Cost: frames times some Newton steps. Same bits for any number of threads.
///
/// Source: Teran et al. 2005, Creating and simulating skeletal muscle from the visible human data set.
TrialReport runTrial(const TetMesh& mesh, const TrialSetup& setup, const TrialOptions& options = {},
                     const OnTrialFrame& onFrame = {});

}  // namespace sinew
