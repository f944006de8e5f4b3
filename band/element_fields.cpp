// SPDX-License-Identifier: GPL-2.0-or-later
// Reads the field files that fem/output writes (docs/file_formats.md): VTK XML, arrays inline, base64 of a
// 64-bit number of bytes and the values.
#include <fmt/format.h>

#include <array>
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

/// Corners of a VTK cell type: they come first.
std::size_t corners_of(std::uint8_t type, const FieldFile& file) {
  switch (type) {
    case 5:   // triangle
    case 22:  // quadratic triangle
      return 3;
    case 9:   // quadrilateral
    case 23:  // quadratic quadrilateral
    case 28:  // biquadratic quadrilateral
      return 4;
    default:
      file.fail(fmt::format("cells of VTK type {} are not known", type));
  }
}

}  // namespace

Frame read_element_fields(const std::filesystem::path& path) {
  const FieldFile file(path);
  const auto points = file.array<double>("Points");
  const auto displacement = file.array<double>("displacement");
  const auto nodes = file.array<std::int64_t>("connectivity");
  const auto ends = file.array<std::int64_t>("offsets");
  const auto types = file.array<std::uint8_t>("types");
  const auto strain = file.array<double>("strain");
  std::vector<double> rotation(points.size() / 3, 0.0);
  if (file.has("micro_rotation")) rotation = file.array<double>("micro_rotation");
  if (strain.size() != 5 * ends.size() || types.size() != ends.size() ||
      displacement.size() != points.size() || rotation.size() != points.size() / 3)
    file.fail("its arrays do not fit together");
  Frame frame;
  std::size_t begin = 0;
  for (std::size_t element = 0; element < ends.size(); ++element) {
    const std::size_t count = corners_of(types[element], file);
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    Eigen::Vector2d moved = Eigen::Vector2d::Zero();
    double turned = 0.0;
    double twice_area = 0.0;
    const auto corner = [&](std::size_t k, const std::vector<double>& values) {
      const auto node = static_cast<std::size_t>(nodes[begin + k % count]);
      return Eigen::Vector2d(values[3 * node], values[3 * node + 1]);
    };
    for (std::size_t k = 0; k < count; ++k) {
      const Eigen::Vector2d here = corner(k, points);
      const Eigen::Vector2d next = corner(k + 1, points);
      centre += here / static_cast<double>(count);
      moved += corner(k, displacement) / static_cast<double>(count);
      turned += rotation[static_cast<std::size_t>(nodes[begin + k])] / static_cast<double>(count);
      twice_area += here.x() * next.y() - here.y() * next.x();
    }
    const double* const e = &strain[5 * element];  // 11, 22, 33, 12, 21
    // eps_12 = u_2,1 - w and eps_21 = u_1,2 + w: their sum is free of the rotation.
    Eigen::Matrix2d tensor;
    tensor << e[0], e[4], e[3], e[1];
    frame.positions.push_back(centre);
    frame.displacements.push_back(moved);
    frame.strains.push_back(tensor);
    frame.areas.push_back(0.5 * std::abs(twice_area));
    frame.rotations.push_back(turned);
    begin = static_cast<std::size_t>(ends[element]);
  }
  return frame;
}

}  // namespace polargrain::band
