// SPDX-License-Identifier: GPL-2.0-or-later
#include <cmath>

#include "common/memory_archive.hpp"
#include "coupler/cells/resident_material.hpp"
#include "tests/unit/resident_fixture.hpp"

namespace polargrain::coupler {
namespace {

constexpr CosseratParameters kCosserat{40e6, 10e6, 0.02};
constexpr std::size_t kPoints = 20;

std::vector<Increment<2>> increments_of_step(int step) {
  std::vector<Increment<2>> increments(kPoints);
  for (std::size_t p = 0; p < kPoints; ++p) {
    Increment<2>& increment = increments[p];
    increment.displacement_gradient << 1e-3 * std::sin(0.3 * static_cast<double>(p) + step), 2e-4, -1e-4,
        -5e-4;
    increment.micro_rotation = 1e-4 * static_cast<double>(p);
    increment.curvature << 0.01, -0.02;
  }
  return increments;
}

std::vector<Response<2>> step(ResidentMaterial<2>& sand, int number) {
  std::vector<Response<2>> responses(kPoints);
  sand.evaluate(increments_of_step(number), responses);
  sand.commit();
  return responses;
}

void expect_same(const std::vector<Response<2>>& a, const std::vector<Response<2>>& b) {
  for (std::size_t p = 0; p < kPoints; ++p)
    EXPECT_EQ(std::memcmp(a[p].stress.data(), b[p].stress.data(), sizeof(Vector7)), 0) << p;
}

class ResidentMaterialTest : public ResidentTest {
 protected:
  ResidentMaterial<2> material(Pool& pool, const std::string& script = "",
                               const std::optional<CosseratParameters>& cosserat = kCosserat) {
    ResidentMaterial<2> made(pool, pool.define(testing::resident_definition(script)), cosserat, 5);
    made.allocate(kPoints);
    return made;
  }
};

TEST_F(ResidentMaterialTest, TheStressAtTheStartAsksNobody) {
  Pool pool(options(1));
  ResidentMaterial<2> sand = material(pool);
  std::vector<Response<2>> responses(kPoints);
  sand.evaluate(std::vector<Increment<2>>(kPoints), responses);
  sand.revert();
  EXPECT_EQ(pool.counts().evaluations, 1);  // the packing
  EXPECT_EQ(responses[3].stress[k11], testing::kRestStress);
  EXPECT_EQ(responses[3].tangent(k11, k11), 1e7);
  EXPECT_EQ(responses[3].tangent(kCurvature1, kCurvature1), kCosserat.couple_modulus());
}

TEST_F(ResidentMaterialTest, BoxesAndTheCosseratPartAnswer) {
  Pool pool(options(2));
  ResidentMaterial<2> sand = material(pool);
  const std::vector<Response<2>> first = step(sand, 0);
  const std::vector<Response<2>> second = step(sand, 1);
  testing::LineService service(testing::resident_definition(""));
  const std::unique_ptr<ResidentBoxes> line = service.residents();
  line->move_in(std::vector<ResidentStart>(1));
  const Increment<2> increment = increments_of_step(0)[7];
  CellIncrement symmetric;
  symmetric.displacement_gradient(0, 0) = increment.displacement_gradient(0, 0);
  symmetric.displacement_gradient(1, 1) = -5e-4;
  symmetric.displacement_gradient(0, 1) = symmetric.displacement_gradient(1, 0) = 5e-5;
  const ResidentAnswer answer = line->go_on(5, {&symmetric, 1}).front();
  EXPECT_EQ(first[7].stress[k22], answer.stress(1, 1));
  const Vector7 strain = increment.strain();
  // A.4: s21 - s12 = 2 Gc (eps21 - eps12), m = 2 G lc^2 kappa; sums of doubles of 1e5 Pa.
  EXPECT_NEAR(first[7].stress[k21] - first[7].stress[k12], 2.0 * 10e6 * (strain[k21] - strain[k12]), 1e-8);
  EXPECT_NEAR(first[7].stress[kCurvature1], kCosserat.couple_modulus() * 0.01, 1e-9);
  // The second step goes with the contacts that are left.
  const double contacts = std::llround(0.5 * answer.coordination_number * testing::kResidentGrains);
  const double kept = contacts / (0.5 * testing::kRestCoordination * testing::kResidentGrains);
  EXPECT_NEAR(second[7].stress[kCurvature1] - first[7].stress[kCurvature1],
              kept * kCosserat.couple_modulus() * 0.01, 1e-9);
}

TEST_F(ResidentMaterialTest, AStepCannotBeTakenBack) {
  Pool pool(options(1));
  ResidentMaterial<2> sand = material(pool);
  std::vector<Response<2>> responses(kPoints);
  sand.evaluate(increments_of_step(0), responses);
  EXPECT_THROW(sand.revert(), RunError);
  EXPECT_THROW(sand.evaluate(increments_of_step(0), responses), RunError);
  EXPECT_THROW(sand.settle(), RunError);
  sand.commit();
  sand.revert();
  MemoryArchive archive;
  EXPECT_THROW(sand.save(archive), RunError);
  sand.settle();
  sand.save(archive);
  EXPECT_THROW(ResidentMaterial<2>(pool, 0, kCosserat, 0), RunError);
}

// In real time a step has as many DEM steps as last as long, and two at least.
TEST_F(ResidentMaterialTest, DemStepsLastAsLongAsTheStep) {
  Pool pool(options(2));
  ResidentMaterial<2> sand = material(pool);
  for (const auto& [seconds, dem_steps] : {std::pair{9.7e-6, 4}, {testing::kTimeStep, 2}}) {
    sand.expect({.once = true, .seconds = seconds});
    const std::int64_t before = pool.counts().dem_steps;
    step(sand, 0);
    EXPECT_EQ(pool.counts().dem_steps - before, static_cast<std::int64_t>(kPoints) * dem_steps);
    sand.settle();
  }
}

TEST_F(ResidentMaterialTest, AReadOutBringsDiagnosticsAndGrains) {
  Pool pool(options(2));
  ResidentMaterial<2> sand = material(pool);
  const StatePointer packing = sand.grains_of(4);
  step(sand, 0);
  EXPECT_EQ(sand.grains_of(4), packing);
  sand.settle();
  EXPECT_NE(sand.grains_of(4)->name(), packing->name());
  EXPECT_TRUE(sand.grains_of(4)->is_here());
  const std::vector<std::string> names = sand.field_names();
  std::vector<double> values(names.size());
  sand.fields(4, values);
  const auto at = [&](const std::string& name) {
    return values.at(static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()));
  };
  EXPECT_NE(at("void_ratio"), 0.2);
  EXPECT_NEAR(at("void_ratio"), 0.2, 0.01);
  EXPECT_EQ(at("parted"), 0.0);
  const std::int64_t fetched = pool.counts().states_fetched;
  sand.settle();  // nobody has moved
  EXPECT_EQ(pool.counts().states_fetched, fetched);
}

// By hand: the service's ratio is 0.9^5 of that before and 4.0951 times a fifth of the stretch, so that the mean of two steps is
// 1.0608 stretches. Beyond 10 % a box is hot. A read-out begins a new mean.
TEST_F(ResidentMaterialTest, UnrestIsAMeanOverTheStepsAndHotBoxesAreCounted) {
  Pool pool(options(2));
  ResidentMaterial<2> sand = material(pool);
  EXPECT_EQ(sand.unrest().points, 0U);
  std::vector<Increment<2>> stretches(kPoints);
  for (std::size_t p = 0; p < kPoints; ++p) stretches[p].displacement_gradient(0, 0) = p < 5 ? 0.2 : 0.05;
  std::vector<Response<2>> responses(kPoints);
  for (int k = 0; k < 2; ++k) {
    sand.evaluate(stretches, responses);
    sand.commit();
  }
  const fem::Unrest unrest = sand.unrest();
  EXPECT_EQ(unrest.points, kPoints);
  EXPECT_EQ(unrest.hot, 5U);
  const double first = 0.2 * (1.0 - std::pow(0.9, 5)) / 0.1;
  const double mean = 0.5 * first * (2.0 + std::pow(0.9, 5));
  EXPECT_NEAR(unrest.sum, mean * (5 * 0.2 + 15 * 0.05), 1e-12);
  sand.settle();
  EXPECT_EQ(sand.unrest().points, 0U);
}

TEST_F(ResidentMaterialTest, ARunGoesOnFromItsCheckpointToTheSameBits) {
  Pool pool(options(2));
  for (const int steps : {0, 3}) {
    ResidentMaterial<2> sand = material(pool);
    for (int k = 0; k < steps; ++k) step(sand, k);
    sand.settle();
    MemoryArchive archive;
    sand.save(archive);
    Pool other(options(3));
    ResidentMaterial<2> again = material(other, ends_once("ends_in_step " + std::to_string(steps + 2)));
    again.restore(archive);
    EXPECT_EQ(again.grains_of(2)->name(), sand.grains_of(2)->name());
    for (int k = steps; k < steps + 4; ++k) expect_same(step(again, k), step(sand, k));
    EXPECT_EQ(other.counts().workers_lost, 1);
  }
}

TEST_F(ResidentMaterialTest, ControlledBoxesAnswerWhole) {
  Pool pool(options(1));
  ResidentMaterial<2> sand = material(pool, "", std::nullopt);
  const std::vector<Response<2>> responses = step(sand, 0);
  EXPECT_EQ(responses[2].stress[kCurvature1], 0.0);
  EXPECT_NE(responses[2].stress[k12], 0.0);
  EXPECT_EQ(responses[2].stress[k21], 0.0);
  EXPECT_EQ(sand.field_names().back(), "parted");
}

}  // namespace
}  // namespace polargrain::coupler
