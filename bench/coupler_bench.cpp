// SPDX-License-Identifier: GPL-2.0-or-later
// The cost of a cell evaluation outside the engine: packing and unpacking its messages.
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

void encode_a_state(benchmark::State& state) {
  const States reply{1, {state_of(static_cast<std::size_t>(state.range(0)))}};
  for (auto _ : state) benchmark::DoNotOptimize(encode(reply));
  count_bytes(state, encode(reply));
}
BENCHMARK(encode_a_state)->Arg(55'000)->Arg(1'000'000);

void decode_a_state(benchmark::State& state) {
  const States reply{1, {state_of(static_cast<std::size_t>(state.range(0)))}};
  const std::string bytes = encode(reply);
  for (auto _ : state) benchmark::DoNotOptimize(decode(std::as_bytes(std::span(bytes))));
  count_bytes(state, bytes);
}
BENCHMARK(decode_a_state)->Arg(55'000)->Arg(1'000'000);

void round_trip_of_a_request_without_state(benchmark::State& state) {
  const EvaluateRequest request{1, 0, 0, false, {}, {{false, state_of(100)->name(), nullptr, {}}}};
  for (auto _ : state) {
    const std::string bytes = encode(request);
    benchmark::DoNotOptimize(decode(std::as_bytes(std::span(bytes))));
  }
  count_bytes(state, encode(request));
}
BENCHMARK(round_trip_of_a_request_without_state);

void round_trip_of_a_reply_without_state(benchmark::State& state) {
  Reply reply{1, std::vector<CellReply>(static_cast<std::size_t>(state.range(0)))};
  const StatePointer made = state_of(100);
  for (CellReply& cell : reply.cells) cell.state = std::make_shared<const State>(made->name(), made->size());
  for (auto _ : state) {
    const std::string bytes = encode(reply);
    benchmark::DoNotOptimize(decode(std::as_bytes(std::span(bytes))));
  }
  count_bytes(state, encode(reply));
}
BENCHMARK(round_trip_of_a_reply_without_state)->Arg(1)->Arg(16);

}  // namespace
