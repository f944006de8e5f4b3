// SPDX-License-Identifier: GPL-2.0-or-later
// For tests that hand broken files to libraries of others under the sanitizers: HDF5 and Gmsh lose memory when they
// refuse a file, and ask for absurd amounts. Not ours to mend.
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libhdf5\nleak:libgmsh\n";
}
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier)
  return "allocator_may_return_null=1";
}
