// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/hosts/mgis/cell_behaviour.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "coupler/case/section.hpp"
#include "coupler/hosts/definition_of_words.hpp"
#include "coupler/hosts/mgis/packed_state.hpp"

namespace polargrain::coupler::mgis {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMessage = 512;    ///< characters of a host's message, its end among them
constexpr std::size_t kDiscBytes = 256;  ///< of a state for each grain: twice what sheared packings have
constexpr std::size_t kSphereBytes = 768;
constexpr int kLargest = 127;  ///< extent of a host's array

fs::path own_file() {
  Dl_info info{};
  return dladdr(reinterpret_cast<const void*>(&own_file), &info) != 0 ? fs::absolute(info.dli_fname)
                                                                      : fs::path();
}

fs::path file_of_cell() {
  std::error_code error;
  const fs::path beside = own_file().replace_extension(".yaml");
  if (fs::is_regular_file(beside, error)) return beside;
  if (const char* const named = std::getenv("POLARGRAIN_CELL"); named != nullptr && *named != '\0')
    return named;
  throw InputError(
      {"", 0,
       fmt::format("there is no cell: write its script, packing, ... into {}, or name such a file in the "
                   "environment as POLARGRAIN_CELL",
                   beside.string())});
}

/// Files of the program are found by their name, as in a case. The host's own folder is not the program's.
void find_beside_program(Entry& document, const fs::path& directory, const fs::path& program) {
  std::error_code error;
  const fs::path share =
      fs::weakly_canonical(program, error).parent_path().parent_path() / "share" / "polargrain";
  for (Entry::Member& member : document.members) {
    if (member.key != "script" && member.key != "packing") continue;
    if (fs::is_regular_file(directory / member.value.text, error)) continue;
    for (const fs::path& file : {share / member.value.text, share / "liggghts_inputs" / member.value.text}) {
      if (!fs::is_regular_file(file, error)) continue;
      member.value.text = file.string();
      member.value.line = 0;  // as if named on the command line: it is the program's own
      break;
    }
  }
}

void tell(DataView& data, const std::string& message) {
  if (data.error_message == nullptr) return;
  const std::size_t length = std::min(message.size(), kMessage - 1);
  std::memcpy(data.error_message, message.data(), length);
  data.error_message[length] = '\0';
}

}  // namespace

CellBehaviour& CellBehaviour::of_library() {
  static CellBehaviour behaviour;
  return behaviour;
}

CellBehaviour::CellBehaviour() {
  try {
    read(file_of_cell());
  } catch (const std::exception& error) {
    fault_ = error.what();
  }
}

CellBehaviour::~CellBehaviour() = default;

void CellBehaviour::read(const fs::path& file) {
  const fs::path own = own_file().parent_path();
  const std::string program = program_for_workers({own.parent_path().parent_path() / "bin" / "polargrain",
                                                   own.parent_path().parent_path() / "app" / "polargrain"});
  Entry document = load_document(file);
  const fs::path directory = fs::absolute(file).parent_path();
  find_beside_program(document, directory, program);
  Faults faults;
  Section section(document, "cell", faults);
  definition_ = std::make_shared<CellDefinition>(read_hosted_cell(section, faults, {directory, {}}));
  const int workers = section.whole_or("workers", 1, 1);
  const bool is_of_spheres = definition_->packing.dimension == 3;
  const auto grains = static_cast<int>(definition_->packing.grains.size());
  const int bytes = section.whole_or("state_bytes", 1,
                                     grains * static_cast<int>(is_of_spheres ? kSphereBytes : kDiscBytes));
  section.finish();
  if (!faults.empty()) throw InputError(faults);
  set_state_shape(static_cast<std::size_t>(bytes));
  HostedCells::Options options;
  options.worker_command = {program, "worker"};
  for (int k = 0; k < workers; ++k) {
    workers_.push_back(std::make_unique<HostedCells>(options));
    free_.push_back(workers_.back().get());
  }
}

void CellBehaviour::set_state_shape(std::size_t bytes) {
  const auto size = static_cast<double>(doubles_for(bytes));
  if (size > std::pow(kLargest, 3))
    throw InputError(
        {"", 0, fmt::format("state_bytes: {} are more than a host has room for, 12 million", bytes)});
  const int first = std::min(kLargest, static_cast<int>(size));
  const int second = std::min(kLargest, static_cast<int>(std::ceil(size / first)));
  state_shape_ = {first, second, static_cast<int>(std::ceil(size / (static_cast<double>(first) * second)))};
}

std::size_t CellBehaviour::state_size() const {
  std::size_t size = 1;
  for (const int extent : state_shape_) size *= static_cast<std::size_t>(extent);
  return size;
}

void CellBehaviour::check(Hypothesis hypothesis) const {
  if (!fault_.empty()) throw RunError(fault_);
  if (hypothesis == Hypothesis::space && definition_->packing.dimension == 2)
    throw RunError(
        "a cell of discs knows its plane alone: use the hypothesis PlaneStrain, or a packing of spheres");
}

CellReply CellBehaviour::ask(const DataView& data, Hypothesis hypothesis, bool is_prediction) {
  check(hypothesis);
  HostedRequest request{definition_, {unpack_state({data.start.internal_variables, state_size()}), {}}};
  if (!is_prediction) request.cell.increment = increment_of(data, hypothesis);
  if (definition_->control.rotations == CellRotations::free) {
    request.cell.increment.rotation.setZero();
    request.cell.increment.curvature.setZero();
  }
  std::unique_lock lock(mutex_);
  freed_.wait(lock, [this] { return !free_.empty(); });
  HostedCells* const worker = free_.back();
  free_.pop_back();
  lock.unlock();
  // Given back whatever happens.
  const std::shared_ptr<HostedCells> taken(worker, [this](HostedCells* cells) {
    const std::lock_guard guard(mutex_);
    free_.push_back(cells);
    freed_.notify_one();
  });
  const CellIncrement& increment = request.cell.increment;
  const bool is_at_rest = request.cell.state == nullptr && increment.displacement_gradient.isZero(0.0) &&
                          increment.rotation.isZero(0.0) && increment.curvature.isZero(0.0);
  return is_at_rest ? taken->initial(definition_) : taken->evaluate({request}).front();
}

int CellBehaviour::integrate(DataView& data, Hypothesis hypothesis) {
  const Wish wish(data.tangent[0]);
  try {
    if (wish.is_of_sound) throw RunError("cells of grains do not tell the speed of sound");
    const CellReply reply = ask(data, hypothesis, wish.is_prediction);
    const Quality quality = reply.response.quality;
    if (quality != Quality::good) {
      tell(data, reply.response.message);
      if (data.time_step_factor != nullptr)
        *data.time_step_factor = std::min(*data.time_step_factor, reply.response.step_factor);
    }
    if (quality == Quality::failed) return kFailed;
    if (!wish.is_prediction) {
      pack_state(*reply.state, {data.end.internal_variables, state_size()});
      write_forces(reply.response, hypothesis, data.end.forces);
    }
    if (wish.has_tangent) write_tangent(reply.response, hypothesis, data.tangent);
    return quality == Quality::good ? kReliable : kUnreliable;
  } catch (const std::exception& error) {
    tell(data, error.what());
    return kFailed;
  }
}

int CellBehaviour::put_at_rest(DataView& data, Hypothesis hypothesis) {
  try {
    check(hypothesis);
    const CellReply reply = workers_.front()->initial(definition_);
    if (reply.response.quality == Quality::failed) throw RunError(reply.response.message);
    write_forces(reply.response, hypothesis, data.end.forces);
    std::fill_n(data.end.internal_variables, state_size(), 0.0);
    return 0;
  } catch (const std::exception& error) {
    tell(data, error.what());
    return 1;
  }
}

}  // namespace polargrain::coupler::mgis
