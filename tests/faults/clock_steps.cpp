// SPDX-License-Identifier: GPL-2.0-or-later
// To be preloaded: the clock of the day steps an hour back and forth every tenth of a second, as when somebody sets it.
#include <dlfcn.h>
#include <sys/time.h>
#include <time.h>

namespace {

using ClockGettime = int (*)(clockid_t, timespec*);

int stepping(clockid_t clock, timespec* time) {
  static const auto next = reinterpret_cast<ClockGettime>(dlsym(RTLD_NEXT, "clock_gettime"));
  const int result = next(clock, time);
  if (result != 0 || (clock != CLOCK_REALTIME && clock != CLOCK_REALTIME_COARSE)) return result;
  timespec steady{};
  next(CLOCK_MONOTONIC, &steady);
  const bool is_ahead = steady.tv_nsec / 100'000'000 % 2 == 1;
  time->tv_sec += is_ahead ? 3600 : -3600;
  return result;
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  return stepping(clock, time);
}

extern "C" int gettimeofday(timeval* __restrict now, void* __restrict) noexcept {
  timespec time{};
  const int result = stepping(CLOCK_REALTIME, &time);
  *now = {time.tv_sec, time.tv_nsec / 1000};
  return result;
}

extern "C" time_t time(time_t* now) noexcept {
  timespec time{};
  stepping(CLOCK_REALTIME, &time);
  if (now != nullptr) *now = time.tv_sec;
  return time.tv_sec;
}
