// Assertions for bugs, in three levels. Bad input is never an assertion: it comes back as InputError.
//
//   TEMPER_ASSERT_LEVEL 0   nothing (the default of a release)
//                       1   TEMPER_ASSERT: checks that cost at most as much as the code they guard
//                       2   also TEMPER_ASSERT_SLOW: exact predicates, walks around a vertex (presets dev and asan).
//
// The level is one of the whole build, tests included: private headers with assertions are inlined on both sides.
#pragma once

#include <cassert>
#include <cstdlib>

#ifndef TEMPER_ASSERT_LEVEL
#define TEMPER_ASSERT_LEVEL 0
#endif

#if TEMPER_ASSERT_LEVEL >= 1
#ifdef NDEBUG  // the standard macro names file and line, but an optimized build turns it off
#define TEMPER_ASSERT(condition) ((condition) ? static_cast<void>(0) : std::abort())
#else
#define TEMPER_ASSERT(condition) assert(condition)
#endif
#else
#define TEMPER_ASSERT(condition) static_cast<void>(0)
#endif

#if TEMPER_ASSERT_LEVEL >= 2
#define TEMPER_ASSERT_SLOW(condition) TEMPER_ASSERT(condition)
#else
#define TEMPER_ASSERT_SLOW(condition) static_cast<void>(0)
#endif
