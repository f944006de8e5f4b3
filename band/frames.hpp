// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "band/displacement_field.hpp"
#include "band/sample.hpp"

namespace polargrain::band {

/// All places of a body at one time.
struct Frame {
  std::vector<Eigen::Vector2d>
      positions;  ///< of grains: where they are; of elements: of their points, undeformed, m
  std::vector<Eigen::Vector2d> displacements;  ///< of elements, since the start, m; of grains empty
  std::vector<Eigen::Matrix2d> strains;  ///< of elements, displacement gradient or strain; of grains empty
  std::vector<double> areas;             ///< of elements, m^2; of grains empty
  std::vector<double> rotations;         ///< since the start, rad
};

/// step -> file, of the files step-NUMBER with an extension; empty where there is no such folder.
std::map<long, std::filesystem::path> frame_files(const std::filesystem::path& folder,
                                                  const std::string& extension);

/// A LIGGGHTS dump with the columns id, x or xu, y and f_turned (others are skipped), grains in the order of their
/// ids.
/// @throws InputError naming file and line
Frame read_grain_dump(const std::filesystem::path& file);

/// A field file of `polargrain run`: the 2 x 2 integration points of each quadrilateral (a triangle counts as
/// one point), displacement gradients from the nodes, micro-rotation.
/// @throws InputError naming the file when it is another kind of .vtu
Frame read_element_fields(const std::filesystem::path& file);

/// Whose frames they are.
enum class FrameKind { elements, grains, images };

/// The frames of a result directory: of `polargrain run` (fields/step-*.vtu), of a specimen made of grains
/// (grains/step-*.dump), or of image correlation (displacements/step-*.csv: displacements since step 0, whose own file may
/// be left out).
class Frames {
 public:
  /// @param strain_column column of history.csv with the axial strain (compression positive)
  /// @param units of the files of image correlation
  /// @param radius of the neighbourhood that the strain of a grain or of a place of an image is taken from, m; 0:
  /// kNeighbourhood mean distances
  /// @throws InputError when the folder has no frames, or history.csv no row for one of them
  Frames(const std::filesystem::path& directory, const std::string& strain_column,
         const FieldUnits& units = {}, double radius = 0.0);

  /// Axial strain of each frame, in the order of their steps.
  [[nodiscard]] const std::vector<double>& axial_strains() const { return axial_strains_; }
  /// The frame nearest to an axial strain.
  [[nodiscard]] std::size_t nearest(double axial_strain) const;
  /// The change between two frames. Places stand where they were at the start of the test.
  /// @param current stand where they are at frame `from` instead
  [[nodiscard]] Samples increment(std::size_t from, std::size_t to, bool current) const;
  [[nodiscard]] FrameKind kind() const { return kind_; }
  [[nodiscard]] const std::filesystem::path& file(std::size_t index) const { return files_[index]; }
  /// Places of images that have no displacement in one of two frames or in both; of grains and elements 0.
  [[nodiscard]] std::size_t missing(std::size_t from, std::size_t to) const;

 private:
  [[nodiscard]] Frame read(std::size_t index) const;
  [[nodiscard]] Samples grains(const Frame& first, const Frame& from, const Frame& to, bool current) const;
  [[nodiscard]] FieldIncrement between(std::size_t from, std::size_t to) const;

  std::vector<std::filesystem::path> files_;  ///< empty: of the reference image itself
  std::vector<double> axial_strains_;
  FrameKind kind_ = FrameKind::elements;
  FieldUnits units_;
  double radius_ = 0.0;
};

}  // namespace polargrain::band
