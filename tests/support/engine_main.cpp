// SPDX-License-Identifier: GPL-2.0-or-later
// main of the tests that run the engine in their own process.
#include <gtest/gtest.h>

#include <cstdlib>

#include "dem/engine/engine.hpp"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  // As workers do it: no daemon of Open MPI beside the process. With one, an engine that ends in a forked child would
  // wait for ever for the daemon's word, which comes to the parent.
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 1);
  setenv("OMPI_MCA_btl", "self", 1);  // nor sockets that parent and child would share
  // To be listed, tests need no engine: what MPI loses would be told by the sanitizers, and the list be taken for a failure.
  if (!GTEST_FLAG_GET(list_tests)) polargrain::dem::start_engine_process();
  return RUN_ALL_TESTS();
}
