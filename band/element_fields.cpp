// SPDX-License-Identifier: GPL-2.0-or-later
// Reads the field files that fem/output writes (docs/file_formats.md): VTK XML, arrays inline, base64 of a
// 64-bit number of bytes and the values.
#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>

#include "band/frames.hpp"
#include "common/error.hpp"

namespace polargrain::band {
namespace {

std::vector<unsigned char> decode_base64(const std::string& text, std::size_t begin, std::size_t end) {
  static const std::array<int, 256> values = [] {
    std::array<int, 256> table{};
    table.fill(-1);
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t k = 0; k < digits.size(); ++k)
      table[static_cast<unsigned char>(digits[k])] = static_cast<int>(k);
    return table;
  }();
  std::vector<unsigned char> bytes;
  unsigned buffer = 0;
  int bits = 0;
  for (std::size_t k = begin; k < end; ++k) {
    const int value = values[static_cast<unsigned char>(text[k])];
    if (value < 0) continue;  // line ends, padding
    buffer = buffer << 6 | static_cast<unsigned>(value);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(static_cast<unsigned char>(buffer >> bits));
  }
  return bytes;
}

class FieldFile {
 public:
  explicit FieldFile(const std::filesystem::path& file) : file_(file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    text_ = text.str();
  }
  [[nodiscard]] bool has(const std::string& name) const { return find(name) != std::string::npos; }
  /// The values of an array. @throws InputError when it is not there, or not of that size
  template <class T>
  [[nodiscard]] std::vector<T> array(const std::string& name) const {
    const std::size_t place = find(name);
    if (place == std::string::npos) fail(fmt::format("there is no array '{}'", name));
    const std::size_t begin = text_.find('>', place);
    const std::size_t end = text_.find('<', begin);
    if (begin == std::string::npos || end == std::string::npos)
      fail(fmt::format("the array '{}' has no end", name));
    const std::vector<unsigned char> bytes = decode_base64(text_, begin + 1, end);
    std::uint64_t size = 0;
    if (bytes.size() >= sizeof(size)) std::memcpy(&size, bytes.data(), sizeof(size));
    if (bytes.size() < sizeof(size) || bytes.size() - sizeof(size) != size || size % sizeof(T) != 0)
      fail(fmt::format("the array '{}' is not what `polargrain run` writes", name));
    std::vector<T> values(size / sizeof(T));
    if (size > 0) std::memcpy(values.data(), bytes.data() + sizeof(size), size);
    return values;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError({file_.string(), 0, "a field file of `polargrain run` was expected: " + what});
  }

 private:
  [[nodiscard]] std::size_t find(const std::string& name) const {
    return text_.find(fmt::format("Name=\"{}\"", name));
  }
  std::filesystem::path file_;
  std::string text_;
};

/// Nodes of an element: place, displacement, micro-rotation.
struct Node {
  Eigen::Vector2d place, displacement;
  double rotation;
};

/// Shape functions and their derivatives by the coordinates of the unit square, for its 4 or 8 nodes.
struct Shape {
  std::array<double, 8> value;
  std::array<Eigen::Vector2d, 8> slope;
};

constexpr std::array<std::array<int, 2>, 8> kUnitSquare{
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}}};

Shape shape_at(std::size_t count, double a, double b) {
  Shape shape{};
  for (std::size_t k = 0; k < count; ++k) {
    const double p = kUnitSquare[k][0];
    const double q = kUnitSquare[k][1];
    const double f = 1.0 + a * p;
    const double g = 1.0 + b * q;
    if (count == 4) {
      shape.value[k] = 0.25 * f * g;
      shape.slope[k] = {0.25 * p * g, 0.25 * f * q};
    } else if (k < 4) {
      shape.value[k] = 0.25 * f * g * (a * p + b * q - 1.0);
      shape.slope[k] = {0.25 * p * g * (2.0 * a * p + b * q), 0.25 * q * f * (a * p + 2.0 * b * q)};
    } else if (p == 0.0) {
      shape.value[k] = 0.5 * (1.0 - a * a) * g;
      shape.slope[k] = {-a * g, 0.5 * (1.0 - a * a) * q};
    } else {
      shape.value[k] = 0.5 * f * (1.0 - b * b);
      shape.slope[k] = {0.5 * p * (1.0 - b * b), -b * f};
    }
  }
  return shape;
}

/// The 2 x 2 integration points of a quadrilateral.
void add_quadrilateral(const std::vector<Node>& nodes, Frame& frame) {
  const double point = 1.0 / std::sqrt(3.0);
  for (const double b : {-point, point})
    for (const double a : {-point, point}) {
      const Shape shape = shape_at(nodes.size(), a, b);
      Eigen::Matrix2d jacobian = Eigen::Matrix2d::Zero();  // d x / d (a, b)
      Eigen::Matrix2d slope = Eigen::Matrix2d::Zero();     // d u / d (a, b)
      Node here{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), 0.0};
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        jacobian += nodes[k].place * shape.slope[k].transpose();
        slope += nodes[k].displacement * shape.slope[k].transpose();
        here.place += shape.value[k] * nodes[k].place;
        here.displacement += shape.value[k] * nodes[k].displacement;
        here.rotation += shape.value[k] * nodes[k].rotation;
      }
      frame.positions.push_back(here.place);
      frame.displacements.push_back(here.displacement);
      frame.strains.push_back(slope * jacobian.inverse());
      frame.areas.push_back(jacobian.determinant());
      frame.rotations.push_back(here.rotation);
    }
}

/// A triangle as a whole: the mean gradient follows from the displacements of its corners, which is what a
/// triangle with straight sides has in the middle.
void add_triangle(const std::vector<Node>& nodes, Frame& frame) {
  Eigen::Matrix2d sides;
  Eigen::Matrix2d stretches;
  sides << nodes[1].place - nodes[0].place, nodes[2].place - nodes[0].place;
  stretches << nodes[1].displacement - nodes[0].displacement, nodes[2].displacement - nodes[0].displacement;
  frame.positions.push_back((nodes[0].place + nodes[1].place + nodes[2].place) / 3.0);
  frame.displacements.push_back((nodes[0].displacement + nodes[1].displacement + nodes[2].displacement) /
                                3.0);
  frame.strains.push_back(stretches * sides.inverse());
  frame.areas.push_back(0.5 * std::abs(sides.determinant()));
  frame.rotations.push_back((nodes[0].rotation + nodes[1].rotation + nodes[2].rotation) / 3.0);
}

}  // namespace

Frame read_element_fields(const std::filesystem::path& path) {
  const FieldFile file(path);
  const auto points = file.array<double>("Points");
  const auto displacement = file.array<double>("displacement");
  const auto connectivity = file.array<std::int64_t>("connectivity");
  const auto ends = file.array<std::int64_t>("offsets");
  const auto types = file.array<std::uint8_t>("types");
  std::vector<double> rotation(points.size() / 3, 0.0);
  if (file.has("micro_rotation")) rotation = file.array<double>("micro_rotation");
  if (types.size() != ends.size() || displacement.size() != points.size() ||
      rotation.size() != points.size() / 3)
    file.fail("its arrays do not fit together");
  Frame frame;
  std::size_t begin = 0;
  for (std::size_t element = 0; element < ends.size(); ++element) {
    std::vector<Node> nodes;
    for (; begin < static_cast<std::size_t>(ends[element]); ++begin) {
      const auto node = static_cast<std::size_t>(connectivity.at(begin));
      nodes.push_back({{points.at(3 * node), points.at(3 * node + 1)},
                       {displacement.at(3 * node), displacement.at(3 * node + 1)},
                       rotation.at(node)});
    }
    const bool quadrilateral = types[element] == 9 || types[element] == 23;  // VTK's numbers
    const bool triangle = types[element] == 5 || types[element] == 22;
    if (quadrilateral && (nodes.size() == 4 || nodes.size() == 8)) {
      add_quadrilateral(nodes, frame);
    } else if (triangle && nodes.size() >= 3) {
      add_triangle(nodes, frame);
    } else {
      file.fail(fmt::format("cells of VTK type {} are not known", types[element]));
    }
  }
  return frame;
}

}  // namespace polargrain::band
