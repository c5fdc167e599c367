// The targets without libFuzzer, for any compiler and a few seconds: each seed, then mutations of seeds. It sees no
// coverage; what it finds is what a reader does on nearly right files.
//
//   fuzz_smoke SECONDS[:FROM] [TARGET …]
//
// SECONDS are for each target. FROM, 0 if it is not given, is the number of the first mutation. What ends a run is left
// in crash-TARGET.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "base/rng.hpp"
#include "target.hpp"

// Of the sanitizers' run time, where there is one.
extern "C" __attribute__((weak)) void __sanitizer_set_death_callback(void (*callback)());

namespace temper::fuzz {
namespace {

using Clock = std::chrono::steady_clock;

std::string current_target, current_input;

void keep_input() {
  std::ofstream("crash-" + current_target, std::ios::binary) << current_input;
  std::fprintf(stderr, "fuzz_smoke: what did it is in crash-%s\n", current_target.c_str());
}

extern "C" void keep_input_of_abort(int) {
  keep_input();
  std::_Exit(1);
}

std::size_t somewhere(Rng& rng, std::size_t n) { return n == 0 ? 0 : rng.next() % n; }

/// One change, of the kinds that damage files: a byte, a number, a piece gone, twice, or from another seed.
void mutate(std::string& bytes, const std::vector<std::string>& seeds, Rng& rng) {
  const std::size_t at = somewhere(rng, bytes.size() + 1);
  const std::size_t n = std::min(bytes.size() - at, std::size_t{1} << rng.below(8));
  const std::string& other = seeds[somewhere(rng, seeds.size())];
  constexpr std::string_view kPieces[] = {"0",  "-1", "1e999", "4294967295", "18446744073709551615", "nan", "\n", " ",
                                          "\"", "<",  "[",     "\x1b"};
  switch (rng.below(7)) {
    case 0:
      if (at < bytes.size()) bytes[at] = static_cast<char>(rng.below(256));
      return;
    case 1:
      if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << rng.below(8)));
      return;
    case 2:
      bytes.insert(at, kPieces[rng.below(std::size(kPieces))]);
      return;
    case 3:
      bytes.replace(at, n, kPieces[rng.below(std::size(kPieces))]);
      return;
    case 4:
      bytes.erase(at, n);
      return;
    case 5:
      bytes.insert(at, bytes.substr(at, n));
      return;
    default:
      bytes.insert(at, other.substr(somewhere(rng, other.size()), n));
  }
}

std::size_t smoke(const Target& target, double seconds, std::uint64_t from) {
  current_target = target.name;
  const std::vector<std::string> seeds = seeds_and_finds(target);
  insist(!seeds.empty(), "there are seeds of " + target.name);
  const auto until = Clock::now() + std::chrono::duration<double>(seconds);
  std::size_t n = 0;
  const auto once = [&](std::string bytes) {
    current_input = std::move(bytes);
    target.run(current_input);
    ++n;
  };
  for (const std::string& seed : seeds) once(seed);
  for (std::uint64_t i = from; Clock::now() < until; ++i) {
    Rng rng(i);
    std::string bytes = seeds[somewhere(rng, seeds.size())];
    for (std::uint32_t k = 0; k <= rng.below(4); ++k) mutate(bytes, seeds, rng);
    once(std::move(bytes));
  }
  return n;
}

}  // namespace
}  // namespace temper::fuzz

int main(int argc, char** argv) {
  using namespace temper::fuzz;
  if (argc < 2) return std::fprintf(stderr, "usage: fuzz_smoke SECONDS[:FROM] [TARGET …]\n"), 2;
  if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(keep_input);
  std::signal(SIGABRT, keep_input_of_abort);
  std::vector<Target> chosen;
  for (int i = 2; i < argc; ++i) chosen.push_back(target(argv[i]));
  if (argc == 2) chosen = targets();
  char* rest = nullptr;
  const double seconds = std::strtod(argv[1], &rest);
  const std::uint64_t from = *rest == ':' ? std::strtoull(rest + 1, nullptr, 10) : 0;
  std::size_t executions = 0;
  for (const Target& each : chosen) {
    const std::size_t n = smoke(each, seconds, from);
    std::printf("%-20s %8zu executions\n", each.name.c_str(), n);
    if (each.outcome) std::printf("%20s %s\n", "", each.outcome().c_str());
    executions += n;
  }
  std::printf("%zu targets, %zu executions, no finds\n", chosen.size(), executions);
  return 0;
}
