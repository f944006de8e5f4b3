// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "coupler/hosts/hosted_cells.hpp"
#include "coupler/hosts/mgis/point_data.hpp"

namespace polargrain::coupler::mgis {

/// The cell of a behaviour library, read when a host loads it: from NAME.yaml beside the library NAME.so, else from the
/// file that $POLARGRAIN_CELL names. Every integration reports its faults.
class CellBehaviour {
 public:
  /// The one of this library.
  static CellBehaviour& of_library();
  ~CellBehaviour();

  /// How many doubles a host keeps for the state of a point, as three factors below 128 (its arrays have no more).
  [[nodiscard]] const std::vector<int>& state_shape() const { return state_shape_; }

  /// Answers as MGIS expects it, and writes the outputs asked for; on failure only its reason.
  /// May be called by several threads: as many at once as there are workers.
  int integrate(DataView& data, Hypothesis hypothesis);

  /// Gives the point the stress of the packing at rest. @returns 0, or 1 with a message
  int put_at_rest(DataView& data, Hypothesis hypothesis);

 private:
  CellBehaviour();
  void read(const std::filesystem::path& file);
  void set_state_shape(std::size_t bytes);
  [[nodiscard]] std::size_t state_size() const;
  /// @throws InputError, RunError
  CellReply ask(const DataView& data, Hypothesis hypothesis, bool is_prediction);
  void check(Hypothesis hypothesis) const;

  std::string fault_;  ///< of the file; empty: no fault
  DefinitionPointer definition_;
  std::vector<int> state_shape_{1, 1, 1};

  std::mutex mutex_;
  std::condition_variable freed_;
  std::vector<std::unique_ptr<HostedCells>> workers_;
  std::vector<HostedCells*> free_;
};

}  // namespace polargrain::coupler::mgis
