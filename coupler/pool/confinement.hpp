// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupler/pool/private_directory.hpp"

namespace polargrain::coupler {

/// The rights that a worker gives up for good, so that an engine taken over by a script or a state can do little
/// harm. In two parts, because the engine's own start needs more than its work does. Rights that the system does not let
/// go are left out and named.
class Confinement {
 public:
  /// Before anything else in the process: its own folder as working and temporary directory. A worker that has no use
  /// of the network has been started without one (Process).
  /// @param url of the coordinator: who comes to it by TCP needs the network
  explicit Confinement(const std::string& url);
  /// Before the first script: starts no program, writes nothing outside of its folder, watches or signals no other
  /// process, changes nothing of the system.
  void close();
  /// Rights that the system could not take away, for the user; empty: all are taken.
  [[nodiscard]] std::string missing() const;

 private:
  void keep_to_folder();

  bool may_use_network_;
  std::optional<PrivateDirectory> own_ =
      {};  ///< of a guest; directories of local workers lie in the coordinator's
  std::filesystem::path folder_ = {};
  std::vector<std::string> missing_;
};

}  // namespace polargrain::coupler
