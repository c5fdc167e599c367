// TEMPER_SANITIZED: 1 where AddressSanitizer or ThreadSanitizer watches the program, which takes time and terabytes of
// address space; else 0.
#pragma once

#if defined(__has_feature)
#define TEMPER_SANITIZED (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TEMPER_SANITIZED 1
#else
#define TEMPER_SANITIZED 0
#endif
