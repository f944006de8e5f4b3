// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/run_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>

#include "common/error.hpp"
#include "common/plain_text.hpp"

namespace polargrain::app {
namespace {

class PlainPayload : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&, spdlog::memory_buf_t& out) override {
    const std::string text =
        without_control_characters(std::string_view(message.payload.data(), message.payload.size()));
    for (std::size_t k = 0; k < text.size(); ++k) {
      if (k > 0 && text[k - 1] == '\n' && text[k] == '[') out.push_back(' ');
      out.push_back(text[k]);
    }
  }
  [[nodiscard]] std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<PlainPayload>();
  }
};

}  // namespace

std::shared_ptr<spdlog::sinks::sink> run_log_sink(const std::filesystem::path& file, bool anew) {
  // A pipe that nobody reads is an error, not something to wait for.
  const int log = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NONBLOCK | O_CLOEXEC, 0666);
  if (log < 0) throw RunError(fmt::format("{} cannot be written: {}", file.string(), std::strerror(errno)));
  close(log);
  auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string(), anew);
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<PlainPayload>('*').set_pattern("[%Y-%m-%d %H:%M:%S.%e] [%n] [%l] %*");
  sink->set_formatter(std::move(formatter));
  return sink;
}

}  // namespace polargrain::app
