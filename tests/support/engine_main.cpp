// SPDX-License-Identifier: GPL-2.0-or-later
// main of the tests that run the engine in their own process.
#include <gtest/gtest.h>

#include "dem/engine/engine.hpp"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  // To be listed, tests need no engine: what MPI loses would be told by the sanitizers, and the list be taken for a failure.
  if (!GTEST_FLAG_GET(list_tests)) polargrain::dem::start_engine_process();
  return RUN_ALL_TESTS();
}
