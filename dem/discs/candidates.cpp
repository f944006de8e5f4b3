// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/discs/candidates.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "dem/box/lost_grains.hpp"
#include "dem/discs/disc_pass.hpp"

namespace polargrain::dem {

namespace {

/// A disc as its bin holds it, folded back into the box.
struct Member {
  double x = 0.0;
  double y = 0.0;
  double radius = 0.0;
  std::int32_t disc = 0;
};

/// Where a disc lies: which bin, and which copy of the box its centre has wandered into.
struct PlaceOfDisc {
  int column = 0;
  int row = 0;
  LatticeVector copy;
};

/// BinsOfDiscs of a periodic box that is divided evenly along its base vectors, each as wide as it must be where
/// the box allows.
class BinsOfDiscs {
 public:
  BinsOfDiscs(std::span<const Disc> discs, const Eigen::Matrix2d& base, double reach) {
    const double area = base.determinant();
    // Distances between opposite faces.
    const double width_1 = area / base.col(1).norm();
    const double width_2 = area / base.col(0).norm();
    columns_ = std::max(1, static_cast<int>(width_1 / reach));
    rows_ = std::max(1, static_cast<int>(width_2 / reach));
    span_1 = static_cast<int>(std::ceil(reach * columns_ / width_1));
    span_2 = static_cast<int>(std::ceil(reach * rows_ / width_2));
    const Eigen::Matrix2d inverse = base.inverse();
    places.resize(discs.size());
    starts_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
    for (std::size_t k = 0; k < discs.size(); ++k) {
      const double s = inverse(0, 0) * discs[k].x + inverse(0, 1) * discs[k].y;
      const double t = inverse(1, 0) * discs[k].x + inverse(1, 1) * discs[k].y;
      PlaceOfDisc& place = places[k];
      place.copy = {copy_of(s), copy_of(t)};
      place.column = std::min(columns_ - 1, static_cast<int>((s - place.copy.p) * columns_));
      place.row = std::min(rows_ - 1, static_cast<int>((t - place.copy.q) * rows_));
      ++starts_[bin(place) + 1];
    }
    for (std::size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
    members_.resize(discs.size());
    std::vector<std::int32_t> next(starts_.begin(), starts_.end() - 1);
    for (std::size_t k = 0; k < discs.size(); ++k) {
      const LatticeVector& copy = places[k].copy;
      members_[next[bin(places[k])]++] = {discs[k].x - (base(0, 0) * copy.p + base(0, 1) * copy.q),
                                          discs[k].y - (base(1, 0) * copy.p + base(1, 1) * copy.q),
                                          discs[k].radius, static_cast<std::int32_t>(k)};
    }
  }

  /// Calls `visit(members, copy)` for the bins around a place; `copy`: which copy of the box they are seen in.
  template <typename Visit>
  void around(const PlaceOfDisc& place, Visit visit) const {
    LatticeVector copy;
    for (int dy = -span_2; dy <= span_2; ++dy) {
      const int row = folded(place.row + dy, rows_, copy.q);
      for (int dx = -span_1; dx <= span_1; ++dx) {
        const int column = folded(place.column + dx, columns_, copy.p);
        const std::size_t b = static_cast<std::size_t>(row) * columns_ + column;
        visit(std::span(members_).subspan(starts_[b], starts_[b + 1] - starts_[b]), copy);
      }
    }
  }

  std::vector<PlaceOfDisc> places;  ///< of the discs
  int span_1 = 1;                   ///< bins on either side that the reach covers
  int span_2 = 1;

 private:
  /// Number of the bin from 0 to count - 1 where it lies. @param copies of the box that lie between. A division would
  /// cost more than the distances that are looked at.
  static int folded(int number, int count, std::int32_t& copies) {
    copies = 0;
    for (; number < 0; number += count) --copies;
    for (; number >= count; number -= count) ++copies;
    return number;
  }
  [[nodiscard]] std::size_t bin(const PlaceOfDisc& place) const {
    return static_cast<std::size_t>(place.row) * columns_ + place.column;
  }

  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::int32_t> starts_;
  std::vector<Member> members_;
};

int image_number(std::vector<LatticeVector>& images, const LatticeVector& wanted) {
  const auto found = std::find(images.begin(), images.end(), wanted);
  const auto number = static_cast<int>(found - images.begin());
  if (found == images.end()) images.push_back(wanted);
  return number;
}

/// A disc that touches its own image sees it on both sides; one of them is counted.
bool counts(std::int32_t first, std::int32_t second, const LatticeVector& image) {
  if (first != second) return first < second;
  return image.q > 0 || (image.q == 0 && image.p > 0);
}

}  // namespace

LatticeVector copy_at(const Eigen::Matrix2d& inverse, double x, double y) {
  return {copy_of(inverse(0, 0) * x + inverse(0, 1) * y), copy_of(inverse(1, 0) * x + inverse(1, 1) * y)};
}

void CandidateList::clear() {
  rows.assign(1, 0);
  images.assign(1, LatticeVector{});
  for (LineVector<int>* const numbers : {&first, &second, &image, &kind}) numbers->clear();
  for (LineVector<double>* const numbers : {&radius_first, &radius_second, &harmonic}) numbers->clear();
  continues.clear();
  for (LineVector<double>& values : springs) values.clear();
}

bool CandidateList::is_stressed(int candidate) const {
  for (int k = 0; k < spring_count; ++k)
    if (springs[k][candidate] != 0.0) return true;
  return false;
}

void CandidateList::find(std::span<const Disc> discs, std::span<const int> types, int kinds,
                         const Eigen::Matrix2d& base, double skin) {
  double largest = 0.0;
  for (const Disc& disc : discs) largest = std::max(largest, disc.radius);
  const BinsOfDiscs bins(discs, base, 2.0 * largest + skin);
  clear();
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const Disc& disc = discs[i];
    const LatticeVector& home = bins.places[i].copy;
    const double x = disc.x - (base(0, 0) * home.p + base(0, 1) * home.q);
    const double y = disc.y - (base(1, 0) * home.p + base(1, 1) * home.q);
    bins.around(bins.places[i], [&](std::span<const Member> members, const LatticeVector& copy) {
      const double shift_x = base(0, 0) * copy.p + base(0, 1) * copy.q;
      const double shift_y = base(1, 0) * copy.p + base(1, 1) * copy.q;
      for (const Member& other : members) {
        if (other.disc < static_cast<std::int32_t>(i)) continue;
        const double dx = x - other.x - shift_x;
        const double dy = y - other.y - shift_y;
        const double sum = disc.radius + other.radius;
        if (!(dx * dx + dy * dy < (sum + skin) * (sum + skin))) continue;
        const std::int32_t j = other.disc;
        const LatticeVector& away = bins.places[j].copy;
        const LatticeVector lattice{copy.p + home.p - away.p, copy.q + home.q - away.q};
        if (!counts(static_cast<std::int32_t>(i), j, lattice)) continue;
        continues.push_back(static_cast<std::int32_t>(second.size()) > rows.back() ? -1 : 0);
        first.push_back(static_cast<int>(i));
        second.push_back(j);
        image.push_back(image_number(images, lattice));
        kind.push_back(types[i] * kinds + types[j]);
        radius_first.push_back(disc.radius);
        radius_second.push_back(other.radius);
        harmonic.push_back(disc.radius * other.radius / sum);
      }
    });
    rows.push_back(static_cast<std::int32_t>(second.size()));
  }
  while (second.size() % kDiscBlock != 0) {
    continues.push_back(-1);
    first.push_back(first.back());
    second.push_back(first.back());
    image.push_back(static_cast<int>(images.size()));
    kind.push_back(kind.back());
    radius_first.push_back(radius_first.back());
    radius_second.push_back(radius_first.back());
    harmonic.push_back(harmonic.back());
  }
  for (LineVector<unsigned>* const numbers : {&first_row, &second_row, &image_row})
    numbers->resize(second.size());
  for (std::size_t c = 0; c < second.size(); ++c) {
    first_row[c] = kDiscRow * static_cast<unsigned>(first[c]);
    second_row[c] = kDiscRow * static_cast<unsigned>(second[c]);
    image_row[c] = kImageRow * static_cast<unsigned>(image[c]);
  }
  for (LineVector<double>& values : springs) values.assign(second.size(), 0.0);
  row_sums.assign(discs.size(), DiscForce{});
}

void CandidateList::add(int one, int other, const LatticeVector& lattice, const double* values) {
  close_rows(static_cast<std::size_t>(one));
  first.push_back(one);
  second.push_back(other);
  image.push_back(image_number(images, lattice));
  for (int k = 0; k < spring_count; ++k) springs[k].push_back(values[k]);
}

void CandidateList::close_rows(std::size_t discs) {
  while (rows.size() <= discs) rows.push_back(static_cast<std::int32_t>(second.size()));
}

void CandidateList::take_springs(const CandidateList& other) {
  for (std::size_t i = 0; i + 1 < rows.size(); ++i)
    for (std::int32_t c = rows[i]; c < rows[i + 1]; ++c)
      for (std::int32_t o = other.rows[i]; o < other.rows[i + 1]; ++o) {
        if (other.second[o] != second[c] || !(other.images[other.image[o]] == images[image[c]])) continue;
        for (int k = 0; k < spring_count; ++k) springs[k][c] = other.springs[k][o];
        break;
      }
}

}  // namespace polargrain::dem
