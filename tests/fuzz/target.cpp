#include "target.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace temper::fuzz {

namespace fs = std::filesystem;

namespace {

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

std::vector<Target> targets() {
  std::vector<Target> all;
  for (auto some : {mesh_file_targets, outline_targets, outline_mesh_targets, program_file_targets, optimize_targets}) {
    auto list = some();
    all.insert(all.end(), std::make_move_iterator(list.begin()), std::make_move_iterator(list.end()));
  }
  return all;
}

Target target(const std::string& name) {
  std::string names;
  for (Target& each : targets()) {
    if (each.name == name) return std::move(each);
    names += " " + each.name;
  }
  std::fprintf(stderr, "no target '%s'; there are%s\n", name.c_str(), names.c_str());
  std::exit(2);
}

std::vector<std::string> seeds_and_finds(const Target& target) {
  std::vector<std::string> all = target.seeds();
  for (const auto& entry : fs::directory_iterator(TEMPER_FUZZ_FINDS)) {
    if (!entry.path().filename().string().starts_with(target.name + "-")) continue;
    all.push_back(content_of(entry.path()));
  }
  return all;
}

void insist(bool holds, std::string_view what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: does not hold: %.*s\n", static_cast<int>(what.size()), what.data());
  std::abort();
}

Scratch::Scratch() {
  const fs::path memory = "/dev/shm";
  std::string pattern = ((fs::exists(memory) ? memory : fs::temp_directory_path()) / "temper_fuzz.XXXXXX").string();
  insist(mkdtemp(pattern.data()) != nullptr, "a folder can be made");
  folder_ = pattern;
}

Scratch::~Scratch() { fs::remove_all(folder_); }

std::string Scratch::make(const std::string& name, std::string_view content) const {
  std::ofstream(path(name), std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
  return path(name);
}

void Scratch::clear() const {
  for (const auto& entry : fs::directory_iterator(folder_)) fs::remove_all(entry.path());
}

}  // namespace temper::fuzz
