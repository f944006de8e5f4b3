// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "app/page/page.hpp"
#include "app/report/run_result.hpp"

namespace polargrain::app {

/// Fields of a result on its moved mesh: frames from the first to the last field file, thinned out evenly where they would
/// make a page too large to be opened.
/// @param fields their names; empty: the fields of a fixed list that the files hold. Of vectors and tensors the Euclidean
/// norm is shown, of values by node the mean of the corners.
/// @throws InputError when a named field is in no file
MeshPicture picture_of(const RunResult& result, const std::vector<std::string>& fields);

}  // namespace polargrain::app
