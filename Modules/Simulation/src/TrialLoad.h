#pragma once

#include "LoosePieces.h"
#include "sinew/Simulation/MeshTrial.h"

#include <memory>

namespace sinew {

/// What a trial does to a body: its material, what holds it, and how what is held moves.
class TrialLoad {
 public:
  /// @throws std::invalid_argument when Indent finds no node to push or to hold, nothing connects the ends, or
  /// nothing holds most of the mesh
  TrialLoad(const TetMesh& mesh, const ElasticBody& body, const TrialSetup& setup,
            const TrialOptions& options);

  const Material& material() const { return *material_; }
  const NodeConstraints& constraints() const { return constraints_; }
  /// They are held too, and stay where they are.
  const LoosePieces& loosePieces() const { return loose_; }

  /// The fibres' activation, where the amount is one.
  void activate(double amount);

  /// Moves the held nodes on as the amount grows by `change`, and the others with them: by the share of the
  /// motion that a harmonic field carries to them.
  void carry(double change, NodeVectors& places) const;

  /// See TrialFrame::force.
  double force(const ElasticBody& body, const NodeVectors& places) const;

 private:
  void hold(const std::vector<std::int32_t>& nodes, double share, std::vector<double>& shares);
  void holdLoosePieces(const ElasticBody& body);
  void moveEnds(const ElasticBody& body, const Attachments& ends, const TrialOptions& options);
  void pushPatch(const TetMesh& mesh, const ElasticBody& body, const Attachments& ends,
                 const TrialOptions& options);

  Trial trial_;
  std::unique_ptr<Material> material_;
  NodeConstraints constraints_;
  LoosePieces loose_;
  std::vector<double> share_;                        // of the motion, per node; Contract: of held nodes only
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();  // of share 1 at amount 1, mm
  Eigen::Vector3d axis_ = Eigen::Vector3d::Zero(), onAxis_ = Eigen::Vector3d::Zero();  // of the twist
};

}  // namespace sinew
