#include "options.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace temper::bench {
namespace {

std::vector<std::size_t> numbers(const std::string& list) {
  std::vector<std::size_t> result;
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find(',', at), list.size());
    result.push_back(std::strtoull(list.c_str() + at, nullptr, 10));
    if (result.back() == 0) fail("not a list of sizes: " + list);
    at = end + 1;
  }
  return result;
}

int at_least_one(const std::string& word, const std::string& value) {
  const int number = std::atoi(value.c_str());
  if (number < 1) fail(word + " expects a number from 1 on, found " + value);
  return number;
}

}  // namespace

void fail(const std::string& message) {
  std::fprintf(stderr, "bench_whole_run: %s\n", message.c_str());
  std::exit(2);
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--check" || word == "--sweeps-alone") {
      (word == "--check" ? options.check : options.sweeps_alone) = true;
      continue;
    }
    if (i + 1 == argc) fail("unknown option, or without value: " + word);
    const std::string value = argv[++i];
    if (word == "--sizes") {
      options.sizes = numbers(value);
    } else if (word == "--sweeps") {
      options.sweeps = at_least_one(word, value);
    } else if (word == "--golden-sweeps") {
      options.golden_sweeps = at_least_one(word, value);
    } else if (word == "--rounds") {
      options.rounds = at_least_one(word, value);
    } else if (word == "--threads") {
      options.threads = static_cast<std::size_t>(at_least_one(word, value));
    } else if (word == "--temper") {
      options.temper = value;
    } else if (word == "--json") {
      options.json = value;
    } else {
      fail("unknown option " + word);
    }
  }
  if (options.threads == 0) options.threads = std::max(1U, std::thread::hardware_concurrency());
  return options;
}

}  // namespace temper::bench
