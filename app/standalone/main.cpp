// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/standalone/standalone.hpp"

int main(int argc, char** argv) {
  return polargrain::dem::run_liggghts(argc, argv);
}
