// Eight doubles in one operation, whatever the machine: one register of AVX-512, two of AVX, four of SSE2, NEON or
// WebAssembly.
//
// Each operation is the IEEE 754 operation on every lane, in the order written, never contracted: every instruction set
// gives the same bits. Sources that use packs are compiled once for each set. A linker must never give code of one set
// to another. So everything here is always inlined, in a namespace of its set, and so must be all code that uses it.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "base/compiler.hpp"

// The build names the set; compilers do not choose it. So a build for a newer processor still contains all sets.
#if defined(TEMPER_FOR_AVX512)
#define TEMPER_INSTRUCTION_SET avx512
#define TEMPER_REGISTER_BYTES 64
#elif defined(TEMPER_FOR_AVX2)
#define TEMPER_INSTRUCTION_SET avx2
#define TEMPER_REGISTER_BYTES 32
#else
#define TEMPER_INSTRUCTION_SET baseline
#define TEMPER_REGISTER_BYTES 16
#endif

namespace temper {

inline constexpr std::size_t kLanes = 8;

// The functions of a pack, for one double: formulas are written once for both.
TEMPER_INLINE double square_root(double x) { return std::sqrt(x); }
TEMPER_INLINE double absolute(double x) { return std::fabs(x); }
TEMPER_INLINE double select(bool condition, double a, double b) { return condition ? a : b; }
TEMPER_INLINE long double square_root(long double x) { return std::sqrt(x); }  // of tests
TEMPER_INLINE long double select(bool condition, long double a, long double b) { return condition ? a : b; }

// A normal x > 0 is mantissa(x) 2^exponent(x) with mantissa in [√½, √2). In bits it is √½ plus the rest above it.
inline constexpr std::uint64_t kHalfRoot = 0x3fe6'a09e'667f'3bcd, kFraction = 0x000f'ffff'ffff'ffff;
// The exponent and 1023 in the last bits of 2^52 is that sum, as a double.
inline constexpr std::uint64_t kBiased = std::uint64_t{1023} << 52, kTwo52 = 0x4330'0000'0000'0000;
inline constexpr double kTwo52And1023 = 0x1p52 + 1023;
TEMPER_INLINE double mantissa(double x) {
  return std::bit_cast<double>(((std::bit_cast<std::uint64_t>(x) - kHalfRoot) & kFraction) + kHalfRoot);
}
TEMPER_INLINE double exponent(double x) {
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(x) - kHalfRoot + kBiased) >> 52 | kTwo52) - kTwo52And1023;
}

/// x in every lane.
template <class T>
TEMPER_INLINE T all(double x) {
  if constexpr (requires { T::all(x); }) {
    return T::all(x);
  } else {
    return x;
  }
}

namespace TEMPER_INSTRUCTION_SET {

#if (defined(__GNUC__) || defined(__clang__)) && !defined(TEMPER_PLAIN_REGISTERS)

/// A register of the hardware: some doubles, and the mask of a comparison.
struct Register {
  static constexpr std::size_t kSize = TEMPER_REGISTER_BYTES / sizeof(double);
  using Doubles [[gnu::vector_size(TEMPER_REGISTER_BYTES)]] = double;
  using Bits [[gnu::vector_size(TEMPER_REGISTER_BYTES)]] = std::int64_t;
  using Words [[gnu::vector_size(TEMPER_REGISTER_BYTES)]] = std::uint64_t;

#if TEMPER_REGISTER_BYTES == 64
  // One bit per lane: the processor has registers of their own for these.
  struct Mask {
    __mmask8 m;
    TEMPER_INLINE static Mask load(const std::int64_t* p) { return {_mm512_movepi64_mask(_mm512_loadu_si512(p))}; }
    friend TEMPER_INLINE Mask operator&(Mask a, Mask b) { return {static_cast<__mmask8>(a.m & b.m)}; }
    friend TEMPER_INLINE Mask operator|(Mask a, Mask b) { return {static_cast<__mmask8>(a.m | b.m)}; }
    friend TEMPER_INLINE Mask operator~(Mask a) { return {static_cast<__mmask8>(~a.m)}; }
    /// Bit i: lane i.
    [[nodiscard]] TEMPER_INLINE unsigned bits() const { return m; }
  };
#else
  // All bits of a lane set, or none.
  struct Mask {
    Bits m;
    TEMPER_INLINE static Mask load(const std::int64_t* p) {
      Mask r;
      std::memcpy(&r.m, p, sizeof r.m);
      return r;
    }
    friend TEMPER_INLINE Mask operator&(Mask a, Mask b) { return {a.m & b.m}; }
    friend TEMPER_INLINE Mask operator|(Mask a, Mask b) { return {a.m | b.m}; }
    friend TEMPER_INLINE Mask operator~(Mask a) { return {~a.m}; }
    /// Bit i: lane i.
    [[nodiscard]] TEMPER_INLINE unsigned bits() const {
#if TEMPER_REGISTER_BYTES == 32
      return static_cast<unsigned>(_mm256_movemask_pd((__m256d)m));
#elif defined(TEMPER_SSE2)
      return static_cast<unsigned>(_mm_movemask_pd((__m128d)m));
#else
      return (m[0] != 0 ? 1U : 0U) | (m[1] != 0 ? 2U : 0U);
#endif
    }
  };
#endif

  Doubles v;

  TEMPER_INLINE static Register all(double x) { return {x - Doubles{}}; }
  TEMPER_INLINE static Register load(const double* p) {
    Register r;
    std::memcpy(&r.v, p, sizeof r.v);
    return r;
  }
  TEMPER_INLINE void store(double* p) const { std::memcpy(p, &v, sizeof v); }

  friend TEMPER_INLINE Register operator+(Register a, Register b) { return {a.v + b.v}; }
  friend TEMPER_INLINE Register operator-(Register a, Register b) { return {a.v - b.v}; }
  friend TEMPER_INLINE Register operator*(Register a, Register b) { return {a.v * b.v}; }
  friend TEMPER_INLINE Register operator/(Register a, Register b) { return {a.v / b.v}; }
  friend TEMPER_INLINE Register operator-(Register a) { return {-a.v}; }
  friend TEMPER_INLINE Register operator+(double a, Register b) { return {a + b.v}; }
  friend TEMPER_INLINE Register operator-(double a, Register b) { return {a - b.v}; }
  friend TEMPER_INLINE Register operator*(double a, Register b) { return {a * b.v}; }
  friend TEMPER_INLINE Register operator/(double a, Register b) { return {a / b.v}; }
  friend TEMPER_INLINE Register operator+(Register a, double b) { return {a.v + b}; }
#if TEMPER_REGISTER_BYTES == 64
  friend TEMPER_INLINE Mask operator<(Register a, Register b) {
    return {_mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_LT_OQ)};
  }
  friend TEMPER_INLINE Mask operator>(Register a, Register b) {
    return {_mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_GT_OQ)};
  }
  friend TEMPER_INLINE Mask operator>=(Register a, Register b) {
    return {_mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_GE_OQ)};
  }
  friend TEMPER_INLINE Register select(Mask m, Register a, Register b) {
    return {(Doubles)_mm512_mask_blend_pd(m.m, (__m512d)b.v, (__m512d)a.v)};
  }
#else
  friend TEMPER_INLINE Mask operator<(Register a, Register b) { return {a.v < b.v}; }
  friend TEMPER_INLINE Mask operator>(Register a, Register b) { return {a.v > b.v}; }
  friend TEMPER_INLINE Mask operator>=(Register a, Register b) { return {a.v >= b.v}; }
  friend TEMPER_INLINE Register select(Mask m, Register a, Register b) { return {m.m ? a.v : b.v}; }
#endif
  friend TEMPER_INLINE Mask operator<(Register a, double b) { return a < all(b); }
  friend TEMPER_INLINE Mask operator>(Register a, double b) { return a > all(b); }
  friend TEMPER_INLINE Mask operator>=(Register a, double b) { return a >= all(b); }
  friend TEMPER_INLINE Register square_root(Register a) {
#if TEMPER_REGISTER_BYTES == 64
    return {(Doubles)_mm512_maskz_sqrt_pd(0xff, (__m512d)a.v)};  // GCC 12 warns about the one without mask
#elif TEMPER_REGISTER_BYTES == 32
    return {(Doubles)_mm256_sqrt_pd((__m256d)a.v)};
#elif defined(TEMPER_SSE2)
    return {(Doubles)_mm_sqrt_pd((__m128d)a.v)};
#else
    return {Doubles{std::sqrt(a.v[0]), std::sqrt(a.v[1])}};
#endif
  }
  friend TEMPER_INLINE Register absolute(Register a) {
    return {(Doubles)((Bits)a.v & (0x7fff'ffff'ffff'ffff - Bits{}))};
  }
  friend TEMPER_INLINE Register mantissa(Register a) {
    return {(Doubles)((((Words)a.v - kHalfRoot) & kFraction) + kHalfRoot)};
  }
  friend TEMPER_INLINE Register exponent(Register a) {
    return {(Doubles)(((Words)a.v - kHalfRoot + kBiased) >> 52 | kTwo52) - kTwo52And1023};
  }
  /// Lanes of the two halves first, and so on: the same order whatever the registers.
  friend TEMPER_INLINE double sum(Register a) {
#if TEMPER_REGISTER_BYTES == 64
    // GCC 12 warns of its own variables in the extraction without a mask.
    const __m256d four =
        _mm512_maskz_extractf64x4_pd(15, (__m512d)a.v, 0) + _mm512_maskz_extractf64x4_pd(15, (__m512d)a.v, 1);
    const __m128d two = _mm256_castpd256_pd128(four) + _mm256_extractf128_pd(four, 1);
    return two[0] + two[1];
#elif TEMPER_REGISTER_BYTES == 32
    const __m128d two = _mm256_castpd256_pd128((__m256d)a.v) + _mm256_extractf128_pd((__m256d)a.v, 1);
    return two[0] + two[1];
#else
    return a.v[0] + a.v[1];
#endif
  }
};

#else

/// The same in standard C++: slower, with the same bits.
struct Register {
  static constexpr std::size_t kSize = TEMPER_REGISTER_BYTES / sizeof(double);
  struct Mask {
    unsigned m;  // bit i: lane i
    template <class Test>
    TEMPER_INLINE static Mask of(Test test) {
      unsigned m = 0;
      for (std::size_t i = 0; i < kSize; ++i) m |= (test(i) ? 1U : 0U) << i;
      return {m};
    }
    TEMPER_INLINE static Mask load(const std::int64_t* p) {
      return of([p](std::size_t i) { return p[i] != 0; });
    }
    friend TEMPER_INLINE Mask operator&(Mask a, Mask b) { return {a.m & b.m}; }
    friend TEMPER_INLINE Mask operator|(Mask a, Mask b) { return {a.m | b.m}; }
    friend TEMPER_INLINE Mask operator~(Mask a) { return {~a.m & ((1U << kSize) - 1)}; }
    [[nodiscard]] TEMPER_INLINE unsigned bits() const { return m; }
  };

  double v[kSize];

  template <class Value>
  TEMPER_INLINE static Register of(Value value) {
    Register r;
    for (std::size_t i = 0; i < kSize; ++i) r.v[i] = value(i);
    return r;
  }
  TEMPER_INLINE static Register all(double x) {
    return of([x](std::size_t) { return x; });
  }
  TEMPER_INLINE static Register load(const double* p) {
    return of([p](std::size_t i) { return p[i]; });
  }
  TEMPER_INLINE void store(double* p) const { std::memcpy(p, v, sizeof v); }

  friend TEMPER_INLINE Register operator+(Register a, Register b) {
    return of([&](std::size_t i) { return a.v[i] + b.v[i]; });
  }
  friend TEMPER_INLINE Register operator-(Register a, Register b) {
    return of([&](std::size_t i) { return a.v[i] - b.v[i]; });
  }
  friend TEMPER_INLINE Register operator*(Register a, Register b) {
    return of([&](std::size_t i) { return a.v[i] * b.v[i]; });
  }
  friend TEMPER_INLINE Register operator/(Register a, Register b) {
    return of([&](std::size_t i) { return a.v[i] / b.v[i]; });
  }
  friend TEMPER_INLINE Register operator-(Register a) {
    return of([&](std::size_t i) { return -a.v[i]; });
  }
  friend TEMPER_INLINE Register operator+(double a, Register b) { return all(a) + b; }
  friend TEMPER_INLINE Register operator-(double a, Register b) { return all(a) - b; }
  friend TEMPER_INLINE Register operator*(double a, Register b) { return all(a) * b; }
  friend TEMPER_INLINE Register operator/(double a, Register b) { return all(a) / b; }
  friend TEMPER_INLINE Register operator+(Register a, double b) { return a + all(b); }
  friend TEMPER_INLINE Mask operator<(Register a, Register b) {
    return Mask::of([&](std::size_t i) { return a.v[i] < b.v[i]; });
  }
  friend TEMPER_INLINE Mask operator>(Register a, Register b) { return b < a; }
  friend TEMPER_INLINE Mask operator>=(Register a, Register b) {
    return Mask::of([&](std::size_t i) { return a.v[i] >= b.v[i]; });
  }
  friend TEMPER_INLINE Mask operator<(Register a, double b) { return a < all(b); }
  friend TEMPER_INLINE Mask operator>(Register a, double b) { return a > all(b); }
  friend TEMPER_INLINE Mask operator>=(Register a, double b) { return a >= all(b); }
  friend TEMPER_INLINE Register select(Mask m, Register a, Register b) {
    return of([&](std::size_t i) { return (m.m >> i & 1U) != 0 ? a.v[i] : b.v[i]; });
  }
  friend TEMPER_INLINE Register square_root(Register a) {
    return of([&](std::size_t i) { return square_root(a.v[i]); });
  }
  friend TEMPER_INLINE Register absolute(Register a) {
    return of([&](std::size_t i) { return absolute(a.v[i]); });
  }
  friend TEMPER_INLINE Register mantissa(Register a) {
    return of([&](std::size_t i) { return mantissa(a.v[i]); });
  }
  friend TEMPER_INLINE Register exponent(Register a) {
    return of([&](std::size_t i) { return exponent(a.v[i]); });
  }
  friend TEMPER_INLINE double sum(Register a) {
    for (std::size_t n = kSize / 2; n > 0; n /= 2) {
      for (std::size_t i = 0; i < n; ++i) a.v[i] += a.v[i + n];
    }
    return a.v[0];
  }
};

#endif

/// Twice as many doubles as Half has.
template <class Half, std::size_t N>
struct Pair {
  struct Mask {
    typename Half::Mask low, high;
    TEMPER_INLINE static Mask load(const std::int64_t* p) { return {Half::Mask::load(p), Half::Mask::load(p + N / 2)}; }
    friend TEMPER_INLINE Mask operator&(Mask a, Mask b) { return {a.low & b.low, a.high & b.high}; }
    friend TEMPER_INLINE Mask operator|(Mask a, Mask b) { return {a.low | b.low, a.high | b.high}; }
    friend TEMPER_INLINE Mask operator~(Mask a) { return {~a.low, ~a.high}; }
    [[nodiscard]] TEMPER_INLINE unsigned bits() const { return low.bits() | high.bits() << (N / 2); }
  };

  Half low, high;

  TEMPER_INLINE static Pair all(double x) { return {Half::all(x), Half::all(x)}; }
  TEMPER_INLINE static Pair load(const double* p) { return {Half::load(p), Half::load(p + N / 2)}; }
  TEMPER_INLINE void store(double* p) const {
    low.store(p);
    high.store(p + N / 2);
  }
  friend TEMPER_INLINE Pair operator+(Pair a, Pair b) { return {a.low + b.low, a.high + b.high}; }
  friend TEMPER_INLINE Pair operator-(Pair a, Pair b) { return {a.low - b.low, a.high - b.high}; }
  friend TEMPER_INLINE Pair operator*(Pair a, Pair b) { return {a.low * b.low, a.high * b.high}; }
  friend TEMPER_INLINE Pair operator/(Pair a, Pair b) { return {a.low / b.low, a.high / b.high}; }
  friend TEMPER_INLINE Pair operator-(Pair a) { return {-a.low, -a.high}; }
  friend TEMPER_INLINE Pair operator+(double a, Pair b) { return {a + b.low, a + b.high}; }
  friend TEMPER_INLINE Pair operator-(double a, Pair b) { return {a - b.low, a - b.high}; }
  friend TEMPER_INLINE Pair operator*(double a, Pair b) { return {a * b.low, a * b.high}; }
  friend TEMPER_INLINE Pair operator/(double a, Pair b) { return {a / b.low, a / b.high}; }
  friend TEMPER_INLINE Pair operator+(Pair a, double b) { return {a.low + b, a.high + b}; }
  friend TEMPER_INLINE Mask operator<(Pair a, Pair b) { return {a.low < b.low, a.high < b.high}; }
  friend TEMPER_INLINE Mask operator>(Pair a, Pair b) { return {a.low > b.low, a.high > b.high}; }
  friend TEMPER_INLINE Mask operator>=(Pair a, Pair b) { return {a.low >= b.low, a.high >= b.high}; }
  friend TEMPER_INLINE Mask operator<(Pair a, double b) { return a < all(b); }
  friend TEMPER_INLINE Mask operator>(Pair a, double b) { return a > all(b); }
  friend TEMPER_INLINE Mask operator>=(Pair a, double b) { return a >= all(b); }
  friend TEMPER_INLINE Pair select(Mask m, Pair a, Pair b) {
    return {select(m.low, a.low, b.low), select(m.high, a.high, b.high)};
  }
  friend TEMPER_INLINE Pair square_root(Pair a) { return {square_root(a.low), square_root(a.high)}; }
  friend TEMPER_INLINE Pair absolute(Pair a) { return {absolute(a.low), absolute(a.high)}; }
  friend TEMPER_INLINE Pair mantissa(Pair a) { return {mantissa(a.low), mantissa(a.high)}; }
  friend TEMPER_INLINE Pair exponent(Pair a) { return {exponent(a.low), exponent(a.high)}; }
  friend TEMPER_INLINE double sum(Pair a) { return sum(a.low + a.high); }
};

#if TEMPER_REGISTER_BYTES == 64
using Pack = Register;
#elif TEMPER_REGISTER_BYTES == 32
using Pack = Pair<Register, 8>;
#else
using Pack = Pair<Pair<Register, 4>, 8>;
#endif

}  // namespace TEMPER_INSTRUCTION_SET
}  // namespace temper
