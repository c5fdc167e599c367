// See output.hpp.
#include "io/output.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace temper::io {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 18;

struct Temporary {
  std::FILE* file = nullptr;  // null: errno says why
  std::string path;
};

/// Creates a file beside `target` that did not exist before.
Temporary create_beside(const std::string& target) {
  constexpr int kTries = 1000;  // each name is free unless a run was killed while it wrote
  for (int i = 0; i < kTries; ++i) {
    std::string path = text(target, ".tmp", i);
    std::FILE* file = std::fopen(path.c_str(), "wbx");
    if (file != nullptr) return {file, std::move(path)};
    if (errno != EEXIST) break;
  }
  return {};
}

}  // namespace

Output::Output(std::string path) : path_(std::move(path)), target_(path_), buffer_(kBuffer) {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (fs::is_directory(status)) fail(ErrorCode::not_writable, path_, "is a directory; expected the name of a file");
  if (fs::exists(status)) {
    if (const fs::path real = fs::canonical(path_, error); !error) target_ = real.string();
  }
  const bool direct = fs::exists(status) && !fs::is_regular_file(status);
  if (direct) {
    file_ = std::fopen(target_.c_str(), "wb");
  } else {
    Temporary temporary = create_beside(target_);
    file_ = temporary.file;
    temporary_ = std::move(temporary.path);
  }
  if (file_ == nullptr) fail(ErrorCode::not_writable, path_, text("cannot be written: ", std::strerror(errno)));
  std::setvbuf(file_, nullptr, _IONBF, 0);
  if (fs::is_regular_file(status) && !temporary_.empty()) fs::permissions(temporary_, status.permissions(), error);
}

Output::~Output() {
  if (file_ != nullptr) std::fclose(file_);
  if (!temporary_.empty()) std::remove(temporary_.c_str());
}

void Output::put(std::string_view bytes) {
  while (!bytes.empty()) {
    if (used_ == buffer_.size()) flush();
    const std::size_t n = std::min(bytes.size(), buffer_.size() - used_);
    std::memcpy(buffer_.data() + used_, bytes.data(), n);
    used_ += n;
    bytes.remove_prefix(n);
  }
}

void Output::flush() {
  if (std::fwrite(buffer_.data(), 1, used_, file_) != used_) fail_writing("cannot be written");
  used_ = 0;
}

void Output::close() {
  flush();
  std::FILE* file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0) fail_writing("cannot be written");
}

void Output::commit() {
  if (temporary_.empty()) return;
  std::error_code error;
  fs::rename(temporary_, target_, error);
  if (error) fail(ErrorCode::not_writable, path_, text("cannot be replaced: ", error.message()));
  temporary_.clear();
}

void Output::fail_writing(const char* doing) {
  const int code = errno;
  const char* kept = temporary_.empty() ? "" : "; what was there before is unchanged";
  fail(ErrorCode::not_writable, path_, text(doing, ": ", std::strerror(code), kept));
}

Output& OutputSet::open(const std::string& path) {
  outputs_.push_back(std::make_unique<Output>(path));
  return *outputs_.back();
}

void OutputSet::commit() {
  for (auto& output : outputs_) output->close();
  for (auto& output : outputs_) output->commit();
}

}  // namespace temper::io
