// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cell_material.hpp"

#include <fmt/format.h>

#include "common/error.hpp"

namespace polargrain::coupler {
namespace {

bool is_zero(const Increment& increment) {
  return increment.displacement_gradient.isZero(0.0) && increment.micro_rotation == 0.0 &&
         increment.curvature.isZero(0.0);
}

/// The tangent of the symmetric stress with respect to the Cosserat strain: mean of the two shear rows, and,
/// because the cell feels eps12 and eps21 through their sum alone, mean of the two shear columns.
Matrix7 symmetrised(const Matrix7& cell) {
  Matrix7 tangent = Matrix7::Zero();
  tangent.topLeftCorner<5, 5>() = cell.topLeftCorner<5, 5>();
  const Vector7 row = 0.5 * (tangent.row(k12) + tangent.row(k21)).transpose();
  tangent.row(k12) = tangent.row(k21) = row.transpose();
  const Vector7 column = 0.5 * (tangent.col(k12) + tangent.col(k21));
  tangent.col(k12) = tangent.col(k21) = column;
  return tangent;
}

}  // namespace

CellMaterial::CellMaterial(Pool& pool, std::uint32_t definition, const CosseratParameters& cosserat)
    : pool_(pool), definition_(definition), cosserat_(cosserat) {}

void CellMaterial::allocate(std::size_t points) {
  PointState start;
  start.cell = pool_.initial(definition_);
  if (start.cell.response.quality == Quality::failed) {
    throw RunError(
        fmt::format("the packing of a cell cannot be brought to rest: {}", start.cell.response.message));
  }
  committed_.assign(points, start);
  trial_ = committed_;
}

void CellMaterial::evaluate(std::span<const Increment> increments, std::span<Response> responses) {
  std::vector<PoolRequest> requests;
  std::vector<std::size_t> points;
  for (std::size_t point = 0; point < committed_.size(); ++point) {
    trial_[point] = committed_[point];
    if (is_zero(increments[point])) continue;
    requests.push_back({definition_, {committed_[point].cell.state, increments[point]}});
    points.push_back(point);
  }
  std::vector<CellReply> replies = pool_.evaluate(requests);
  for (std::size_t r = 0; r < replies.size(); ++r) {
    PointState& point = trial_[points[r]];
    point.cell = std::move(replies[r]);
    accumulate(increments[points[r]], point);
  }
  for (std::size_t point = 0; point < committed_.size(); ++point) responses[point] = combined(trial_[point]);
}

void CellMaterial::accumulate(const Increment& increment, PointState& point) const {
  const Vector7 strain = increment.strain();
  const double couple_modulus =
      2.0 * cosserat_.shear_modulus * cosserat_.internal_length * cosserat_.internal_length;
  point.skew_stress += 2.0 * cosserat_.cosserat_shear_modulus * (strain[k21] - strain[k12]);  // A.4
  point.couple_stress += couple_modulus * increment.curvature;                                // A.4
}

Response CellMaterial::combined(const PointState& point) const {
  Response response = point.cell.response;
  if (response.quality == Quality::failed) return response;
  const double symmetric_shear = 0.5 * (response.stress[k12] + response.stress[k21]);
  response.stress[k12] = symmetric_shear - 0.5 * point.skew_stress;
  response.stress[k21] = symmetric_shear + 0.5 * point.skew_stress;
  response.stress.tail<2>() = point.couple_stress;
  response.tangent = symmetrised(response.tangent);
  const double skew_modulus = cosserat_.cosserat_shear_modulus;
  response.tangent(k12, k12) += skew_modulus;
  response.tangent(k21, k21) += skew_modulus;
  response.tangent(k12, k21) -= skew_modulus;
  response.tangent(k21, k12) -= skew_modulus;
  const double couple_modulus =
      2.0 * cosserat_.shear_modulus * cosserat_.internal_length * cosserat_.internal_length;
  response.tangent(kCurvature1, kCurvature1) = couple_modulus;
  response.tangent(kCurvature2, kCurvature2) = couple_modulus;
  return response;
}

std::vector<std::string> CellMaterial::field_names() const {
  return {"void_ratio", "coordination_number", "unbalanced_force_ratio", "sliding_fraction", "dem_steps"};
}

void CellMaterial::fields(std::size_t point, std::span<double> values) const {
  const CellDiagnostics& d = committed_[point].cell.diagnostics;
  values[0] = d.void_ratio;
  values[1] = d.coordination_number;
  values[2] = d.unbalanced_force_ratio;
  values[3] = d.sliding_fraction;
  values[4] = static_cast<double>(d.dem_steps);
}

}  // namespace polargrain::coupler
