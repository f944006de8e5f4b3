// SPDX-License-Identifier: GPL-2.0-or-later
// polargrain-liggghts with every combination of models taken from the templates compiled here, in place of
// the stock library's code: what cells run on. Scripts need not know.
#include "dem/standalone/standalone.hpp"

int main(int argc, char** argv) {
  return polargrain::dem::run_liggghts(argc, argv);
}
