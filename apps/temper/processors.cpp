#include "processors.hpp"

#ifdef __linux__
#include <sched.h>
#endif

#include <algorithm>
#include <bit>
#include <cstring>

namespace temper::app {

#ifdef __linux__

namespace {
// Of all processors that Linux can be built for; what it has set of them comes first.
constexpr std::size_t kMost = 8192;
using Mask = unsigned long[kMost / (8 * sizeof(unsigned long))];  // NOLINT(google-runtime-int): as the system has it

/// To those of these that the system lets this process run on.
bool bind_to(const std::string& processors) {
  Mask mask = {};
  std::memcpy(mask, processors.data(), std::min(sizeof mask, processors.size()));
  return sched_setaffinity(0, sizeof mask, reinterpret_cast<const cpu_set_t*>(mask)) == 0;
}

}  // namespace

std::string own_processors() {
  Mask mask = {};
  if (sched_getaffinity(0, sizeof mask, reinterpret_cast<cpu_set_t*>(mask)) != 0) return {};
  std::string processors(sizeof mask, '\0');
  std::memcpy(processors.data(), mask, sizeof mask);
  return processors;
}

bool run_on(const std::string& processors) {
  const std::string before = own_processors();
  if (bind_to(processors) && own_processors() == processors) return true;
  static_cast<void>(bind_to(before));  // the system may have left out some
  return false;
}

#else

std::string own_processors() { return {}; }
bool run_on(const std::string&) { return true; }

#endif

std::string both(std::string a, const std::string& b) {
  a.resize(std::max(a.size(), b.size()), '\0');
  for (std::size_t i = 0; i < b.size(); ++i) a[i] = static_cast<char>(a[i] | b[i]);
  return a;
}

std::size_t count_processors(const std::string& processors) {
  std::size_t n = 0;
  for (const char byte : processors) n += static_cast<std::size_t>(std::popcount(static_cast<unsigned char>(byte)));
  return n;
}

}  // namespace temper::app
