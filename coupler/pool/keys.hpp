// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <string>

namespace polargrain::coupler {

/// Keys of a coordinator that serves workers over TCP: its own CURVE key pair, and who may connect.
/// Keys are in Z85, 40 characters.
struct CoordinatorKeys {
  std::string public_key;
  std::string secret_key;
  std::map<std::string, std::string> allowed;  ///< from a worker's public key to its name
};

/// Keys of a worker: its own key pair and the public key of the only coordinator it trusts.
struct WorkerKey {
  std::string public_key;
  std::string secret_key;
  std::string coordinator_key;
};

/// Makes `directory` (mode 0700) with coordinator.key, workers.allowed and NAME.key (mode 0600), or adds
/// another worker's key to it. Nothing that exists is changed, but for the line that workers.allowed gains.
/// @throws InputError when the worker's key exists or the name is not a file name; RunError when a file cannot
/// be written
void make_keys(const std::filesystem::path& directory, const std::string& worker_name);

/// Reads coordinator.key and workers.allowed.
/// @throws InputError when a file is missing, broken, or open to other users
CoordinatorKeys read_coordinator_keys(const std::filesystem::path& directory);

/// @throws InputError when the file is missing, broken, or open to other users
WorkerKey read_worker_key(const std::filesystem::path& file);

}  // namespace polargrain::coupler
