// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/sphere_loop/sphere_list.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "dem/box/lost_grains.hpp"
#include "dem/contact/points_up.hpp"

namespace polargrain::dem {

namespace {

/// The spheres of a periodic box in bins that divide it evenly along its base vectors, as wide as the reach or wider
/// where the box allows, with copies of those near its faces all around: neighbours stand in bins side by side.
class BinsOfSpheres {
 public:
  /// A sphere, or a copy of one in another copy of the box.
  struct Members {
    std::vector<double> x, y, z, radius;  // m
    std::vector<int> sphere;
    std::vector<SpaceLattice> copy;  // in which the folded sphere is seen
  };

  BinsOfSpheres(const double* rows, int grains, const Eigen::Matrix3d& base, double reach) : base_(base) {
    const double volume = base.determinant();
    for (int axis = 0; axis < 3; ++axis) {
      // Distance between opposite faces.
      const double width = volume / base.col((axis + 1) % 3).cross(base.col((axis + 2) % 3)).norm();
      counts_[axis] = std::max(1, static_cast<int>(width / reach));
      spans[axis] = static_cast<int>(std::ceil(reach * counts_[axis] / width));
      wide_[axis] = counts_[axis] + 2 * spans[axis];
    }
    fold(rows, grains);
    spread(rows);
  }

  /// In bin (x, y, z), -spans to counts + spans - 1, and those behind it along x up to bin `last`.
  struct Range {
    int begin, end;
  };
  [[nodiscard]] Range range(int first, int last, int y, int z) const {
    return {starts_[number(first, y, z)], starts_[number(last, y, z) + 1]};
  }
  [[nodiscard]] int count(int axis) const { return counts_[axis]; }

  std::array<int, 3> spans{};       // bins on either side that the reach covers
  std::vector<SpaceLattice> homes;  // copy of the box into which each sphere has wandered
  Members members;

 private:
  [[nodiscard]] std::size_t number(int x, int y, int z) const {
    return (static_cast<std::size_t>(z + spans[2]) * wide_[1] + (y + spans[1])) * wide_[0] + (x + spans[0]);
  }

  /// Which bin of the box each sphere lies in.
  void fold(const double* rows, int grains) {
    const Eigen::Matrix3d inverse = base_.inverse();
    homes.resize(static_cast<std::size_t>(grains));
    bins_.resize(homes.size());
    for (std::size_t k = 0; k < homes.size(); ++k) {
      const Eigen::Vector3d part = inverse * Eigen::Map<const Eigen::Vector3d>(rows + k * kGrainStride);
      homes[k] = {copy_of(part.x()), copy_of(part.y()), copy_of(part.z())};
      const double within[3] = {part.x() - homes[k].p, part.y() - homes[k].q, part.z() - homes[k].r};
      for (int axis = 0; axis < 3; ++axis)
        bins_[k][axis] = std::min(counts_[axis] - 1, static_cast<int>(within[axis] * counts_[axis]));
    }
  }

  /// Calls `visit(sphere, bin number, copy)` for each sphere and each of its copies that stands in a bin.
  template <typename Visit>
  void each(Visit visit) const {
    for (std::size_t k = 0; k < bins_.size(); ++k) {
      std::array<int, 3> first{}, last{};
      for (int axis = 0; axis < 3; ++axis) {
        // bin + copy * count from -span to count + span - 1
        first[axis] = -((spans[axis] + bins_[k][axis]) / counts_[axis]);
        last[axis] = (counts_[axis] + spans[axis] - 1 - bins_[k][axis]) / counts_[axis];
      }
      for (int r = first[2]; r <= last[2]; ++r)
        for (int q = first[1]; q <= last[1]; ++q)
          for (int p = first[0]; p <= last[0]; ++p)
            visit(k,
                  number(bins_[k][0] + p * counts_[0], bins_[k][1] + q * counts_[1],
                         bins_[k][2] + r * counts_[2]),
                  SpaceLattice{p, q, r});
    }
  }

  void spread(const double* rows) {
    starts_.assign(static_cast<std::size_t>(wide_[0]) * wide_[1] * wide_[2] + 1, 0);
    each([this](std::size_t, std::size_t bin, const SpaceLattice&) { ++starts_[bin + 1]; });
    for (std::size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
    const auto total = static_cast<std::size_t>(starts_.back());
    for (std::vector<double>* const values : {&members.x, &members.y, &members.z, &members.radius})
      values->resize(total);
    members.sphere.resize(total);
    members.copy.resize(total);
    std::vector<int> next(starts_.begin(), starts_.end() - 1);
    each([&](std::size_t k, std::size_t bin, const SpaceLattice& copy) {
      const auto place = static_cast<std::size_t>(next[bin]++);
      const double* const row = rows + k * kGrainStride;
      const SpaceLattice& home = homes[k];
      const Eigen::Vector3d centre =
          Eigen::Map<const Eigen::Vector3d>(row) -
          SpaceLattice{home.p - copy.p, home.q - copy.q, home.r - copy.r}.of(base_);
      members.x[place] = centre.x();
      members.y[place] = centre.y();
      members.z[place] = centre.z();
      members.radius[place] = row[3];
      members.sphere[place] = static_cast<int>(k);
      members.copy[place] = copy;
    });
  }

  Eigen::Matrix3d base_;
  std::array<int, 3> counts_{}, wide_{};
  std::vector<std::array<int, 3>> bins_;
  std::vector<int> starts_;
};

int image_number(std::vector<SpaceLattice>& images, const SpaceLattice& wanted) {
  const auto found = std::find(images.begin(), images.end(), wanted);
  const auto number = static_cast<int>(found - images.begin());
  if (found == images.end()) images.push_back(wanted);
  return number;
}

/// Finds the pairs of the four zones.
class PairSearch {
 public:
  PairSearch(const BinsOfSpheres& bins, double skin, std::vector<SpaceLattice>& images)
      : bins_(bins), skin_(skin), images_(images), squares_(bins.members.x.size()) {
    for (int z = 0; z < bins.count(2); ++z)
      for (int y = 0; y < bins.count(1); ++y)
        for (int x = 0; x < bins.count(0); ++x) {
          const BinsOfSpheres::Range own = bins.range(x, x, y, z);
          for (int m = own.begin; m < own.end; ++m) around(m, x, y, z);
        }
  }
  SphereZones zones;

 private:
  /// Each pair is seen from one of its two spheres: from that with the lower bin in z, then y, then x.
  void around(int m, int x, int y, int z) {
    const std::array<int, 3>& span = bins_.spans;
    compare(m, {m + 1, bins_.range(x, x + span[0], y, z).end});
    for (int dy = 1; dy <= span[1]; ++dy) compare(m, bins_.range(x - span[0], x + span[0], y + dy, z));
    for (int dz = 1; dz <= span[2]; ++dz)
      for (int dy = -span[1]; dy <= span[1]; ++dy)
        compare(m, bins_.range(x - span[0], x + span[0], y + dy, z + dz));
  }

  void compare(int m, BinsOfSpheres::Range range) {
    const BinsOfSpheres::Members& all = bins_.members;
    const double x = all.x[m], y = all.y[m], z = all.z[m], reach = all.radius[m] + skin_;
    // Negative where a pair is near: without a branch, for the compiler to take several at a time.
    for (int k = range.begin; k < range.end; ++k) {
      const double dx = x - all.x[k], dy = y - all.y[k], dz = z - all.z[k], sum = reach + all.radius[k];
      squares_[k] = dx * dx + dy * dy + dz * dz - sum * sum;
    }
    for (int k = range.begin; k < range.end; ++k)
      if (squares_[k] < 0.0) add(m, k);
  }

  void add(int m, int k) {
    const BinsOfSpheres::Members& all = bins_.members;
    int first = all.sphere[m], second = all.sphere[k];
    Eigen::Vector3d delta(all.x[m] - all.x[k], all.y[m] - all.y[k], all.z[m] - all.z[k]);
    const SpaceLattice& home = bins_.homes[first];
    const SpaceLattice& away = bins_.homes[second];
    const SpaceLattice& copy = all.copy[k];
    SpaceLattice image{copy.p + home.p - away.p, copy.q + home.q - away.q, copy.r + home.r - away.r};
    if (second < first || (second == first && !points_up(delta.data()))) {
      std::swap(first, second);
      image = {-image.p, -image.q, -image.r};
    }
    const double gap = delta.norm() - all.radius[m] - all.radius[k];
    zones[(image.is_home() ? 0 : 2) + (gap > 0.0 ? 1 : 0)].push_back(
        {first, second, image.is_home() ? 0 : image_number(images_, image), gap});
  }

  const BinsOfSpheres& bins_;
  double skin_;
  std::vector<SpaceLattice>& images_;
  std::vector<double> squares_;
};

/// Sorts by classes of gaps, each as wide as 1/64 of the skin, and gives each pair the least gap of its class.
void sort_by_gap(std::vector<SpherePair>& pairs, double skin) {
  constexpr int kClasses = 64;
  const auto class_of = [skin](double gap) {
    return std::clamp(static_cast<int>(gap * kClasses / skin), 0, kClasses - 1);
  };
  std::array<std::size_t, kClasses + 1> starts{};
  for (const SpherePair& pair : pairs) ++starts[static_cast<std::size_t>(class_of(pair.gap)) + 1];
  for (int k = 0; k < kClasses; ++k) starts[k + 1] += starts[k];
  std::vector<SpherePair> sorted(pairs.size());
  for (const SpherePair& pair : pairs) {
    const int class_number = class_of(pair.gap);
    SpherePair& place = sorted[starts[static_cast<std::size_t>(class_number)]++];
    place = pair;
    place.gap = class_number * skin / kClasses;
  }
  pairs = std::move(sorted);
}

}  // namespace

SpaceLattice copy_at(const Eigen::Matrix3d& inverse, const Eigen::Vector3d& place) {
  const Eigen::Vector3d part = inverse * place;
  return {copy_of(part.x()), copy_of(part.y()), copy_of(part.z())};
}

void SphereList::find(const double* rows, int how_many, const Eigen::Matrix3d& base, double skin) {
  double largest = 0.0;
  for (int k = 0; k < how_many; ++k) largest = std::max(largest, rows[k * kGrainStride + 3]);
  images.assign(1, SpaceLattice{});
  const BinsOfSpheres bins(rows, how_many, base, 2.0 * largest + skin);
  SphereZones zones = std::move(PairSearch(bins, skin, images).zones);
  for (const std::size_t zone : {1, 3}) sort_by_gap(zones[zone], skin);
  take(std::move(zones), rows, how_many);
}

void SphereList::take(SphereZones zones, const double* rows, int how_many) {
  grains = how_many;
  first.clear();
  second.clear();
  image.clear();
  gaps.clear();
  for (std::size_t zone = 0; zone < zones.size(); ++zone) {
    std::vector<SpherePair>& pairs = zones[zone];
    while (pairs.size() % kBlock != 0) pairs.push_back({grains, grains + 1, 0, 0.0});
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      first.push_back(pairs[k].first);
      second.push_back(pairs[k].second);
      image.push_back(pairs[k].image);
      if (k % kBlock == 0) gaps.push_back(pairs[k].gap);
    }
    const auto end = static_cast<int>(first.size());
    (zone == 0 ? touching : zone == 1 ? interior : zone == 2 ? touching_across : count) = end;
  }
  active.assign(gaps.size(), 0);
  for (LineVector<unsigned>* const numbers : {&first_row, &second_row, &image_row})
    numbers->resize(first.size());
  for (LineVector<double>* const numbers : {&radius_first, &radius_second}) numbers->resize(first.size());
  for (std::size_t c = 0; c < first.size(); ++c) {
    first_row[c] = kGrainStride * static_cast<unsigned>(first[c]);
    second_row[c] = kGrainStride * static_cast<unsigned>(second[c]);
    image_row[c] = kImageStride * static_cast<unsigned>(image[c]);
    // Dummies stand behind the grains and have no radius.
    radius_first[c] = first[c] < grains ? rows[first_row[c] + 3] : 0.0;
    radius_second[c] = second[c] < grains ? rows[second_row[c] + 3] : 0.0;
  }
  for (int k = 0; k < spring_count; ++k) springs[k].assign(first.size(), 0.0);
}

bool SphereList::is_stressed(int candidate, int how_many) const {
  if (first[candidate] >= grains) return false;
  for (int k = 0; k < how_many; ++k)
    if (springs[k][candidate] != 0.0) return true;
  return false;
}

CarriedSprings SphereList::carried() const {
  CarriedSprings all;
  all.contacts.reserve(static_cast<std::size_t>(count));
  all.values.reserve(static_cast<std::size_t>(count) * spring_count);
  for (int c = 0; c < count; ++c) {
    if (!is_stressed(c, spring_count)) continue;
    all.contacts.push_back({first[c], second[c], images[image[c]]});
    for (int k = 0; k < spring_count; ++k) all.values.push_back(springs[k][c]);
  }
  return all;
}

void SphereList::take_springs(const CarriedSprings& carried) {
  // Contacts by their first sphere.
  std::vector<int> starts(static_cast<std::size_t>(grains) + 1, 0);
  for (const CarriedSprings::Contact& contact : carried.contacts) ++starts[contact.first + 1];
  for (int i = 0; i < grains; ++i) starts[i + 1] += starts[i];
  std::vector<int> rows(carried.contacts.size());
  std::vector<int> next(starts.begin(), starts.end() - 1);
  for (std::size_t c = 0; c < rows.size(); ++c) rows[next[carried.contacts[c].first]++] = static_cast<int>(c);

  for (int c = 0; c < touching_across; ++c) {
    if (first[c] >= grains || (c >= touching && c < interior)) continue;
    for (int place = starts[first[c]]; place < starts[first[c] + 1]; ++place) {
      const int o = rows[place];
      const CarriedSprings::Contact& contact = carried.contacts[o];
      if (contact.second != second[c] || !(contact.image == images[image[c]])) continue;
      for (int k = 0; k < spring_count; ++k)
        springs[k][c] = carried.values[static_cast<std::size_t>(o) * spring_count + k];
      break;
    }
  }
}

}  // namespace polargrain::dem
