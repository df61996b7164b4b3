#pragma once

#include "sinew/Elasticity/ForceModel.h"

#include <array>

namespace sinew {

/// Stiffness k of a spring from its rest length l0 and the harmonic mean m of the masses at its ends, so that
/// waves have the speed c whatever the mesh:  k = c^2 m / l0,  force k (l / l0 - 1) = (k / l0) (l - l0).
/// Damping along the spring: the share `damping` of what is critical for k / l0 and m.
struct SpringOptions {
  double soundSpeed = 1000;  ///< c, mm/s
  double damping = 0.1;      ///< 0: none, 1: critical
  double crossingTime = 0;   ///< s; above 0, waves take this time along every spring: c = l0 / crossingTime
};

/// A linear spring along every edge of the mesh. Each tet holds its part of the stiffness of its edges.
/// Source: Teran et al. 2005, section 7.1.
class EdgeSprings final : public ForceModel {
 public:
  /// Keeps a reference to the body. @throws std::invalid_argument on options out of range
  EdgeSprings(const ElasticBody& body, const SpringOptions& options = {});

  double energy(const NodeVectors& places) const override;
  void addForces(const NodeVectors& places, NodeVectors& forces) const override;
  void moveTo(const NodeVectors& places) override;
  void addDamping(const NodeVectors& velocities, NodeVectors& forces) const override;

 private:
  struct Spring {
    double length, stiffness, damping;  ///< at rest, mm; k / l0, kg/s^2; kg/s
  };
  using OfTet = std::array<Spring, 6>;

  template <class Function>
  void forEdges(std::size_t tet, const Function& f) const;
  template <class Pull>
  void addPulls(const Pull& pull, NodeVectors& forces) const;

  const ElasticBody& body_;
  double damping_;
  std::vector<OfTet> springs_;
  NodeVectors places_;
};

struct AltitudeSpringOptions {
  SpringOptions springs = {};
  bool shortestOnly = false;  ///< in each tet only the spring that is the shortest now
  double actsBelow = 1e300;   ///< only springs shorter than this times their rest length act
};

/// A spring from every node of a tet to the plane of the other three, with a signed length, so that flat and
/// inverted tets are pushed back: on node 4 f = -(k/l0)(d - l0) n, on the others -w_i f, with n the plane's
/// normal, d the height, w the barycentric coordinates of the foot; damping -(k_d/l0) n n^T (v4 - sum w_i
/// v_i).
/// Source: Molino et al. 2003; Teran et al. 2005, section 7.1.
class AltitudeSprings final : public ForceModel {
 public:
  /// Keeps a reference to the body. @throws std::invalid_argument on options out of range
  AltitudeSprings(const ElasticBody& body, const AltitudeSpringOptions& options = {});

  double energy(const NodeVectors& places) const override;
  void addForces(const NodeVectors& places, NodeVectors& forces) const override;
  void moveTo(const NodeVectors& places) override;
  void addDamping(const NodeVectors& velocities, NodeVectors& forces) const override;

  /// The Cauchy stress that has the same nodal forces: sigma = sum_i (3 f_i / A_i) n_i n_i^T with f_i the
  /// tension of spring i over the area A_i of the face under it, kPa.
  Eigen::Matrix3d stress(const NodeVectors& places, std::size_t tet) const;

  /// How many springs act at these places.
  std::size_t actingSprings(const NodeVectors& places) const;

 private:
  struct Spring {
    double length, stiffness, damping;
  };
  using OfTet = std::array<Spring, 4>;

  /// Calls f(corner, altitude, spring) for the springs of a tet that act.
  template <class Function>
  void forActing(const NodeVectors& places, std::size_t tet, const Function& f) const;

  const ElasticBody& body_;
  AltitudeSpringOptions options_;
  std::vector<OfTet> springs_;
  NodeVectors places_;
};

}  // namespace sinew
