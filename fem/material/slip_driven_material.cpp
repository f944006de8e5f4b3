// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/slip_driven_material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/packed_values.hpp"
#include "fem/material/rotation.hpp"

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
template <int dim>
constexpr std::size_t kKeptOfSlips = 4 * Cosserat<dim>::components + 6;

template <int dim>
using VectorOf = typename Cosserat<dim>::Vector;

template <int dim>
double norm_of_stress(const VectorOf<dim>& stress) {
  return stress.template head<Cosserat<dim>::stresses>().norm();
}

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
Vector18 deviator_direction(const Vector18& tensor, double least) {
  using Space = Cosserat<3>;
  Vector18 direction = Vector18::Zero();
  const double mean = (tensor(Space::stress_place(0, 0)) + tensor(Space::stress_place(1, 1)) +
                       tensor(Space::stress_place(2, 2))) /
                      3.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      direction(Space::stress_place(i, j)) =
          0.5 * (tensor(Space::stress_place(i, j)) + tensor(Space::stress_place(j, i))) -
          (i == j ? mean : 0.0);
  const double shear = std::sqrt(0.5) * direction.norm();
  if (!(shear > least)) return Vector18::Zero();
  return direction / (2.0 * shear);
}

/// Half the trace in the plane, a third in space.
template <int dim>
double mean_of_trace(const VectorOf<dim>& tensor) {
  double sum = 0.0;
  for (int i = 0; i < dim; ++i) sum += tensor(Cosserat<dim>::stress_place(i, i));
  return sum / dim;
}

/// @param strain since the start @returns n, or zero where it is not known
template <int dim>
VectorOf<dim> direction_of_slip(const VectorOf<dim>& stress, const VectorOf<dim>& strain) {
  const VectorOf<dim> of_stress =
      deviator_direction(stress, kLeastDeviator * std::abs(mean_of_trace<dim>(stress)));
  const VectorOf<dim> of_strain = deviator_direction(strain, 0.0);
  return of_stress.dot(of_strain) > kNear ? of_strain : of_stress;
}

/// The shear modulus of a tangent, the mean over all directions.
double shear_modulus(const Matrix7& tangent) {
  double sum = 0.0;
  for (const Vector7& direction : {shear_direction(1.0, 0.0), shear_direction(0.0, 1.0)})
    sum += 0.5 * direction.dot(tangent * direction);
  return sum;
}
double shear_modulus(const Matrix18& tangent) {
  using Space = Cosserat<3>;
  double sum = 0.0;  // of n:C:n over five directions, each at right angles to the others
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    Vector18 direction = Vector18::Zero();
    direction(Space::stress_place(i, j)) = direction(Space::stress_place(j, i)) = 0.5;
    sum += direction.dot(tangent * direction);
    direction.setZero();
    // Two thirds of the sum over the three differences of axes is that over two directions.
    direction(Space::stress_place(i, i)) = 0.5;
    direction(Space::stress_place(j, j)) = -0.5;
    sum += 2.0 / 3.0 * direction.dot(tangent * direction);
  }
  return sum / 5.0;
}

}  // namespace

template <int dim>
SlipDrivenMaterial<dim>::SlipDrivenMaterial(std::shared_ptr<Material<dim>> material)
    : material_(std::move(material)) {}

template <int dim>
void SlipDrivenMaterial<dim>::allocate(std::size_t points) {
  material_->allocate(points);
  committed_.assign(points, {});
  trial_ = committed_;
  answers_.assign(points, {});
  trial_answers_ = answers_;
  slips_.assign(points, 0.0);
  is_at_rest_ = true;
}

template <int dim>
void SlipDrivenMaterial<dim>::set_initial_stress(std::size_t point, const Vector& stress) {
  material_->set_initial_stress(point, stress);
}

template <int dim>
void SlipDrivenMaterial<dim>::set_slips(std::span<const double> increments) {
  std::ranges::copy(increments, slips_.begin());
}

template <int dim>
double SlipDrivenMaterial<dim>::slip_stiffness() const {
  double largest = 0.0;
  for (const State& state : trial_) largest = std::max(largest, state.stiffness);
  return kShear * kShear * largest;
}

template <int dim>
void SlipDrivenMaterial<dim>::evaluate(std::span<const Increment<dim>> increments,
                                       std::span<Response<dim>> responses) {
  if (asked_.empty()) {
    material_->evaluate(increments, responses);
    if (is_explicit_) asked_.assign(responses.begin(), responses.end());
  } else {
    std::ranges::copy(asked_, responses.begin());
  }
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    trial_[point] = committed_[point];
    trial_answers_[point] = answers_[point];
    if (responses[point].quality == Quality::failed) continue;
    if (is_at_rest_) {
      committed_[point].stress = trial_[point].stress = responses[point].stress;
      committed_[point].stiffness = trial_[point].stiffness = shear_modulus(responses[point].tangent);
    }
    const StretchAndTurn<dim> step = stretch_and_turn(increments[point]);
    State start = committed_[point];
    Vector strain = step.stretch.strain();
    if (increments[point].configuration != Configuration::fixed)
      for (Vector* const turned : {&start.stress, &start.strain, &strain})
        *turned = rotated(*turned, step.turn);
    answer(point, start, strain, responses[point]);
  }
  is_at_rest_ = false;
}

template <int dim>
void SlipDrivenMaterial<dim>::answer(std::size_t point, const State& start, const Vector& strain,
                                     Response<dim>& response) {
  State& end = trial_[point];
  SlipAnswer<dim>& answer = trial_answers_[point];
  const double slip = slips_[point], stiffness = start.stiffness;
  const Vector direction = direction_of_slip<dim>(start.stress, start.strain);
  end.stress = response.stress;
  end.strain = start.strain + strain;
  end.slip = start.slip + slip;
  answer = {};
  if (direction.isZero(0.0)) {
    end.overstress = 0.0;
    answer.scale = kShear * norm_of_stress<dim>(response.stress);
    return;
  }
  const double own = direction.dot(response.stress);
  const double elastic = stiffness * (2.0 * direction.dot(strain) - kShear * slip);  // growth of n:T
  end.overstress = start.overstress + elastic - (own - direction.dot(start.stress));
  const Vector overstress_by_strain = 2.0 * stiffness * direction - response.tangent.transpose() * direction;
  answer.drive = kShear * (end.overstress - kRoundingOfSlip * norm_of_stress<dim>(start.stress));
  answer.scale = kShear * (std::abs(own) + std::abs(own + end.overstress));
  answer.drive_by_strain = kShear * overstress_by_strain;
  answer.drive_by_slip = -kShear * kShear * stiffness;
  answer.stress_by_slip = -2.0 * kShear * stiffness * direction;
  const Vector overstress = 2.0 * end.overstress * direction;
  if (is_explicit_)
    response.stress += kDampingOfSteps * (response.stress - start.stress +
                                          2.0 * (end.overstress - start.overstress) * direction);
  response.stress += overstress;
  response.tangent += 2.0 * direction * overstress_by_strain.transpose();
}

template <int dim>
void SlipDrivenMaterial<dim>::commit() {
  material_->commit();
  committed_ = trial_;
  answers_ = trial_answers_;
  asked_.clear();
  std::ranges::fill(slips_, 0.0);
}

template <int dim>
void SlipDrivenMaterial<dim>::revert() {
  material_->revert();
  trial_ = committed_;
  trial_answers_ = answers_;
  asked_.clear();
  std::ranges::fill(slips_, 0.0);
}

template <int dim>
void SlipDrivenMaterial<dim>::save(ArchiveWriter& archive) const {
  std::vector<double> values;
  values.reserve(committed_.size() * kKeptOfSlips<dim>);
  const auto add = [&](const auto& vector) { values.insert(values.end(), vector.begin(), vector.end()); };
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    const State& state = committed_[point];
    const SlipAnswer<dim>& answer = answers_[point];
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

template <int dim>
void SlipDrivenMaterial<dim>::restore(ArchiveReader& archive) {
  const std::vector<double> values = read_lists(archive, "slips", committed_.size(), kKeptOfSlips<dim>);
  auto next = values.begin();
  const auto take = [&](auto& vector) {
    for (double& value : vector) value = *next++;
  };
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    State& state = committed_[point];
    SlipAnswer<dim>& answer = answers_[point];
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

template <int dim>
std::vector<std::string> SlipDrivenMaterial<dim>::field_names() const {
  std::vector<std::string> names = material_->field_names();
  names.insert(names.end(), {"given_slip", "drive"});
  return names;
}

template <int dim>
void SlipDrivenMaterial<dim>::fields(std::size_t point, std::span<double> values) const {
  const std::size_t own = values.size() - 2;
  material_->fields(point, values.first(own));
  values[own] = committed_[point].slip;
  values[own + 1] = answers_[point].scale > 0.0 ? answers_[point].drive / answers_[point].scale : 0.0;
}

template class SlipDrivenMaterial<2>;
template class SlipDrivenMaterial<3>;

}  // namespace polargrain::fem
