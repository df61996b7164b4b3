#include "sinew/Pipeline/MethodSettings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace sinew {
namespace {

using Method = CompressionMethod;

std::string refusal(const std::string& text, Method method) {
  PhysicsCompressionOptions physics;
  try {
    setPhysics(text, method, physics);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

TEST(MethodSettings, EveryNameIsReadBack) {
  EXPECT_EQ(methodNames(), (std::vector<std::string>{"optimization", "springs", "fem", "hybrid"}));
  for (const std::string& name : methodNames()) EXPECT_EQ(toString(parseMethod(name)), name);
  EXPECT_THROW(parseMethod("magic"), std::invalid_argument);
}

TEST(MethodSettings, KeysSetTheirOptions) {
  PhysicsCompressionOptions physics;
  for (const char* text : {"material=corotated", "poisson=0.3", "drag=1.5", "force-steps=7", "strain=0.4"})
    setPhysics(text, Method::FiniteElements, physics);
  setPhysics("shortest-only=true", Method::Springs, physics);
  EXPECT_EQ(physics.material, MeshingMaterial::Corotated);
  EXPECT_EQ(physics.poisson, 0.3);
  EXPECT_EQ(physics.drag, 1.5);
  EXPECT_EQ(physics.forceSteps, 7);
  EXPECT_EQ(physics.limits.strain, 0.4);
  EXPECT_TRUE(physics.shortestOnly);
}

TEST(MethodSettings, RefuseWhatHasNoEffectOrIsOutOfRange) {
  EXPECT_TRUE(holds(refusal("poisson=0.1", Method::Springs), "no effect on the method springs"));
  EXPECT_TRUE(holds(refusal("acts-below=1", Method::Hybrid), "no effect on the method hybrid"));
  EXPECT_TRUE(holds(refusal("drag=1", Method::Optimization), "no effect on the method optimization"));
  EXPECT_TRUE(holds(refusal("mass=1", Method::FiniteElements), "its keys are material, poisson"));
  EXPECT_TRUE(holds(refusal("drag", Method::FiniteElements), "drag"));
  EXPECT_TRUE(holds(refusal("poisson=0.5", Method::FiniteElements), "poisson must be in (-1, 0.5)"));
  EXPECT_TRUE(holds(refusal("drag=fast", Method::FiniteElements), "drag must be a number"));
  EXPECT_TRUE(holds(refusal("force-steps=1.5", Method::FiniteElements), "a whole number"));
  EXPECT_TRUE(
      holds(refusal("material=steel", Method::FiniteElements), "one of neo-hookean, stvk, corotated"));
}

TEST(MethodSettings, ListOnlyWhatHasAnEffect) {
  const auto has = [](Method method, const std::string& key) {
    const auto settings = physicsSettings(method, {});
    return std::ranges::count(settings, key, &std::pair<std::string, PhysicsValue>::first) == 1;
  };
  EXPECT_TRUE(physicsSettings(Method::Optimization, {}).empty());
  EXPECT_TRUE(has(Method::Springs, "acts-below") && has(Method::Springs, "drag"));
  EXPECT_FALSE(has(Method::Springs, "poisson"));
  EXPECT_TRUE(has(Method::Hybrid, "poisson") && has(Method::FiniteElements, "material"));
  EXPECT_FALSE(has(Method::FiniteElements, "shortest-only"));
  EXPECT_EQ(std::get<std::string>(physicsSettings(Method::Hybrid, {})[0].second), "neo-hookean");
}

}  // namespace
}  // namespace sinew
