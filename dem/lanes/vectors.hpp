// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Numbers of several lanes, of the compiler's own vectors: one source for every instruction set. A function treats each
// lane on its own, so that no bit depends on how many lanes there are. One lane is a plain double.
//
// Everything is in an unnamed namespace and inlined: each instruction set compiles its own, and no code of one may end
// up where a processor without it runs. For the same reason no standard header is included here, nor by those that
// include this one.
#define POLARGRAIN_INLINE [[gnu::always_inline]] inline
#define POLARGRAIN_INLINE_LAMBDA __attribute__((always_inline))

namespace polargrain::dem {
namespace {

template <int Width>
struct OfLanes {
  using Number [[gnu::vector_size(Width * sizeof(double))]] = double;
};
template <>
struct OfLanes<1> {
  using Number = double;
};
template <int Width>
using Lanes = typename OfLanes<Width>::Number;

template <typename Number>
inline constexpr int kWidth = sizeof(Number) / sizeof(double);

/// Four numbers of one grain side by side: a vector of space and one more.
using Row [[gnu::vector_size(4 * sizeof(double))]] = double;

template <typename Number>
POLARGRAIN_INLINE Number load(const double* from) {
  Number to;
  __builtin_memcpy(&to, from, sizeof to);
  return to;
}
template <typename Number>
POLARGRAIN_INLINE void store(double* to, Number from) {
  __builtin_memcpy(to, &from, sizeof from);
}
/// The same number in all lanes.
template <typename Number>
POLARGRAIN_INLINE Number all(double value) {
  return value - Number{};
}

/// A number for each lane. Pairs are joined: put in lane by lane, each lane would cost a mask.
/// @param at gives that of a lane
template <typename Number, typename At>
POLARGRAIN_INLINE Number of_each_lane(At at) {
  if constexpr (kWidth<Number> == 1) {
    return at(0);
  } else if constexpr (kWidth<Number> == 2) {
    return Number{at(0), at(1)};
  } else if constexpr (kWidth<Number> == 4) {
    const Lanes<2> low{at(0), at(1)}, high{at(2), at(3)};
    return __builtin_shufflevector(low, high, 0, 1, 2, 3);
  } else {
    const Lanes<2> a{at(0), at(1)}, b{at(2), at(3)}, c{at(4), at(5)}, d{at(6), at(7)};
    return __builtin_shufflevector(__builtin_shufflevector(a, b, 0, 1, 2, 3),
                                   __builtin_shufflevector(c, d, 0, 1, 2, 3), 0, 1, 2, 3, 4, 5, 6, 7);
  }
}

template <typename Number>
POLARGRAIN_INLINE Number root(Number a) {
  if constexpr (kWidth<Number> == 1) {
    return __builtin_sqrt(a);
  } else {
    Number made;
    for (int lane = 0; lane < kWidth<Number>; ++lane) made[lane] = __builtin_sqrt(a[lane]);
    return made;
  }
}
template <typename Number>
POLARGRAIN_INLINE Number lesser(Number a, Number b) {
  return a < b ? a : b;
}
template <typename Number>
POLARGRAIN_INLINE Number greater(Number a, Number b) {
  return a > b ? a : b;
}
/// Whole numbers as wide as the lanes of a number, for their bits.
template <typename Number>
struct BitsOf {
  using Type [[gnu::vector_size(sizeof(Number))]] = long long;
};
inline constexpr long long kSignBit = -0x7fffffffffffffff - 1;
template <typename Number>
POLARGRAIN_INLINE Number magnitude(Number a) {
  if constexpr (kWidth<Number> == 1) {
    return __builtin_fabs(a);
  } else {
    using Bits = typename BitsOf<Number>::Type;
    return reinterpret_cast<Number>(reinterpret_cast<Bits>(a) & ~kSignBit);
  }
}
/// `a` with the sign of `b`; `a` is not negative.
template <typename Number>
POLARGRAIN_INLINE Number with_sign_of(Number a, Number b) {
  if constexpr (kWidth<Number> == 1) {
    return __builtin_copysign(a, b);
  } else {
    using Bits = typename BitsOf<Number>::Type;
    return reinterpret_cast<Number>(reinterpret_cast<Bits>(a) | (reinterpret_cast<Bits>(b) & kSignBit));
  }
}
/// @param chosen the result of a comparison
template <typename Choice, typename Number>
POLARGRAIN_INLINE Number select(Choice chosen, Number yes, Number no) {
  return chosen ? yes : no;
}
/// Whether a comparison holds in any lane.
template <typename Choice>
POLARGRAIN_INLINE bool any(Choice chosen) {
  if constexpr (sizeof(Choice) <= sizeof(int)) {
    return chosen;
  } else {
#if defined(__AVX512DQ__)
    if constexpr (sizeof(Choice) == 64)
      return __builtin_ia32_cvtq2mask512(reinterpret_cast<BitsOf<Lanes<8>>::Type>(chosen)) != 0;
#endif
#if defined(__AVX__)
    if constexpr (sizeof(Choice) == 32)
      return __builtin_ia32_movmskpd256(reinterpret_cast<Lanes<4>>(chosen)) != 0;
#endif
#if defined(__SSE2__)
    if constexpr (sizeof(Choice) == 16)
      return __builtin_ia32_movmskpd(reinterpret_cast<Lanes<2>>(chosen)) != 0;
#endif
    long long sum = 0;
    for (unsigned lane = 0; lane < sizeof(Choice) / sizeof(long long); ++lane) sum |= chosen[lane];
    return sum != 0;
  }
}

/// A vector of space, in every lane.
template <typename Number>
struct Vector {
  Number x, y, z;
};
template <typename Number>
POLARGRAIN_INLINE Vector<Number> operator+(const Vector<Number>& a, const Vector<Number>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <typename Number>
POLARGRAIN_INLINE Vector<Number> operator-(const Vector<Number>& a, const Vector<Number>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <typename Number>
POLARGRAIN_INLINE Vector<Number> operator*(Number factor, const Vector<Number>& a) {
  return {factor * a.x, factor * a.y, factor * a.z};
}
template <typename Number>
POLARGRAIN_INLINE Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename Number>
POLARGRAIN_INLINE Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A vector of one grain: a row where the instruction set has registers of four numbers, else its numbers one by one.
struct Triple {
  double x, y, z;
};
POLARGRAIN_INLINE Triple operator+(const Triple& a, const Triple& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
POLARGRAIN_INLINE Triple operator-(const Triple& a, const Triple& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
POLARGRAIN_INLINE Triple operator*(double factor, const Triple& a) {
  return {factor * a.x, factor * a.y, factor * a.z};
}
template <int Width>
struct OneGrain {
  using Numbers = Row;
};
template <>
struct OneGrain<1> {
  using Numbers = Triple;
};
template <>
struct OneGrain<2> {
  using Numbers = Triple;
};
POLARGRAIN_INLINE void read(const double* row, Row& to) {
  to = load<Row>(row);
}
POLARGRAIN_INLINE void read(const double* row, Triple& to) {
  to = {row[0], row[1], row[2]};
}
/// The fourth number of a row stays as it is: a row read with it, or zero.
POLARGRAIN_INLINE void write(double* row, Row from) {
  store(row, from);
}
POLARGRAIN_INLINE void write(double* row, const Triple& from) {
  row[0] = from.x;
  row[1] = from.y;
  row[2] = from.z;
}
/// first x + second y + third z
POLARGRAIN_INLINE Row combined(Row first, Row second, Row third, Row a) {
  return first * __builtin_shufflevector(a, a, 0, 0, 0, 0) +
         second * __builtin_shufflevector(a, a, 1, 1, 1, 1) +
         third * __builtin_shufflevector(a, a, 2, 2, 2, 2);
}
POLARGRAIN_INLINE Triple combined(const Triple& first, const Triple& second, const Triple& third,
                                  const Triple& a) {
  return a.x * first + a.y * second + a.z * third;
}
POLARGRAIN_INLINE double square_of(Row a) {
  const Row squares = a * a;
  const Row pairs = squares + __builtin_shufflevector(squares, squares, 1, 0, 3, 2);
  return pairs[0] + pairs[2];
}
POLARGRAIN_INLINE double square_of(const Triple& a) {
  return a.x * a.x + a.y * a.y + a.z * a.z;
}

/// From rows to columns: lane l of column k is number k of row l. @param row_at gives, as what its last argument is, a part
/// of the row of a lane from a number on
template <typename Number, typename RowAt>
POLARGRAIN_INLINE void columns_of(RowAt row_at, Number (&columns)[4]) {
  if constexpr (kWidth<Number> == 1) {
    for (int k = 0; k < 4; ++k) columns[k] = row_at(0, k, 0.0);
  } else if constexpr (kWidth<Number> == 2) {
    for (int k = 0; k < 4; k += 2) {
      const Number a = row_at(0, k, Number{});
      const Number b = row_at(1, k, Number{});
      columns[k] = __builtin_shufflevector(a, b, 0, 2);
      columns[k + 1] = __builtin_shufflevector(a, b, 1, 3);
    }
  } else if constexpr (kWidth<Number> == 4) {
    const Row a = row_at(0, 0, Row{}), b = row_at(1, 0, Row{}), c = row_at(2, 0, Row{}),
              d = row_at(3, 0, Row{});
    const Row ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6);
    const Row ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Row cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6);
    const Row cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    columns[0] = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
    columns[1] = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
    columns[2] = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
    columns[3] = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
  } else {
    const auto two = [&row_at](int low, int high) POLARGRAIN_INLINE_LAMBDA {
      return __builtin_shufflevector(row_at(low, 0, Row{}), row_at(high, 0, Row{}), 0, 1, 2, 3, 4, 5, 6, 7);
    };
    const Number a = two(0, 2), b = two(1, 3), c = two(4, 6), d = two(5, 7);
    const Number ab_even = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
    const Number ab_odd = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    const Number cd_even = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
    const Number cd_odd = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
    columns[0] = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5, 8, 9, 12, 13);
    columns[1] = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5, 8, 9, 12, 13);
    columns[2] = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7, 10, 11, 14, 15);
    columns[3] = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7, 10, 11, 14, 15);
  }
}

/// Columns of the rows `index[l]`. Rows are Stride numbers apart.
template <int Stride, typename Number>
POLARGRAIN_INLINE void load_columns(const double* rows, const int* index, Number (&columns)[4]) {
  columns_of(
      [rows, index]<typename Part>(int lane, int k, Part)
          POLARGRAIN_INLINE_LAMBDA { return load<Part>(rows + static_cast<long>(index[lane]) * Stride + k); },
      columns);
}

/// A vector of one lane, in the form in which it is added to a row of memory fastest.
template <int Width>
struct RowOfLane {
  Row row{};
  POLARGRAIN_INLINE RowOfLane with_fourth_as_third() const {
    return {__builtin_shufflevector(row, row, 0, 1, 3, 3)};
  }
  /// @param bits that are kept of the sum
  POLARGRAIN_INLINE RowOfLane plus_kept(const RowOfLane& sum, long long bits) const {
    using Bits = typename BitsOf<Row>::Type;
    return {reinterpret_cast<Row>(reinterpret_cast<Bits>(sum.row) & bits) + row};
  }
  POLARGRAIN_INLINE void put(double* place) const { store(place, row); }
  POLARGRAIN_INLINE void add_to(double* sum) const { store(sum, load<Row>(sum) + row); }
  POLARGRAIN_INLINE void take_from(double* sum) const { store(sum, load<Row>(sum) - row); }
};
template <>
struct RowOfLane<1> {
  double x, y, z;
  POLARGRAIN_INLINE void add_to(double* sum) const {
    sum[0] += x;
    sum[1] += y;
    sum[2] += z;
  }
  POLARGRAIN_INLINE void take_from(double* sum) const {
    sum[0] -= x;
    sum[1] -= y;
    sum[2] -= z;
  }
};
template <>
struct RowOfLane<2> {
  Lanes<2> low{}, high{};
  POLARGRAIN_INLINE RowOfLane with_fourth_as_third() const {
    return {low, __builtin_shufflevector(high, high, 1, 1)};
  }
  POLARGRAIN_INLINE RowOfLane plus_kept(const RowOfLane& sum, long long bits) const {
    using Bits = typename BitsOf<Lanes<2>>::Type;
    return {reinterpret_cast<Lanes<2>>(reinterpret_cast<Bits>(sum.low) & bits) + low,
            reinterpret_cast<Lanes<2>>(reinterpret_cast<Bits>(sum.high) & bits) + high};
  }
  POLARGRAIN_INLINE void put(double* place) const {
    store(place, low);
    store(place + 2, high);
  }
  POLARGRAIN_INLINE void add_to(double* sum) const {
    store(sum, load<Lanes<2>>(sum) + low);
    store(sum + 2, load<Lanes<2>>(sum + 2) + high);
  }
  POLARGRAIN_INLINE void take_from(double* sum) const {
    store(sum, load<Lanes<2>>(sum) - low);
    store(sum + 2, load<Lanes<2>>(sum + 2) - high);
  }
};

/// From columns to rows, one a lane. One lane has no fourth column.
template <typename Number>
POLARGRAIN_INLINE void rows_of(const Vector<Number>& a, Number fourth,
                               RowOfLane<kWidth<Number>> (&rows)[kWidth<Number>]) {
  if constexpr (kWidth<Number> == 1) {
    rows[0] = {a.x, a.y, a.z};
  } else if constexpr (kWidth<Number> == 2) {
    rows[0] = {__builtin_shufflevector(a.x, a.y, 0, 2), __builtin_shufflevector(a.z, fourth, 0, 2)};
    rows[1] = {__builtin_shufflevector(a.x, a.y, 1, 3), __builtin_shufflevector(a.z, fourth, 1, 3)};
  } else if constexpr (kWidth<Number> == 4) {
    const Row xy_even = __builtin_shufflevector(a.x, a.y, 0, 4, 2, 6);
    const Row xy_odd = __builtin_shufflevector(a.x, a.y, 1, 5, 3, 7);
    const Row z_even = __builtin_shufflevector(a.z, fourth, 0, 4, 2, 6);
    const Row z_odd = __builtin_shufflevector(a.z, fourth, 1, 5, 3, 7);
    rows[0].row = __builtin_shufflevector(xy_even, z_even, 0, 1, 4, 5);
    rows[1].row = __builtin_shufflevector(xy_odd, z_odd, 0, 1, 4, 5);
    rows[2].row = __builtin_shufflevector(xy_even, z_even, 2, 3, 6, 7);
    rows[3].row = __builtin_shufflevector(xy_odd, z_odd, 2, 3, 6, 7);
  } else {
    const Number xy_even = __builtin_shufflevector(a.x, a.y, 0, 8, 2, 10, 4, 12, 6, 14);
    const Number xy_odd = __builtin_shufflevector(a.x, a.y, 1, 9, 3, 11, 5, 13, 7, 15);
    const Number z_even = __builtin_shufflevector(a.z, fourth, 0, 8, 2, 10, 4, 12, 6, 14);
    const Number z_odd = __builtin_shufflevector(a.z, fourth, 1, 9, 3, 11, 5, 13, 7, 15);
    const auto part = [&rows](const Number& both, int low, int high) {
      rows[low].row = __builtin_shufflevector(both, both, 0, 1, 2, 3);
      rows[high].row = __builtin_shufflevector(both, both, 4, 5, 6, 7);
    };
    part(__builtin_shufflevector(xy_even, z_even, 0, 1, 8, 9, 2, 3, 10, 11), 0, 2);
    part(__builtin_shufflevector(xy_even, z_even, 4, 5, 12, 13, 6, 7, 14, 15), 4, 6);
    part(__builtin_shufflevector(xy_odd, z_odd, 0, 1, 8, 9, 2, 3, 10, 11), 1, 3);
    part(__builtin_shufflevector(xy_odd, z_odd, 4, 5, 12, 13, 6, 7, 14, 15), 5, 7);
  }
}
template <typename Number>
POLARGRAIN_INLINE void rows_of(const Vector<Number>& a, RowOfLane<kWidth<Number>> (&rows)[kWidth<Number>]) {
  rows_of(a, Number{}, rows);
}

}  // namespace
}  // namespace polargrain::dem
