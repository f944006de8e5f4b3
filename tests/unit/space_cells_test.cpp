// SPDX-License-Identifier: GPL-2.0-or-later
// `adaptive` and `informed` in space over cells whose law is known: the plane's materials in plane strain, the frame, the
// tolerance, and archives.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <array>
#include <cmath>
#include <cstring>
#include <iostream>
#include <random>

#include "common/memory_archive.hpp"
#include "coupler/adaptivity/adaptive_material.hpp"
#include "coupler/cells/informed_material.hpp"
#include "coupler/cells/lent_stress.hpp"
#include "fem/material/polar_decomposition.hpp"
#include "fem/material/rotation.hpp"
#include "tests/support/synthetic_sand.hpp"

namespace polargrain::coupler {
namespace {

constexpr std::array<int, 7> kPlanePlaces{0, 4, 8, 1, 3, 11, 14};

template <int dim>
fem::ElasticParameters<dim> elasticity() {
  fem::ElasticParameters<dim> elastic;
  elastic.young_modulus = 50e6;
  elastic.poisson_ratio = 0.3;
  elastic.cosserat_shear_modulus = 10e6;
  elastic.internal_length = 0.02;
  for (int i = 0; i < 3; ++i)
    elastic.initial_stress(dim == 2 ? i : 4 * i) = testing::kLateral;  // s33 of the plane too
  return elastic;
}

/// Cells in space whose grains obey a plastic law in small steps and turn with their box. Their polar decomposition is
/// their own.
struct SandInSpace {
  fem::ElastoplasticLaw<3> law{{elasticity<3>(), {}, testing::micro_strength()}};
  mutable int runs = 0;

  static PointReply<3> reply(const fem::ElastoplasticState<3>& state, const Response<3>& response) {
    PointReply<3> reply;
    reply.response = response;
    reply.response.stress.tail<9>().setZero();
    reply.response.tangent.bottomRows<9>().setZero();
    reply.response.tangent.rightCols<9>().setZero();
    const auto bytes = std::as_bytes(std::span(&state, 1));
    reply.state = std::make_shared<const State>(std::vector<std::byte>(bytes.begin(), bytes.end()));
    return reply;
  }

  PointReply<3> at_rest() const {
    const fem::ElastoplasticState<3> state = law.initial_state();
    fem::ElastoplasticState<3> end;
    return reply(state, law.integrate(state, Increment<3>{}, end));
  }

  PointReply<3> follow(const PointRequest<3>& request) const {
    ++runs;
    fem::ElastoplasticState<3> state;
    std::memcpy(static_cast<void*>(&state), request.state->bytes().data(), sizeof state);
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d f = one + request.increment.displacement_gradient;
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix3d turn = svd.matrixU() * svd.matrixV().transpose();
    const Eigen::Matrix3d strain = turn.transpose() * f - one;
    Increment<3> part;
    part.displacement_gradient = 0.5 / testing::kSubSteps * (strain + strain.transpose());
    Response<3> response;
    for (int i = 0; i < testing::kSubSteps; ++i) {
      const fem::ElastoplasticState<3> before = state;
      response = law.integrate(before, part, state);
    }
    state.scaled_stress = fem::rotated(state.scaled_stress, turn);
    return reply(state, fem::rotated<3>(response, turn));
  }

  CellCalls<3> calls() const {
    return {[this] { return at_rest(); },
            [this](std::span<const PointRequest<3>> requests, std::span<const std::size_t>) {
              std::vector<PointReply<3>> replies;
              for (const PointRequest<3>& request : requests) replies.push_back(follow(request));
              return replies;
            }};
  }
};

CosseratParameters part(bool limited) {
  CosseratParameters cosserat{50e6 / 2.6, 10e6, 0.02};
  if (limited) {
    cosserat.skew_limit = 0.5;
    cosserat.plastic_length = 4e-3;
  }
  return cosserat;
}

template <int dim>
InformedParameters<dim> informed(const CosseratParameters& cosserat, InformedUpdate update) {
  InformedParameters<dim> parameters;
  parameters.elastic = elasticity<dim>();
  parameters.plastic_length = cosserat.plastic_length;
  parameters.skew_limit = cosserat.skew_limit;
  parameters.mobilisation.cohesion = testing::kCohesion;
  parameters.mobilisation.initial_friction = 0.4;
  parameters.mismatch_limit = 10.0;
  parameters.update = update;
  return parameters;
}

template <int dim>
std::unique_ptr<fem::Material<dim>> material_of(const std::string& model, const CellCalls<dim>& calls,
                                                bool limited, double tolerance = 0.0) {
  const CosseratParameters cosserat = part(limited);
  if (model == "adaptive") {
    AdaptivityOptions options;
    options.tolerance = tolerance;
    return std::make_unique<AdaptiveMaterial<dim>>(calls, cosserat, options);
  }
  const InformedUpdate update =
      model == "informed, frozen" ? InformedUpdate::frozen : InformedUpdate::fixed_point;
  return std::make_unique<InformedMaterial<dim>>(calls, informed<dim>(cosserat, update));
}

template <int dim>
Response<dim> step(fem::Material<dim>& material, const Increment<dim>& increment) {
  std::vector<Response<dim>> responses(1);
  material.evaluate(std::vector<Increment<dim>>{increment}, responses);
  EXPECT_TRUE(material.confirm());
  material.commit();
  return responses.front();
}

/// A step of plane strain that shears, turns and bends, forth and, from the seventh on, back.
Increment<2> step_of_plane(int k, Configuration configuration) {
  Increment<2> increment;
  const double way = k < 7 ? 1.0 : -0.4;
  increment.displacement_gradient << 8e-4 * way, 1.5e-3 * way, -1e-3 * way, -2e-3 * way;
  increment.micro_rotation = -1e-3 * way + 6e-4 * (k % 3);
  increment.curvature << 0.05 * way, -0.02 * (k % 2);
  increment.configuration = configuration;
  return increment;
}

Increment<3> put_in_space(const Increment<2>& plane) {
  Increment<3> increment;
  static_cast<CellIncrement&>(increment) = increment_in_space(plane);
  increment.configuration = plane.configuration;
  return increment;
}

TEST(SpaceCells, AdaptiveInPlaneStrainIsThePlanes) {
  const SandInSpace sand;
  for (const Configuration configuration : {Configuration::fixed, Configuration::start}) {
    for (const bool limited : {false, true}) {
      const auto space = material_of<3>("adaptive", sand.calls(), limited);
      const auto plane = material_of<2>("adaptive", in_plane(sand.calls()), limited);
      space->allocate(1);
      plane->allocate(1);
      for (int k = 0; k < 12; ++k) {
        const Increment<2> increment = step_of_plane(k, configuration);
        const Response<2> b = step<2>(*plane, increment);
        const Response<3> a = step<3>(*space, put_in_space(increment));
        EXPECT_LT((Vector7(a.stress(kPlanePlaces)) - b.stress).norm(), 1e-9 * b.stress.norm())
            << "step " << k;
        EXPECT_LT((Matrix7(a.tangent(kPlanePlaces, kPlanePlaces)) - b.tangent).norm(),
                  1e-8 * b.tangent.norm())
            << "step " << k;
      }
    }
  }
}

/// The same cells with a share of their stress along e_3: spheres have another intermediate stress than the circle of a law.
CellCalls<3> with_share_of_s33(const SandInSpace& sand, double share) {
  const auto less = [share](PointReply<3> reply) {
    reply.response.stress(8) *= share;
    return reply;
  };
  return {[&sand, less] { return less(sand.at_rest()); },
          [&sand, less](std::span<const PointRequest<3>> requests, std::span<const std::size_t>) {
            std::vector<PointReply<3>> replies;
            for (const PointRequest<3>& request : requests) replies.push_back(less(sand.follow(request)));
            return replies;
          }};
}

TEST(SpaceCells, LentStressIsThePlanesAndTurnsWithTheBody) {
  Vector7 cell, law;
  cell << -300e3, -100e3, -120e3, 20e3, 20e3, 0.0, 0.0;
  law << -280e3, -110e3, -190e3, -10e3, -10e3, 0.0, 0.0;
  const auto embedded = [](const Vector7& plane) {
    Vector18 made = Vector18::Zero();
    made(kPlanePlaces) = plane;
    return made;
  };
  const Vector18 lent = with_lent_stress<3>(embedded(cell), embedded(law));
  EXPECT_LT((lent - embedded(with_lent_stress<2>(cell, law))).norm(), 1e-12 * lent.norm());
  EXPECT_DOUBLE_EQ(with_lent_stress<2>(cell, law)(k33), -190e3 / 390e3 * 400e3);
  const Eigen::Matrix3d turn = fem::rotation_by(Eigen::Vector3d(0.4, -0.7, 0.3));
  const Vector18 turned =
      with_lent_stress<3>(fem::rotated(embedded(cell), turn), fem::rotated(embedded(law), turn));
  EXPECT_LT((turned - fem::rotated(lent, turn)).norm(), 1e-12 * lent.norm());
}

// Friction is read with the intermediate stress of the law, in space as in the plane. Only in the first steps, near the isotropic
// stress of the packing, is the stress along e_3 not the intermediate one.
TEST(SpaceCells, InformedInPlaneStrainIsThePlanes) {
  const SandInSpace sand;
  for (const double share : {1.0, 0.85})
    for (const std::string model : {"informed, frozen", "informed, fixed point"}) {
      const CellCalls<3> cells = with_share_of_s33(sand, share);
      const auto space = material_of<3>(model, cells, false);
      const auto plane = material_of<2>(model, in_plane(cells), false);
      space->allocate(1);
      plane->allocate(1);
      double worst = 0.0;
      for (int k = 0; k < 12; ++k) {
        const Increment<2> increment = step_of_plane(k, Configuration::fixed);
        const Response<2> b = step<2>(*plane, increment);
        const Response<3> a = step<3>(*space, put_in_space(increment));
        worst = std::max(worst, (Vector7(a.stress(kPlanePlaces)) - b.stress).norm() / b.stress.norm());
      }
      std::cout << "[figure] " << model << ", s33 times " << share
                << ", in space against the plane: " << worst << '\n';
      EXPECT_LT(worst, 0.03) << model;
    }
}

// Each step of a body that turns besides is F' = Q_1 F Q_0^T: the stress then is Q_1 s Q_1^T.
TEST(SpaceCells, AnswersTurnWithTheBody) {
  const SandInSpace sand;
  const Eigen::Vector3d axis = Eigen::Vector3d(0.5, -0.7, 0.4).normalized();
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  for (const std::string model : {"adaptive", "informed, frozen", "informed, fixed point"}) {
    const auto straight = material_of<3>(model, sand.calls(), true);
    const auto turning = material_of<3>(model, sand.calls(), true);
    straight->allocate(1);
    turning->allocate(1);
    for (int k = 0; k < 10; ++k) {
      Eigen::Matrix3d h;
      h << 1e-3, 5e-4, -3e-4, 2e-4, 8e-4, 6e-4, -4e-4, 1e-4, -3e-3;
      const Eigen::Matrix3d before = fem::rotation_by(0.3 * k * axis);
      const Eigen::Matrix3d after = fem::rotation_by(0.3 * (k + 1) * axis);
      const auto increment_of_shape = [&](const Eigen::Matrix3d& f) {
        Increment<3> increment;
        increment.configuration = Configuration::start;
        increment.displacement_gradient = f - one;
        increment.rotation = fem::rotation_vector(increment);  // the grains turn with the box
        return increment;
      };
      const Response<3> a = step<3>(*straight, increment_of_shape(one + h));
      const Response<3> b = step<3>(*turning, increment_of_shape(after * (one + h) * before.transpose()));
      const Vector18 expected = fem::rotated(a.stress, after);
      EXPECT_LT((b.stress - expected).norm(), 1e-9 * expected.norm()) << model << " step " << k;
      const Matrix18 tangent = fem::rotated(a.tangent, after);
      EXPECT_LT((b.tangent - tangent).norm(), 1e-7 * tangent.norm()) << model << " step " << k;
    }
  }
}

/// Points whose strains lie in three bands of triaxial and of true triaxial compression, a little apart within each. The fast ones
/// yield in the first step: a first answer that is exactly elastic would teach `adaptive` that nothing departs from its tangent.
std::vector<Increment<3>> three_bands(std::size_t points, std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::vector<Increment<3>> increments(points);
  for (std::size_t p = 0; p < points; ++p) {
    const double size = p % 3 == 0 ? 3e-3 : p % 3 == 1 ? 1e-3 : 5e-6;
    Eigen::Vector3d strain(0.4, p % 2 == 0 ? 0.4 : -0.1, -1.0);
    for (int i = 0; i < 3; ++i) strain(i) *= 1.0 + 0.01 * normal(random);
    increments[p].displacement_gradient = size * strain.asDiagonal();
  }
  return increments;
}

TEST(SpaceCells, AdaptiveKeepsItsToleranceWithFewerRuns) {
  constexpr std::size_t kPoints = 60;
  constexpr int kSteps = 12;
  constexpr double kTolerance = 0.03;
  const SandInSpace sand;
  const SandInSpace exact;
  const auto sharing = material_of<3>("adaptive", sand.calls(), false, kTolerance);
  const auto whole = material_of<3>("adaptive", exact.calls(), false);
  sharing->allocate(kPoints);
  whole->allocate(kPoints);
  std::mt19937 random(3);
  double worst = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const std::vector<Increment<3>> increments = three_bands(kPoints, random);
    std::vector<Response<3>> a(kPoints), b(kPoints);
    whole->evaluate(increments, b);
    ASSERT_TRUE(whole->confirm());
    whole->commit();
    sharing->evaluate(increments, a);
    for (int asked = 0; !sharing->confirm() && asked < 5; ++asked) sharing->evaluate(increments, a);
    sharing->commit();
    double sum = 0.0;
    for (std::size_t p = 0; p < kPoints; ++p)
      sum += GrainMeasure<3>().stress(a[p].stress - b[p].stress) / -testing::kLateral;
    worst = std::max(worst, sum / kPoints);
  }
  std::cout << "[figure] mean error at most " << worst << ", runs " << sand.runs << " of " << exact.runs
            << '\n';
  EXPECT_LT(worst, kTolerance);
  EXPECT_LT(sand.runs, 0.6 * exact.runs);
}

TEST(SpaceCells, GoOnFromAnArchiveToTheSameBits) {
  const SandInSpace sand;
  std::mt19937 random(5);
  std::vector<std::vector<Increment<3>>> steps;
  for (int k = 0; k < 8; ++k) steps.push_back(three_bands(12, random));
  for (const std::string model : {"adaptive", "informed, frozen", "informed, fixed point"}) {
    const auto whole = material_of<3>(model, sand.calls(), true, 0.03);
    const auto resumed = material_of<3>(model, sand.calls(), true, 0.03);
    whole->allocate(12);
    resumed->allocate(12);
    const auto go = [&](fem::Material<3>& material, int k) {
      std::vector<Response<3>> responses(12);
      material.evaluate(steps[static_cast<std::size_t>(k)], responses);
      for (int asked = 0; !material.confirm() && asked < 5; ++asked)
        material.evaluate(steps[static_cast<std::size_t>(k)], responses);
      material.commit();
      return responses;
    };
    for (int k = 0; k < 4; ++k) go(*whole, k);
    MemoryArchive archive;
    whole->save(archive);
    resumed->restore(archive);
    for (int k = 4; k < 8; ++k) {
      const std::vector<Response<3>> a = go(*whole, k);
      const std::vector<Response<3>> b = go(*resumed, k);
      for (std::size_t p = 0; p < a.size(); ++p) EXPECT_EQ(a[p].stress, b[p].stress) << model << ' ' << p;
    }
  }
}

}  // namespace
}  // namespace polargrain::coupler
