// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/ground_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "common/error.hpp"
#include "coupler/cells/cell_increment.hpp"
#include "coupler/cells/cell_noise.hpp"
#include "element/stiffness.hpp"

namespace polargrain::coupler {
namespace {

/// Below this share of the packing's stress no box is led: its contacts are hardly touched there.
constexpr double kLeastShare = 0.01;
/// A box is at its stress within so much of it, or within its noise.
constexpr double kMet = 1e-4;
constexpr int kCorrections = 3;
/// A strain of a correction; more would leave the tangent.
constexpr double kLongest = 1e-3;
/// Depths whose stresses differ by less are one.
constexpr double kSameDepth = 1e-9;
constexpr double kSameRatio = 1e-9;
/// A stress further off is told.
constexpr double kFarOff = 0.02;

/// A stress to be met by the box of points of one depth.
struct Depth {
  double vertical;  ///< Pa
  CellReply box = {};
  double off = 0.0;
  bool is_done = false;
};

/// In the order of element::Place.
element::Vector6 in_places(const Vector7& s) {
  element::Vector6 stress = element::Vector6::Zero();
  stress.head<4>() << s(k11), s(k22), s(k33), 0.5 * (s(k12) + s(k21));
  return stress;
}
element::Vector6 in_places(const Vector18& s) {
  return element::six(Eigen::Map<const Eigen::Matrix3d>(s.data()));  // of the symmetric part, so in any order
}

double noise_of(const CellReply& box) {
  return coupler::noise_of<2>(in_plane(box), 0.0).symmetric;
}

/// Leads the boxes to their stresses, all at once. An answer that is no nearer is dropped, and the box stays.
template <int dim>
void correct(const CellCalls<dim>& calls, const GroundPath& path, std::vector<Depth>& depths) {
  for (int round = 0; round < kCorrections; ++round) {
    std::vector<CellRequest> requests;
    std::vector<std::size_t> asking;
    for (std::size_t d = 0; d < depths.size(); ++d) {
      Depth& depth = depths[d];
      depth.off = path.off(element::six(depth.box.response.stress), depth.vertical);
      if (depth.is_done || depth.off <= std::max(kMet * depth.vertical, noise_of(depth.box))) continue;
      element::Vector6 strain = path.strain_to(depth.box.response, depth.vertical, false);
      if (const double longest = strain.cwiseAbs().maxCoeff(); longest > kLongest)
        strain *= kLongest / longest;
      requests.push_back({depth.box.state, element::increment_over(element::gradient_of(strain))});
      asking.push_back(d);
    }
    if (requests.empty()) return;
    std::vector<CellReply> replies = calls.ask_boxes(requests, asking);
    for (std::size_t k = 0; k < asking.size(); ++k) {
      Depth& depth = depths[asking[k]];
      const double off = path.off(element::six(replies[k].response.stress), depth.vertical);
      depth.is_done = replies[k].response.quality != Quality::good || !(off < depth.off);
      if (depth.is_done) continue;
      depth.box = std::move(replies[k]);
      depth.off = off;
    }
  }
}

}  // namespace

template <int dim>
void GroundStart<dim>::set(std::size_t point, const Vector& stress) {
  const auto normal = [&stress](int i) { return stress(Cosserat<dim>::stress_place(i, i)); };
  if (vertical_.size() <= point) vertical_.resize(point + 1, 0.0);
  vertical_[point] = std::max(0.0, -normal(dim - 1));
  const double ratio = normal(0) / normal(dim - 1);
  if (std::isnan(ratio)) return;  // measured, or without stress
  if (!ratio_) ratio_ = ratio;
  if (std::abs(ratio - *ratio_) > kSameRatio)
    throw RunError(fmt::format(
        "the boxes of one region are to begin with K0 of {:.4g} and of {:.4g}; give the parts names of their own",
        *ratio_, ratio));
}

template <int dim>
void GroundStart<dim>::lead(const CellCalls<dim>& calls) {
  is_done_ = true;
  const CellReply packing = calls.initial_box();
  path_ = {packing.response.known == KnownComponents::all ? element::Room::space : element::Room::discs, kUp,
           ratio_};
  const double own = vertical_stress(packing.response, kUp);
  if (!(own > 0.0))
    throw RunError("boxes that begin under the weight of the ground need a packing under pressure");
  const double largest = *std::ranges::max_element(vertical_);
  const double least = std::max(*std::ranges::min_element(vertical_), kLeastShare * own);
  const AskCell ask = [&calls](const CellRequest& request) {
    const std::size_t point = 0;
    return calls.ask_boxes({&request, 1}, {&point, 1}).front();
  };
  levels_ = stress_levels(ask, packing, path_, least, largest);
  report_.levels = static_cast<double>(levels_.boxes.size());
  report_.lowest = vertical_stress(levels_.boxes.front().response, kUp);
  report_.least_ratio = HUGE_VAL;
  for (const double vertical : vertical_) {
    const double ratio = path_.ratio_of(levels_.boxes[levels_.nearest(reached(vertical), kUp)].response);
    report_.least_ratio = std::min(report_.least_ratio, ratio);
    report_.largest_ratio = std::max(report_.largest_ratio, ratio);
    if (vertical < (1.0 - kFarOff) * report_.lowest) report_.above_table += 1.0;
  }
}

template <int dim>
double GroundStart<dim>::reached(double vertical) const {
  const double lowest = vertical_stress(levels_.boxes.front().response, kUp);
  return vertical >= (1.0 - kFarOff) * lowest ? vertical : lowest;
}

template <int dim>
std::size_t GroundStart<dim>::level_of(std::size_t point) const {
  return levels_.nearest(reached(vertical_[point]), kUp);
}

template <int dim>
Increment<dim> GroundStart<dim>::offset_of(std::size_t point) const {
  const element::Vector6 strain =
      path_.strain_to(levels_.boxes[level_of(point)].response, reached(vertical_[point]), dim == 2);
  const Eigen::Matrix3d h = element::gradient_of(strain);
  Increment<dim> offset;
  offset.displacement_gradient = (0.5 * (h + h.transpose())).eval().template topLeftCorner<dim, dim>();
  return offset;
}

template <int dim>
std::vector<CellReply> GroundStart<dim>::boxes(const CellCalls<dim>& calls,
                                               std::span<const std::size_t> points) const {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return vertical_[points[k]]; });
  std::vector<Depth> depths;
  std::vector<std::size_t> depth_of(points.size());
  for (const std::size_t k : order) {
    const double vertical = reached(vertical_[points[k]]);
    if (depths.empty() || vertical > (1.0 + kSameDepth) * depths.back().vertical) {
      depths.push_back({vertical});
      depths.back().box = levels_.boxes[levels_.nearest(vertical, kUp)];
    }
    depth_of[k] = depths.size() - 1;
  }
  correct(calls, path_, depths);
  std::vector<CellReply> boxes;
  for (std::size_t k = 0; k < points.size(); ++k) boxes.push_back(depths[depth_of[k]].box);
  return boxes;
}

template <int dim>
void GroundStart<dim>::judge(std::size_t point, const Vector& stress) {
  const double vertical = vertical_[point];
  const double off = path_.off(in_places(stress), vertical);
  report_.off = std::max(report_.off, off);
  if (vertical >= (1.0 - kFarOff) * report_.lowest)
    report_.off_share = std::max(report_.off_share, off / vertical);
}

template <int dim>
void GroundStart<dim>::add_figures(std::vector<fem::Figure>& figures) const {
  if (empty()) return;
  figures.insert(figures.end(), {{"start_levels", report_.levels},
                                 {"start_K0_least", report_.least_ratio},
                                 {"start_K0_largest", report_.largest_ratio},
                                 {"start_stress_off", report_.off},
                                 {"start_stress_off_share", report_.off_share},
                                 {"start_points_above_table", report_.above_table}});
}

template <int dim>
std::vector<std::string> GroundStart<dim>::notes() const {
  std::vector<std::string> notes;
  if (report_.above_table > 0.0)
    notes.push_back(fmt::format(
        "{:.0f} points near the surface begin under {:.4g} kPa, more than the weight above them: the packing has been led no "
        "lower{}; step 0 lets the difference go. A packing of less pressure goes lower, or give a surcharge",
        report_.above_table, 1e-3 * report_.lowest,
        levels_.end_below.empty() ? std::string() : fmt::format(" ({})", levels_.end_below)));
  if (report_.off_share > kFarOff)
    notes.push_back(fmt::format(
        "the stress of a box at the start is up to {:.3g} % of its vertical stress off that of its depth; step 0 lets the "
        "difference go",
        100.0 * report_.off_share));
  return notes;
}

template <int dim>
void GroundStart<dim>::save(ArchiveWriter& archive) const {
  if (empty()) return;
  const std::array<double, 7> kept{report_.levels,    report_.least_ratio, report_.largest_ratio, report_.off,
                                   report_.off_share, report_.above_table, report_.lowest};
  archive.write("ground_start", std::span<const double>(kept));
}

template <int dim>
void GroundStart<dim>::restore(ArchiveReader& archive) {
  is_done_ = true;
  if (empty()) return;
  const std::vector<double> kept = archive.doubles("ground_start");
  if (kept.size() != 7) throw RunError("'ground_start' does not hold the start of a material");
  report_ = {kept[0], kept[1], kept[2], kept[3], kept[4], kept[5], kept[6]};
}

template class GroundStart<2>;
template class GroundStart<3>;

}  // namespace polargrain::coupler
