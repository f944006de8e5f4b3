// SPDX-License-Identifier: GPL-2.0-or-later
// What a cell evaluation costs outside the engine: packing and unpacking its messages. A state of a cell of
// 400 grains has about 110 kB.
#include <benchmark/benchmark.h>

#include "coupler/protocol/messages.hpp"

namespace {

using namespace polargrain;
using namespace polargrain::coupler;

StatePointer state_of(std::size_t bytes) {
  std::vector<std::byte> content(bytes);
  for (std::size_t i = 0; i < bytes; ++i) content[i] = static_cast<std::byte>(i * 131 >> 3);
  return std::make_shared<const State>(std::move(content));
}

void count_bytes(benchmark::State& state, const std::string& bytes) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * bytes.size()));
  state.counters["message_bytes"] = static_cast<double>(bytes.size());
}

void encode_reply(benchmark::State& state) {
  Reply reply{1, {}};
  reply.cell.state = state_of(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(encode(reply));
  count_bytes(state, encode(reply));
}
BENCHMARK(encode_reply)->Arg(110'000)->Arg(1'000'000);

void decode_reply(benchmark::State& state) {
  Reply reply{1, {}};
  reply.cell.state = state_of(static_cast<std::size_t>(state.range(0)));
  const std::string bytes = encode(reply);
  for (auto _ : state) benchmark::DoNotOptimize(decode(std::as_bytes(std::span(bytes))));
  count_bytes(state, bytes);
}
BENCHMARK(decode_reply)->Arg(110'000)->Arg(1'000'000);

void round_trip_of_a_request_without_state(benchmark::State& state) {
  const EvaluateRequest request{1, 0, false, state_of(100)->name(), nullptr, {}};
  for (auto _ : state) {
    const std::string bytes = encode(request);
    benchmark::DoNotOptimize(decode(std::as_bytes(std::span(bytes))));
  }
  count_bytes(state, encode(request));
}
BENCHMARK(round_trip_of_a_request_without_state);

}  // namespace
