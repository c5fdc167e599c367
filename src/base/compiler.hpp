// What compilers and processors have each in their own way. Only this file and pack.hpp may use it: all other code is
// standard C++, and scripts/check_layers.py keeps it so.
#pragma once

#if defined(__SSE2__) || defined(_M_X64)
#define TEMPER_SSE2
#include <immintrin.h>
#endif

#if defined(__GNUC__) || defined(__clang__)
#define TEMPER_INLINE __attribute__((always_inline)) inline
#else
#include <intrin.h>
#define TEMPER_INLINE __forceinline
#endif

namespace temper {

/// Starts to fetch memory that is needed soon.
TEMPER_INLINE void prefetch(const void* p) {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(p);
#elif defined(TEMPER_SSE2)
  _mm_prefetch(static_cast<const char*>(p), _MM_HINT_T0);
#endif
}

#if !defined(TEMPER_X86_SETS)
#elif defined(__GNUC__) || defined(__clang__)
inline bool has_avx2() { return __builtin_cpu_supports("avx2"); }
inline bool has_avx512() { return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"); }
#else
/// Says whether the processor has features of leaf 7, and the system keeps the registers of these bits.
inline bool has_features(int features, unsigned long long registers) {
  int leaf[4] = {};
  __cpuid(leaf, 1);
  constexpr int kSystemTells = 1 << 27;
  if ((leaf[2] & kSystemTells) == 0 || (_xgetbv(0) & registers) != registers) return false;
  __cpuidex(leaf, 7, 0);
  return (leaf[1] & features) == features;
}
inline bool has_avx2() { return has_features(1 << 5, 0x06); }
inline bool has_avx512() { return has_features(1 << 16 | 1 << 17, 0xe6); }
#endif

}  // namespace temper
