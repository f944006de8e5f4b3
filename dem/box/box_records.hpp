// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <stdexcept>
#include <vector>

#include "dem/contact/contact_recorder.hpp"
#include "dem/lanes/line_vector.hpp"

namespace polargrain::dem {

/// A box's account of its last force pass, and room for lists of its grains. Boxes that go on one after the other share
/// one, for it may be larger than a box: it then tells of the box that made the last pass.
struct BoxRecords {
  const void* teller = nullptr;   ///< the box that made the pass
  LineVector<double> values;      ///< as the kernels of its loop take them down
  std::vector<Contact> contacts;  ///< made of the values
  bool are_listed = true;         ///< the contacts are those of the values
  std::vector<double> rotations, places;

  /// A pass begins that takes down so many values. @returns where to
  double* begin(const void* box, std::size_t count) {
    if (values.size() < count) values.resize(count);
    teller = box;
    are_listed = false;
    return values.data();
  }
  /// The box has no pass behind it: it was restored, or its list is new.
  void clear(const void* box) {
    teller = box;
    contacts.clear();
    are_listed = true;
  }
  /// These, where they tell of that box. @throws std::logic_error where another one has made a pass since
  BoxRecords& of(const void* box) {
    if (teller != box) throw std::logic_error("a box tells of its last pass before another one makes one");
    return *this;
  }
};

}  // namespace polargrain::dem
