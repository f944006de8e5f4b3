// SPDX-License-Identifier: GPL-2.0-or-later
// The dense matrix work inside UMFPACK against plain loops that make the same operations in the same order:
// the same bits, whatever the registers of the processor that the test runs on.
#include "fem/solver/dense_kernels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <random>
#include <vector>

namespace {

constexpr int kOne = 1;
constexpr double kMinusOne = -1.0;
constexpr double kUnity = 1.0;

std::vector<double> some_numbers(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<double> numbers(count);
  for (double& number : numbers) number = static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;
  return numbers;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  return a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// Sizes about those of tiles and blocks.
void for_many_sizes(const std::function<void(int rows, int columns, int depth)>& check) {
  for (const int rows : {0, 1, 7, 8, 9, 63, 64, 65, 200})
    for (const int columns : {0, 1, 3, 4, 5, 32, 131})
      for (const int depth : {1, 2, 31, 32, 64, 65}) {
        SCOPED_TRACE(::testing::Message() << rows << " x " << columns << ", depth " << depth);
        check(rows, columns, depth);
      }
}

void check_product(int rows, int columns, int depth) {
  const int ld = rows + 3, ld_b = columns + 1;
  const auto a = some_numbers(static_cast<std::size_t>(ld) * depth, 1);
  const auto b = some_numbers(static_cast<std::size_t>(ld_b) * depth, 2);
  std::vector<double> c = some_numbers(static_cast<std::size_t>(ld) * columns, 3);
  std::vector<double> expected = c;
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i)
      for (int block = 0; block < depth; block += 64) {
        double sum = 0.0;
        for (int p = block; p < std::min(depth, block + 64); ++p) sum += a[i + p * ld] * b[j + p * ld_b];
        expected[i + j * ld] -= sum;
      }
  polargrain_dgemm("N", "T", &rows, &columns, &depth, &kMinusOne, a.data(), &ld, b.data(), &ld_b, &kUnity,
                   c.data(), &ld);
  EXPECT_TRUE(same_bits(c, expected));
}

void check_triangular_solutions(int rows, int columns, int) {
  const int ld = rows + 3, ld_l = columns + 2;
  auto l = some_numbers(static_cast<std::size_t>(ld_l) * columns, 4);
  for (double& number : l) number *= 0.1;
  std::vector<double> b = some_numbers(static_cast<std::size_t>(ld) * columns, 5);
  std::vector<double> expected = b;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      for (int p = 0; p < j; ++p) expected[i + j * ld] -= expected[i + p * ld] * l[j + p * ld_l];
  polargrain_dtrsm("R", "L", "T", "U", &rows, &columns, &kUnity, l.data(), &ld_l, b.data(), &ld);
  EXPECT_TRUE(same_bits(b, expected));

  std::vector<double> x = some_numbers(static_cast<std::size_t>(columns), 6);
  expected = x;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < i; ++j) expected[i] -= l[i + j * ld_l] * expected[j];
  polargrain_dtrsv("L", "N", "U", &columns, l.data(), &ld_l, x.data(), &kOne);
  EXPECT_TRUE(same_bits(x, expected));
}

void check_vector_products(int rows, int columns, int) {
  const int ld = rows + 3;
  std::vector<double> a = some_numbers(static_cast<std::size_t>(ld) * columns, 7);
  const auto x = some_numbers(static_cast<std::size_t>(columns), 8);
  std::vector<double> y = some_numbers(static_cast<std::size_t>(rows), 9);
  std::vector<double> expected = y;
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) expected[i] -= a[i + j * ld] * x[j];
  polargrain_dgemv("N", &rows, &columns, &kMinusOne, a.data(), &ld, x.data(), &kOne, &kUnity, y.data(),
                   &kOne);
  EXPECT_TRUE(same_bits(y, expected));

  expected = a;
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) expected[i + j * ld] -= y[i] * x[j];
  polargrain_dger(&rows, &columns, &kMinusOne, y.data(), &kOne, x.data(), &kOne, a.data(), &ld);
  EXPECT_TRUE(same_bits(a, expected));
}

TEST(dense_kernels, have_the_bits_of_plain_loops) {
  for_many_sizes(check_product);
  for_many_sizes(check_triangular_solutions);
  for_many_sizes(check_vector_products);
}

}  // namespace
