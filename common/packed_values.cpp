// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/packed_values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/error.hpp"

namespace polargrain {
namespace {
constexpr std::size_t kStress = 7;
constexpr std::size_t kTangent = 49;
constexpr std::size_t kResponse = kStress + kTangent + 5;
}  // namespace

std::vector<double> read_lists(ArchiveReader& archive, const std::string& name, std::size_t count,
                               std::size_t length) {
  std::vector<double> values = archive.doubles(name);
  if (values.size() != count * length) {
    throw RunError(
        fmt::format("'{}' holds {} values; {} times {} were expected", name, values.size(), count, length));
  }
  return values;
}

void write_responses(ArchiveWriter& archive, const std::string& name, std::span<const Response> responses) {
  std::vector<double> values;
  values.reserve(responses.size() * kResponse);
  for (const Response& response : responses) {
    values.insert(values.end(), response.stress.data(), response.stress.data() + kStress);
    values.insert(values.end(), response.tangent.data(), response.tangent.data() + kTangent);
    values.insert(values.end(), {static_cast<double>(response.quality), response.step_factor,
                                 response.noise.symmetric, response.noise.skew, response.noise.couple});
  }
  archive.write(name, std::span<const double>(values));
}

std::vector<Response> read_responses(ArchiveReader& archive, const std::string& name, std::size_t count) {
  const std::vector<double> values = read_lists(archive, name, count, kResponse);
  std::vector<Response> responses(count);
  const double* place = values.data();
  for (Response& response : responses) {
    std::copy_n(place, kStress, response.stress.data());
    std::copy_n(place + kStress, kTangent, response.tangent.data());
    const double quality = place[kStress + kTangent];
    if (quality != -1.0 && quality != 0.0 && quality != 1.0) {
      throw RunError(fmt::format("'{}' holds no answers of a material", name));
    }
    response.quality = static_cast<Quality>(static_cast<int>(quality));
    response.step_factor = place[kStress + kTangent + 1];
    response.noise = {place[kStress + kTangent + 2], place[kStress + kTangent + 3],
                      place[kStress + kTangent + 4]};
    place += kResponse;
  }
  return responses;
}

}  // namespace polargrain
