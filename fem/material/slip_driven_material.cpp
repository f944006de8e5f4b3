// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/slip_driven_material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/packed_values.hpp"

namespace polargrain::fem {
namespace {

/// Shear over slip and drive over overstress: the slip is the multiplier of q, as that of a cone is.
const double kShear = std::sqrt(3.0);

/// Of the mean stress: a packing that was pressed alike from all sides has a deviator of some hundredths, without a meaning.
constexpr double kLeastDeviator = 0.1;
/// n:n' of the directions of stress and strain from which on slips go along the strain: half the cosine of 45 degrees.
constexpr double kNear = 0.35;
/// Of the stress: an overstress that grains must have to slip. An elastic body would else slip by what its stress rounds.
constexpr double kRoundingOfSlip = 1e-6;
/// Numbers that a checkpoint keeps of a point: stress, strain and two vectors; overstress, slip, stiffness, drive, its scale, a derivative.
constexpr std::size_t kKeptInPlane = 4 * Cosserat<2>::components + 6;

/// A direction of shear in the plane, n:n = 1/2, so that n:s is a shear stress and 2 n:eps a shear.
Vector7 shear_direction(double difference, double mixed) {
  Vector7 direction = Vector7::Zero();
  direction << 0.5 * difference, -0.5 * difference, 0.0, 0.5 * mixed, 0.5 * mixed, 0.0, 0.0;
  return direction;
}

/// The direction of the deviator of a stress or strain; zero where it is at most `least`.
Vector7 deviator_direction(const Vector7& tensor, double least) {
  const double difference = 0.5 * (tensor(k11) - tensor(k22)), mixed = 0.5 * (tensor(k12) + tensor(k21));
  const double shear = std::hypot(difference, mixed);
  if (!(shear > least)) return Vector7::Zero();
  return shear_direction(difference / shear, mixed / shear);
}

/// @param strain since the start @returns n, or zero where it is not known
Vector7 direction_of_slip(const Vector7& stress, const Vector7& strain) {
  const Vector7 of_stress =
      deviator_direction(stress, kLeastDeviator * 0.5 * std::abs(stress(k11) + stress(k22)));
  const Vector7 of_strain = deviator_direction(strain, 0.0);
  return of_stress.dot(of_strain) > kNear ? of_strain : of_stress;
}

/// The shear modulus of a tangent, the mean over all directions.
double shear_modulus(const Matrix7& tangent) {
  double sum = 0.0;
  for (const Vector7& direction : {shear_direction(1.0, 0.0), shear_direction(0.0, 1.0)})
    sum += 0.5 * direction.dot(tangent * direction);
  return sum;
}

}  // namespace

SlipDrivenMaterial::SlipDrivenMaterial(std::shared_ptr<Material<2>> material)
    : material_(std::move(material)) {}

void SlipDrivenMaterial::allocate(std::size_t points) {
  material_->allocate(points);
  committed_.assign(points, {});
  trial_ = committed_;
  answers_.assign(points, {});
  trial_answers_ = answers_;
  slips_.assign(points, 0.0);
  is_at_rest_ = true;
}

void SlipDrivenMaterial::set_initial_stress(std::size_t point, const Vector7& stress) {
  material_->set_initial_stress(point, stress);
}

void SlipDrivenMaterial::set_slips(std::span<const double> increments) {
  std::ranges::copy(increments, slips_.begin());
}

double SlipDrivenMaterial::slip_stiffness() const {
  double largest = 0.0;
  for (const State& state : trial_) largest = std::max(largest, state.stiffness);
  return kShear * kShear * largest;
}

void SlipDrivenMaterial::evaluate(std::span<const Increment<2>> increments,
                                  std::span<Response<2>> responses) {
  material_->evaluate(increments, responses);
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    trial_[point] = committed_[point];
    trial_answers_[point] = answers_[point];
    if (responses[point].quality == Quality::failed) continue;
    if (is_at_rest_) {
      committed_[point].stress = trial_[point].stress = responses[point].stress;
      committed_[point].stiffness = trial_[point].stiffness = shear_modulus(responses[point].tangent);
    }
    answer(point, increments[point].strain(), responses[point]);
  }
  is_at_rest_ = false;
}

void SlipDrivenMaterial::answer(std::size_t point, const Vector7& strain, Response<2>& response) {
  const State& start = committed_[point];
  State& end = trial_[point];
  SlipAnswer<2>& answer = trial_answers_[point];
  const double slip = slips_[point], stiffness = start.stiffness;
  const Vector7 direction = direction_of_slip(start.stress, start.strain);
  end.stress = response.stress;
  end.strain = start.strain + strain;
  end.slip = start.slip + slip;
  answer = {};
  if (direction.isZero(0.0)) {
    end.overstress = 0.0;
    answer.scale = kShear * response.stress.head<Cosserat<2>::stresses>().norm();
    return;
  }
  const double own = direction.dot(response.stress);
  end.overstress = start.overstress + stiffness * (2.0 * direction.dot(strain) - kShear * slip) -
                   (own - direction.dot(start.stress));
  const Vector7 overstress_by_strain = 2.0 * stiffness * direction - response.tangent.transpose() * direction;
  answer.drive =
      kShear * (end.overstress - kRoundingOfSlip * start.stress.head<Cosserat<2>::stresses>().norm());
  answer.scale = kShear * (std::abs(own) + std::abs(own + end.overstress));
  answer.drive_by_strain = kShear * overstress_by_strain;
  answer.drive_by_slip = -kShear * kShear * stiffness;
  answer.stress_by_slip = -2.0 * kShear * stiffness * direction;
  response.stress += 2.0 * end.overstress * direction;
  response.tangent += 2.0 * direction * overstress_by_strain.transpose();
}

void SlipDrivenMaterial::commit() {
  material_->commit();
  committed_ = trial_;
  answers_ = trial_answers_;
  std::ranges::fill(slips_, 0.0);
}

void SlipDrivenMaterial::revert() {
  material_->revert();
  trial_ = committed_;
  trial_answers_ = answers_;
  std::ranges::fill(slips_, 0.0);
}

void SlipDrivenMaterial::save(ArchiveWriter& archive) const {
  std::vector<double> values;
  values.reserve(committed_.size() * kKeptInPlane);
  const auto add = [&](const auto& vector) { values.insert(values.end(), vector.begin(), vector.end()); };
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    const State& state = committed_[point];
    const SlipAnswer<2>& answer = answers_[point];
    add(state.stress);
    add(state.strain);
    add(answer.stress_by_slip);
    add(answer.drive_by_strain);
    add(std::array{state.overstress, state.slip, state.stiffness, answer.drive, answer.scale,
                   answer.drive_by_slip});
  }
  archive.write("slips", std::span<const double>(values));
  material_->save(archive);
}

void SlipDrivenMaterial::restore(ArchiveReader& archive) {
  const std::vector<double> values = read_lists(archive, "slips", committed_.size(), kKeptInPlane);
  auto next = values.begin();
  const auto take = [&](auto& vector) {
    for (double& value : vector) value = *next++;
  };
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    State& state = committed_[point];
    SlipAnswer<2>& answer = answers_[point];
    take(state.stress);
    take(state.strain);
    take(answer.stress_by_slip);
    take(answer.drive_by_strain);
    for (double* value : {&state.overstress, &state.slip, &state.stiffness, &answer.drive, &answer.scale,
                          &answer.drive_by_slip})
      *value = *next++;
  }
  is_at_rest_ = false;
  material_->restore(archive);
  revert();
}

std::vector<std::string> SlipDrivenMaterial::field_names() const {
  std::vector<std::string> names = material_->field_names();
  names.insert(names.end(), {"given_slip", "drive"});
  return names;
}

void SlipDrivenMaterial::fields(std::size_t point, std::span<double> values) const {
  const std::size_t own = values.size() - 2;
  material_->fields(point, values.first(own));
  values[own] = committed_[point].slip;
  values[own + 1] = answers_[point].scale > 0.0 ? answers_[point].drive / answers_[point].scale : 0.0;
}

}  // namespace polargrain::fem
