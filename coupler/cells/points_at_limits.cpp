// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/points_at_limits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/error.hpp"

namespace polargrain::coupler {
namespace {

struct Kind {
  const char* name;
  bool LimitsReached::*flag;
  const char* words;
};
constexpr std::array<Kind, 4> kKinds{
    {{"points_parted", &LimitsReached::parted, "have grains that have parted"},
     {"at_skew_limit", &LimitsReached::skew, "carry the largest skew stress that their grains bear"},
     {"at_couple_limit", &LimitsReached::couple, "carry the largest couple stress"},
     {"rotation_held", &LimitsReached::held, "have a micro-rotation that is held numerically"}}};

}  // namespace

void PointsAtLimits::count(const std::vector<LimitsReached>& points) {
  points_ = static_cast<std::int64_t>(points.size());
  for (std::size_t k = 0; k < now_.size(); ++k) {
    now_[k] =
        std::ranges::count_if(points, [&](const LimitsReached& point) { return point.*kKinds[k].flag; });
    most_[k] = std::max(most_[k], now_[k]);
  }
}

std::vector<fem::Figure> PointsAtLimits::figures() const {
  std::vector<fem::Figure> figures;
  for (std::size_t k = 0; k < (has_part_ ? now_.size() : 1); ++k) {
    figures.push_back({kKinds[k].name, static_cast<double>(now_[k])});
    figures.push_back({std::string(kKinds[k].name) + "_most", static_cast<double>(most_[k])});
  }
  return figures;
}

std::string PointsAtLimits::text() const {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < now_.size(); ++k) {
    if (most_[k] > 0) parts.push_back(fmt::format("{} {} (at most {})", now_[k], kKinds[k].words, most_[k]));
  }
  if (parts.empty()) return {};
  return fmt::format("of {} points at the end (in any step): {}", points_, fmt::join(parts, "; "));
}

void PointsAtLimits::save(ArchiveWriter& archive) const {
  std::vector<std::int64_t> counts{points_};
  counts.insert(counts.end(), now_.begin(), now_.end());
  counts.insert(counts.end(), most_.begin(), most_.end());
  archive.write("points_at_limits", std::span<const std::int64_t>(counts));
}

void PointsAtLimits::restore(ArchiveReader& archive) {
  const std::vector<std::int64_t> counts = archive.integers("points_at_limits");
  if (counts.size() != 1 + now_.size() + most_.size())
    throw RunError("'points_at_limits' does not hold the counts of a material");
  points_ = counts.front();
  std::copy_n(counts.begin() + 1, now_.size(), now_.begin());
  std::copy_n(counts.begin() + 1 + static_cast<std::ptrdiff_t>(now_.size()), most_.size(), most_.begin());
}

std::vector<std::string> names_of_limit_fields(bool has_part) {
  if (!has_part) return {"parted"};
  return {"parted", "skew_mobilisation", "couple_mobilisation"};
}

template <int dim>
void write_limit_fields(const LimitsReached& reached, const std::optional<CosseratParameters>& cosserat,
                        const CosseratPart<dim>& part, std::span<double>::iterator to) {
  *to++ = reached.parted ? 1.0 : 0.0;
  if (!cosserat) return;
  *to++ = part.skew_mobilisation(*cosserat);
  *to++ = part.couple_mobilisation(*cosserat);
}

template void write_limit_fields(const LimitsReached&, const std::optional<CosseratParameters>&,
                                 const CosseratPart<2>&, std::span<double>::iterator);
template void write_limit_fields(const LimitsReached&, const std::optional<CosseratParameters>&,
                                 const CosseratPart<3>&, std::span<double>::iterator);

}  // namespace polargrain::coupler
