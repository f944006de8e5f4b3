// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/standard_streams.hpp"
#include "dem/standalone/standalone.hpp"

int main(int argc, char** argv) {
  polargrain::open_standard_streams();
  return polargrain::dem::run_liggghts(argc, argv);
}
