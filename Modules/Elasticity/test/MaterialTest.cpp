#include "sinew/Elasticity/ElasticBody.h"
#include "sinew/Elasticity/Material.h"
#include "sinew/Elasticity/Muscle.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Law {
  const char* name;
  std::unique_ptr<Material> material;
};

std::vector<Law> laws() {
  const Lame soft = lame(30, 0.4);
  std::vector<Law> result;
  result.push_back({"St Venant-Kirchhoff", stVenantKirchhoff(soft)});
  result.push_back({"neo-Hookean", neoHookean(soft)});
  result.push_back({"corotated", corotated(soft)});
  const auto muscle = [](double tendon, double activation) {
    auto law = std::make_unique<Muscle>(
        std::vector<MuscleFibre>{{.direction = Vector3d(1, 2, -2) / 3, .tendon = tendon}});
    law->activate(activation);
    return law;
  };
  result.push_back({"muscle", muscle(0, 0.7)});
  result.push_back({"tendon", muscle(1, 0.7)});
  return result;
}

Matrix3d rotation(unsigned seed) {
  const NodeVectors v = test::randomVectors(2, 1, seed);
  return Eigen::AngleAxisd(3 * v[1].x(), v[0].normalized()).toRotationMatrix();
}

/// Some deformations, mild and strong, one of them inverted.
std::vector<Matrix3d> deformations() {
  std::vector<Matrix3d> all;
  for (unsigned seed = 1; seed <= 20; ++seed)
    all.push_back(rotation(seed) *
                  (Matrix3d::Identity() + test::randomMatrix(seed % 2 ? 0.2 : 0.6, seed + 100)));
  all.push_back(rotation(77) * Vector3d(1.1, 0.9, -0.4).asDiagonal());
  return all;
}

// The central difference of a smooth energy over 1e-4: error of order 1e-8 of the moduli.
TEST(Material, StressIsTheDerivativeOfTheEnergy) {
  for (const Law& law : laws())
    for (const Matrix3d& F : deformations()) {
      const Matrix3d dF = test::randomMatrix(1, 5), P = law.material->stress(0, F);
      const auto energy = [&](double h) { return law.material->energy(0, F + h * dF); };
      constexpr double h = 1e-4;  // fourth order: h^4 and 1e-16 / h of the energy are both below 1e-11
      const double slope = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
      EXPECT_NEAR(slope, P.cwiseProduct(dF).sum(), 1e-8 * (1 + P.norm()) * 10) << law.name << "\n" << F;
    }
}

TEST(Material, StressChangeIsTheDerivativeOfTheStress) {
  for (const Law& law : laws())
    for (const Matrix3d& F : deformations()) {
      const Matrix3d dF = test::randomMatrix(1, 6), change = law.material->stressChange(0, F, dF);
      const auto stress = [&](double h) { return law.material->stress(0, F + h * dF); };
      constexpr double h = 1e-4;
      const Matrix3d slope = (8 * (stress(h) - stress(-h)) - (stress(2 * h) - stress(-2 * h))) / (12 * h);
      EXPECT_LT((slope - change).norm(), 1e-7 * (1 + change.norm())) << law.name << "\n" << F;
    }
}

TEST(Material, StiffnessIsSymmetric) {
  for (const Law& law : laws())
    for (const Matrix3d& F : deformations()) {
      const Matrix3d A = test::randomMatrix(1, 7), B = test::randomMatrix(1, 8);
      const double ab = law.material->stressChange(0, F, A).cwiseProduct(B).sum(),
                   ba = law.material->stressChange(0, F, B).cwiseProduct(A).sum();
      EXPECT_NEAR(ab, ba, 1e-12 * law.material->stressChange(0, F, A).norm() * 10) << law.name << "\n" << F;
    }
}

// Turning the world turns the stress and leaves the energy.
TEST(Material, EnergyDoesNotSeeRotations) {
  for (const Law& law : laws())
    for (const Matrix3d& F : deformations()) {
      const Matrix3d Q = rotation(9), P = law.material->stress(0, F);
      EXPECT_NEAR(law.material->energy(0, Q * F), law.material->energy(0, F),
                  1e-12 * (1 + std::abs(law.material->energy(0, F))))
          << law.name;
      EXPECT_LT((law.material->stress(0, Q * F) - Q * P).norm(), 1e-11 * (1 + P.norm())) << law.name << "\n"
                                                                                         << F;
    }
}

TEST(Material, AtRestThereIsNoStressAndHookesLawAroundIt) {
  const Lame constants = lame(30, 0.4);
  const Matrix3d dF = test::randomMatrix(1, 10), strain = (dF + dF.transpose()) / 2;
  const Matrix3d hooke = constants.lambda * strain.trace() * Matrix3d::Identity() + 2 * constants.mu * strain;
  for (const auto& material : {stVenantKirchhoff(constants), neoHookean(constants), corotated(constants)}) {
    EXPECT_LT(material->stress(0, Matrix3d::Identity()).norm(), 1e-13);
    EXPECT_LT((material->stressChange(0, Matrix3d::Identity(), dF) - hooke).norm(), 1e-12 * hooke.norm());
  }
}

// P_11 = (lambda + 2 mu) (s^3 - s) / 2 under a stretch s along x alone has its extreme at 1/sqrt(3).
TEST(Material, StVenantKirchhoffSoftensBelowOneOverRootThree) {
  const auto material = stVenantKirchhoff(lame(30, 0.4));
  const auto slope = [&](double s) {
    const Matrix3d F = Vector3d(s, 1, 1).asDiagonal();
    return material->stressChange(0, F, Vector3d::UnitX() * Vector3d::UnitX().transpose())(0, 0);
  };
  EXPECT_NEAR(slope(1 / std::sqrt(3.)), 0, 1e-12 * slope(1));
  EXPECT_LT(slope(0.57), 0);
  EXPECT_GT(slope(0.58), 0);
}

// Flattening further always costs energy, through zero volume too.
TEST(Material, NeoHookeanPushesInvertedTetsBack) {
  const auto material = neoHookean(lame(30, 0.4));
  for (double s = -1.5; s < 0.95; s += 0.05) {
    const Matrix3d F = Vector3d(s, 1, 1).asDiagonal();
    EXPECT_LT(material->stress(0, F)(0, 0), 0) << s;
  }
}

TEST(Material, RefusesConstantsOutOfRange) {
  EXPECT_THROW(lame(0, 0.3), std::invalid_argument);
  EXPECT_THROW(lame(10, 0.5), std::invalid_argument);
  EXPECT_THROW(lame(10, -1), std::invalid_argument);
}

TEST(Muscle, FibreCurvesAreTheirIntegralsSlopes) {
  const FibreCurves curves;
  constexpr double h = 1e-5;
  for (const double s : {0.3, 0.5, 0.7, 0.95, 1.05, 1.3, 1.39, 1.45, 1.55, 1.7}) {
    EXPECT_NEAR((curves.passiveEnergy(s + h) - curves.passiveEnergy(s - h)) / (2 * h), curves.passive(s),
                1e-8)
        << s;
    EXPECT_NEAR((curves.passive(s + h) - curves.passive(s - h)) / (2 * h), curves.passiveSlope(s), 1e-7) << s;
    EXPECT_NEAR((FibreCurves::activeEnergy(s + h) - FibreCurves::activeEnergy(s - h)) / (2 * h),
                FibreCurves::active(s), 1e-8)
        << s;
    EXPECT_NEAR((FibreCurves::active(s + h) - FibreCurves::active(s - h)) / (2 * h),
                FibreCurves::activeSlope(s), 1e-7)
        << s;
  }
}

TEST(Muscle, FibreCurvesHaveTheirKnownValues) {
  const FibreCurves curves;
  EXPECT_EQ(FibreCurves::active(1), 1);
  EXPECT_EQ(FibreCurves::active(0.4), 0);
  EXPECT_EQ(FibreCurves::active(1.6), 0);
  EXPECT_NEAR(FibreCurves::active(0.6), 0.36, 1e-15);
  EXPECT_EQ(curves.passive(0.9), 0);
  EXPECT_NEAR(curves.passive(1.2), 0.05 * (std::exp(6.6 * 0.2) - 1), 1e-15);
}

TEST(Muscle, OnlyMuscleIsActive) {
  Muscle muscle(
      {{.direction = Vector3d::UnitX(), .tendon = 0}, {.direction = Vector3d::UnitX(), .tendon = 1}});
  muscle.activate(1);
  EXPECT_EQ(muscle.fibreTension(0, 1), MuscleOptions().tension);
  EXPECT_EQ(muscle.fibreTension(1, 1), 0);
}

TEST(Muscle, RefusesWhatIsNoFibre) {
  EXPECT_THROW(Muscle({{.direction = Vector3d(1, 1, 0)}}), std::invalid_argument);
  EXPECT_THROW(Muscle(std::vector<MuscleFibre>{{.tendon = 1.5}}), std::invalid_argument);
  EXPECT_THROW(Muscle({}, {.bulk = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace sinew
