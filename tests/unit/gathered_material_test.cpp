// SPDX-License-Identifier: GPL-2.0-or-later
// Explicit steps that a material of Newton's method takes together.
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "common/memory_archive.hpp"
#include "coupler/cells/gathered_material.hpp"

namespace polargrain::coupler {
namespace {

/// Remembers the ways it was asked for; commits are counted.
class Recorder : public fem::Material<2>, public GrainsOfPoints {
 public:
  void allocate(std::size_t points) override { asked.assign(points, Increment<2>{}); }
  void evaluate(std::span<const Increment<2>> increments, std::span<Response<2>> responses) override {
    ++evaluations;
    asked.assign(increments.begin(), increments.end());
    for (std::size_t p = 0; p < asked.size(); ++p)
      responses[p].stress(k11) = asked[p].displacement_gradient(0, 0);
  }
  [[nodiscard]] bool confirm() override { return refusals-- <= 0; }
  void commit() override { committed.push_back(asked); }
  void revert() override {}
  void save(ArchiveWriter& archive) const override { (void)archive; }
  [[nodiscard]] StatePointer grains_of(std::size_t point) const override {
    (void)point;
    return {};
  }
  [[nodiscard]] std::string at_limits() const override { return {}; }

  int evaluations = 0;
  int refusals = 0;  ///< times that confirm says no
  std::vector<Increment<2>> asked;
  std::vector<std::vector<Increment<2>>> committed;
};

Increment<2> step_of(Configuration configuration) {
  Increment<2> step;
  step.displacement_gradient << 0.1, 0.2, -0.3, 0.4;
  step.micro_rotation = 0.5;
  step.curvature << 0.6, -0.7;
  step.configuration = configuration;
  return step;
}

void take(GatheredMaterial<2>& material, const Increment<2>& step) {
  std::vector<Response<2>> responses(1);
  material.evaluate(std::vector{step}, responses);
  material.commit();
}

// Closed forms: gradients of small deformation add up, (I + h)(I + h) of large deformation are multiplied.
TEST(GatheredMaterial, AsksForTheWholeWay) {
  for (const Configuration configuration : {Configuration::fixed, Configuration::start}) {
    const auto recorder = std::make_shared<Recorder>();
    GatheredMaterial<2> material(recorder, 3);
    material.allocate(1);
    const Increment<2> step = step_of(configuration);
    take(material, step);
    take(material, step);
    const Eigen::Matrix2d h = step.displacement_gradient;
    const bool fixed = configuration == Configuration::fixed;
    const Eigen::Matrix2d both = fixed ? Eigen::Matrix2d(2.0 * h) : Eigen::Matrix2d(2.0 * h + h * h);
    const Eigen::Vector2d curvature =
        fixed ? Eigen::Vector2d(2.0 * step.curvature)
              : Eigen::Vector2d(2.0 * step.curvature + h.transpose() * step.curvature);
    EXPECT_TRUE(recorder->asked[0].displacement_gradient.isApprox(both, 1e-14));
    EXPECT_TRUE(recorder->asked[0].curvature.isApprox(curvature, 1e-14));
    EXPECT_DOUBLE_EQ(recorder->asked[0].micro_rotation, 1.0);
    EXPECT_EQ(recorder->asked[0].configuration, configuration);
  }
}

TEST(GatheredMaterial, CommitsEveryFewStepsAndWhereResultsAreWritten) {
  const auto recorder = std::make_shared<Recorder>();
  GatheredMaterial<2> material(recorder, 3);
  material.allocate(1);
  const Increment<2> step = step_of(Configuration::fixed);
  for (int k = 0; k < 4; ++k) take(material, step);
  EXPECT_EQ(recorder->committed.size(), 1U);
  MemoryArchive archive;
  EXPECT_THROW(material.save(archive), RunError);  // the fourth step would be lost
  material.settle();
  material.settle();
  ASSERT_EQ(recorder->committed.size(), 2U);
  EXPECT_DOUBLE_EQ(recorder->committed[1][0].micro_rotation, 0.5);
  EXPECT_NO_THROW(material.save(archive));
}

// A step that is dropped leaves no trace.
TEST(GatheredMaterial, RevertsToTheStepBefore) {
  const auto recorder = std::make_shared<Recorder>();
  GatheredMaterial<2> material(recorder, 9);
  material.allocate(1);
  const Increment<2> step = step_of(Configuration::fixed);
  take(material, step);
  std::vector<Response<2>> responses(1);
  material.evaluate(std::vector{step}, responses);
  material.revert();
  material.settle();
  EXPECT_DOUBLE_EQ(recorder->committed[0][0].micro_rotation, 0.5);
}

// As Newton's method does before it commits: asked until it stands by its answers, for the whole way.
TEST(GatheredMaterial, LetsTheMaterialAnswerBetter) {
  const auto recorder = std::make_shared<Recorder>();
  GatheredMaterial<2> material(recorder, 2);
  material.allocate(1);
  recorder->refusals = 3;
  const Increment<2> step = step_of(Configuration::fixed);
  take(material, step);
  EXPECT_EQ(recorder->evaluations, 1);
  take(material, step);
  EXPECT_EQ(recorder->evaluations, 2 + 3);
  EXPECT_DOUBLE_EQ(recorder->committed.at(0)[0].micro_rotation, 1.0);
}

TEST(GatheredMaterial, RefusesNoStepsAtAll) {
  EXPECT_THROW(GatheredMaterial<2>(std::make_shared<Recorder>(), 0), RunError);
}

}  // namespace
}  // namespace polargrain::coupler
