// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/write_file.hpp"

namespace polargrain::fem {
using polargrain::write_file;
}
