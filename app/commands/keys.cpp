// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/keys.hpp"

#include <memory>

#include "app/commands/command.hpp"
#include "common/standard_streams.hpp"

namespace polargrain::app {
namespace {

struct KeysOptions {
  std::string directory;
  std::string worker = "worker";
};

int keys(const KeysOptions& options) {
  coupler::make_keys(options.directory, options.worker);
  tell(stdout,
       "{0}/{1}.key is new: copy it to where workers run, and to nowhere else.\n"
       "  here:  polargrain run CASE.yaml --listen tcp://*:5570 --keys {0}\n"
       "  there: polargrain worker --connect tcp://HOST:5570 --key {1}.key\n",
       options.directory, options.worker);
  return 0;
}

}  // namespace

Command add_keys(CLI::App& program, const Grains&) {
  const auto options = std::make_shared<KeysOptions>();
  CLI::App& command = *program.add_subcommand("keys", "Make keys for workers on other machines");
  command.add_option("DIR", options->directory, "Directory of the keys of a coordinator")->required();
  command.add_option("--worker", options->worker, "Name of the worker's key to add [worker]")
      ->type_name("NAME");
  return {&command, [options] { return keys(*options); }};
}

}  // namespace polargrain::app
