// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/commands/worker.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <vector>

#include "app/commands/command.hpp"
#include "common/error.hpp"
#include "common/standard_streams.hpp"
#include "coupler/pool/confinement.hpp"
#include "coupler/pool/keys.hpp"
#include "coupler/pool/listening.hpp"

namespace polargrain::app {

std::unique_ptr<CellService> make_checked_service(const CellDefinition& definition, const ScriptRules& rules,
                                                  const WorkerEngine& engine) {
  if (!definition.contact_library.path.empty() && !rules.trusted) {
    throw RunError(
        fmt::format("this worker loads no library of contact laws ({}), which is a program; start it with "
                    "--trust-scripts when you trust it",
                    definition.contact_library.path));
  }
  const std::vector<Fault> faults = script_faults(definition.script, definition.script_file, rules);
  if (!faults.empty()) {
    throw RunError(
        fmt::format("this worker runs no such script ({}); start it with --trust-scripts to run any",
                    faults.front().text()));
  }
  return engine.make_service(definition);
}

int work(const WorkerOptions& options, const WorkerEngine& engine) {
  if (!options.log.empty()) {
    // A pipe that nobody reads is an error, not something to wait for.
    const int log = open(options.log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NONBLOCK | O_CLOEXEC, 0666);
    if (log < 0)
      throw RunError(fmt::format("the log {} cannot be written: {}", options.log, std::strerror(errno)));
    close(log);
  }
  for (std::FILE* stream : {stdout, stderr}) {
    if (!options.log.empty() && std::freopen(options.log.c_str(), "a", stream) == nullptr) {
      throw RunError(fmt::format("the log {} cannot be written", options.log));
    }
  }
  if (options.url.starts_with("tcp:")) coupler::check_tcp_url("--connect", options.url);
  try {
    coupler::ServeOptions serve_options;
    serve_options.patience_seconds = options.patience_seconds;
    if (!options.key.empty()) serve_options.key = coupler::read_worker_key(options.key);
    // Trusted scripts may do what the user may.
    std::optional<coupler::Confinement> confinement;
    if (!options.scripts.trusted) confinement.emplace(options.url);
    engine.start_process();
    if (confinement) {
      confinement->close();
      serve_options.unconfined = confinement->missing();
    }
    const CellServiceFactory make_service = [&](const CellDefinition& definition) {
      return make_checked_service(definition, options.scripts, engine);
    };
    serve(options.url, make_service, serve_options);
  } catch (const InputError& error) {
    throw;  // the user's input is wrong; told like everywhere else
  } catch (const std::exception& error) {
    tell(stderr, "ERROR: {}\n", error.what());
    return 1;
  }
  return 0;
}

Command add_worker(CLI::App& program, const Grains& grains) {
  const auto options = std::make_shared<WorkerOptions>();
  CLI::App& command = *program.add_subcommand("worker", "Serve cells to a coordinator (started by run)");
  command.add_option("--connect", options->url, "The coordinator's endpoint")->required()->type_name("URL");
  command.add_option("--key", options->key, "Key file of 'polargrain keys', needed for tcp://")
      ->type_name("FILE");
  command
      .add_option("--patience", options->patience_seconds, "Give up after so long without a coordinator [60]")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber)
      ->check(finite_number());
  command.add_option("--log", options->log, "Append all output to this file")->type_name("FILE");
  add_trust(command, options->scripts, grains);
  return {&command, [options, &engine = grains.engine] { return work(*options, engine); }};
}

}  // namespace polargrain::app
