// libFuzzer's side: TEMPER_FUZZ_TARGET says which target. Two more ways to be called, for scripts/fuzz.sh:
//
//   temper_fuzz --list            the names of the targets
//   temper_fuzz --seeds FOLDER    writes the seeds of the target there
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "target.hpp"

namespace {

std::string chosen() {
  const char* name = std::getenv("TEMPER_FUZZ_TARGET");
  return name == nullptr ? "" : name;
}

void write_seeds(const std::string& folder) {
  int n = 0;
  for (const std::string& seed : temper::fuzz::seeds_and_finds(temper::fuzz::target(chosen()))) {
    std::ofstream(folder + "/seed" + std::to_string(n++), std::ios::binary)
        .write(seed.data(), static_cast<std::streamsize>(seed.size()));
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::string word = *argc > 1 ? (*argv)[1] : "";
  if (word == "--list") {
    for (const auto& target : temper::fuzz::targets()) std::puts(target.name.c_str());
    std::exit(0);
  }
  if (word == "--seeds" && *argc == 3) {
    write_seeds((*argv)[2]);
    std::exit(0);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const temper::fuzz::Target target = temper::fuzz::target(chosen());
  target.run({reinterpret_cast<const char*>(data), size});
  return 0;
}
