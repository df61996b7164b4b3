#include "TrialChecks.h"

#include "Numbers.h"
#include "TetMiddle.h"
#include "TrialText.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;

void require(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument(what);
}

/// 0 for free nodes, 1 at the origin, 2 at the insertion.
std::vector<char> endOfNodes(const TetMesh& mesh, const Attachments& attachments) {
  std::vector<char> end(mesh.nodes.size(), 0);
  const auto attach = [&](const std::vector<std::int32_t>& nodes, char number, const std::string& name) {
    require(!nodes.empty(), "there is no node at the " + name);
    for (const std::int32_t node : nodes) {
      require(node >= 0 && static_cast<std::size_t>(node) < mesh.nodes.size(),
              "the " + name + " has node " + std::to_string(node) + ", the mesh " +
                  std::to_string(mesh.nodes.size()) + " nodes");
      char& known = end[static_cast<std::size_t>(node)];
      require(known == 0 || known == number,
              "node " + std::to_string(node) + " is at the origin and at the insertion");
      known = number;
    }
  };
  attach(attachments.origin, 1, "origin");
  attach(attachments.insertion, 2, "insertion");
  return end;
}

void checkAttachments(const TetMesh& mesh, const Attachments& attachments) {
  const std::vector<char> end = endOfNodes(mesh, attachments);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    int ends = 0;
    for (const std::int32_t node : mesh.tets[t]) ends |= end[static_cast<std::size_t>(node)];
    require(ends != 3, "the ends touch: tet " + std::to_string(t) + " near " +
                           placeText(tetMiddle(mesh.nodes, mesh.tets[t])) +
                           " has nodes of both; make the ends smaller or the mesh finer");
  }
}

void checkFibres(const TetMesh& mesh, const TrialSetup& setup) {
  const auto count = [&](std::size_t given, const std::string& what) {
    require(given == mesh.tets.size(), "there are " + std::to_string(given) + " " + what + " for " +
                                           std::to_string(mesh.tets.size()) + " tets");
  };
  count(setup.fibres.size(), "fibres");
  if (!setup.tendons.empty()) count(setup.tendons.size(), "shares of tendon");
  const auto spot = [&](std::size_t t) {
    return "tet " + std::to_string(t) + " near " + placeText(tetMiddle(mesh.nodes, mesh.tets[t]));
  };
  constexpr double kUnit = 1e-6;
  for (std::size_t t = 0; t < setup.fibres.size(); ++t)
    require(std::abs(setup.fibres[t].norm() - 1) < kUnit, "the fibre of " + spot(t) + " is no unit vector");
  for (std::size_t t = 0; t < setup.tendons.size(); ++t)
    require(
        setup.tendons[t] >= 0 && setup.tendons[t] <= 1,
        "the share of tendon of " + spot(t) + " is " + toText(setup.tendons[t]) + ", but must be in [0, 1]");
}

}  // namespace

void checkTrialOptions(const TrialOptions& options) {
  const double amount = options.amount.value_or(usualAmount(options.trial));
  const std::string given = "the amount is " + toText(amount) + ", but must be ";
  switch (options.trial) {
    case Trial::Contract:
      require(amount > 0 && amount <= 1, given + "an activation in (0, 1]");
      break;
    case Trial::Compress:
    case Trial::Indent:
      require(amount > 0 && amount < 1, given + "a share in (0, 1)");
      break;
    case Trial::Stretch:
      require(amount > 0 && std::isfinite(amount), given + "a positive share");
      break;
    case Trial::Twist:
      require(amount != 0 && std::isfinite(amount), given + "an angle in degrees other than 0");
      break;
  }
  require(options.duration > 0 && std::isfinite(options.duration), "the duration must be positive");
  require(
      options.frames >= 2 && options.frames % 2 == 0,
      "there are " + std::to_string(options.frames) + " frames, but the number must be even and positive");
  require(options.tolerance > 0 && options.tolerance < 1, "the tolerance must be in (0, 1)");
  require(options.halvings >= 0, "the halvings must not be negative");
  require(options.tissue.shear > 0 && options.tissue.bulk > 2. / 3 * options.tissue.shear,
          "the tissue must have a positive shear modulus, and a bulk modulus above two thirds of it");
  for (const double modulus :
       {options.muscle.shear, options.muscle.bulk, options.muscle.tension, options.muscle.tendonShear,
        options.muscle.tendonBulk, options.muscle.tendonTension})
    require(modulus > 0 && std::isfinite(modulus),
            "every modulus and tension of the muscle must be positive");
  for (const auto& direction : {options.axis, options.push})
    require(!direction || (direction->allFinite() && direction->norm() > 0), "a direction must not be zero");
}

void checkTetsAtRest(const TetMesh& mesh) {
  require(!mesh.tets.empty(), "the mesh has no tets");
  std::size_t bad = 0, first = 0;
  for (std::size_t t = mesh.tets.size(); t-- > 0;) {
    const auto at = [&](int c) -> const Vector3d& {
      return mesh.nodes[static_cast<std::size_t>(mesh.tets[t][static_cast<std::size_t>(c)])];
    };
    if ((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) > 0) continue;
    ++bad;
    first = t;
  }
  if (bad > 0)
    require(false, std::to_string(bad) + " tets are flat or inverted at rest, the first is tet " +
                       std::to_string(first) + " near " + placeText(tetMiddle(mesh.nodes, mesh.tets[first])));
}

void checkSetup(const TetMesh& mesh, const TrialSetup& setup, const TrialOptions& options) {
  checkTetsAtRest(mesh);
  checkAttachments(mesh, setup.attachments);
  if (options.trial == Trial::Contract) checkFibres(mesh, setup);
}

}  // namespace sinew
