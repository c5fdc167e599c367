#include "io/disk/files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

#include "temper/io.hpp"

namespace temper::io {

bool is_stream(const std::string& path) { return look_at(path).kind == OnDisk::Kind::other; }

namespace {

// A stream may never end. A file of this size has some 20 million vertices.
constexpr std::size_t kMostOfStream = std::size_t{1} << 31;

struct Closer {
  void operator()(std::FILE* f) const { std::fclose(f); }
};

}  // namespace

std::string without_suffix(const std::string& path, std::string_view suffix) {
  return path.ends_with(suffix) ? path.substr(0, path.size() - suffix.size()) : path;
}

Source load(const std::string& path, const LookAtBeginning& look) {
  const OnDisk there = look_at(path);
  if (there.kind == OnDisk::Kind::folder) fail(ErrorCode::not_found, path, "is a directory, not a mesh file");
  const std::unique_ptr<std::FILE, Closer> file(open_to_read(path));
  if (!file) fail(ErrorCode::not_found, path, "cannot be read: ", reason(errno));

  Source source{.path = path, .bytes = {}};
  constexpr std::size_t kChunk = 1 << 16;
  std::string& bytes = source.bytes;
  const auto read_up_to = [&](std::size_t size) {
    const std::size_t had = bytes.size();
    bytes.resize(std::max(had, size));
    bytes.resize(had + std::fread(bytes.data() + had, 1, bytes.size() - had, file.get()));
    return bytes.size() > had;
  };
  read_up_to(kChunk);
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);  // mark of UTF-8
  // Text whose lines end in CR alone. Binary files have zeros.
  const auto has = [&bytes](char c) { return bytes.find(c) != std::string::npos; };
  const bool has_returns = has('\r') && !has('\n') && !has('\0');
  const auto end_lines = [&] {
    if (has_returns) std::replace(bytes.begin(), bytes.end(), '\r', '\n');
  };
  end_lines();
  if (!bytes.empty() && look) look(bytes, std::max<std::uint64_t>(there.bytes, bytes.size()));
  const auto size = static_cast<std::size_t>(there.bytes);
  bytes.reserve(size + kChunk);  // the last look for more bytes must not move them all
  read_up_to(size);
  // Streams have no size, and a file may have grown.
  while (read_up_to(bytes.size() + kChunk)) {
    if (there.kind == OnDisk::Kind::other && bytes.size() > kMostOfStream)
      fail(ErrorCode::unsupported, path, "is a stream that has not ended after ", kMostOfStream >> 30,
           " GiB. Next: write it to a file, and read that");
  }
  if (std::ferror(file.get())) fail(ErrorCode::not_found, path, "cannot be read: ", reason(errno));
  end_lines();
  if (bytes.empty()) fail(ErrorCode::empty_input, path, "the file is empty");
  source.allocation = AllocationLimits(bytes.size());
  return source;
}

std::string first_bytes(const std::string& path, std::size_t n) {
  const std::unique_ptr<std::FILE, Closer> file(open_to_read(path));
  std::string bytes(file ? n : 0, '\0');
  if (file) bytes.resize(std::fread(bytes.data(), 1, n, file.get()));
  return bytes;
}

namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 18;

}  // namespace

Output::Output(std::string path) : path_(std::move(path)), target_(path_), buffer_(kBuffer) {
  const OnDisk there = look_at(path_);
  if (there.kind == OnDisk::Kind::folder)
    fail(ErrorCode::not_writable, path_, "is a directory; expected the name of a file");
  if (there.kind == OnDisk::Kind::other) {
    if (const int open = open_file_of(path_); open >= 0 && !is_open_to_write(open))
      fail(ErrorCode::not_writable, path_, "cannot be written: ", kClosedStream);
    file_ = open_to_write(path_);
  } else {
    target_ = without_links(path_);  // a link stays, even if nothing is there yet
    if (!target_.empty()) temporary_ = Temporary::beside(target_);
    file_ = temporary_.exists() ? temporary_.open() : -1;
  }
  if (file_ < 0) fail(ErrorCode::not_writable, path_, "cannot be written: ", reason(errno));
  if (there.kind == OnDisk::Kind::file) temporary_.take_permissions(target_);
}

Output::~Output() {
  if (file_ >= 0) close_file(file_);
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
  if (!write_all(file_, buffer_.data(), used_)) fail_writing("cannot be written");
  used_ = 0;
}

void Output::close() {
  flush();
  if (temporary_.exists() && !reach_disk(file_)) fail_writing("cannot be written");
  if (!close_file(std::exchange(file_, -1))) fail_writing("cannot be written");
}

void Output::commit() {
  if (temporary_.exists() && !temporary_.rename_to(target_)) fail_writing("cannot be replaced");
}

void Output::fail_writing(const char* doing) const {
  const int code = errno;
  const char* kept = !temporary_.exists() ? "" : "; what was there before is unchanged";
  fail(ErrorCode::not_writable, path_, doing, ": ", reason(code), kept);
}

Output& OutputSet::open(const std::string& path) {
  outputs_.push_back(std::make_unique<Output>(path));
  return *outputs_.back();
}

void OutputSet::commit() {
  for (auto& output : outputs_) output->close();
  std::string replaced;
  for (auto& output : outputs_) {
    try {
      output->commit();
    } catch (Failure& failure) {
      if (!replaced.empty()) failure.error.message += "; written before that: " + replaced;
      throw;
    }
    replaced += (replaced.empty() ? "" : ", ") + output->path();
  }
}

struct TextStream::State {
  OutputSet outputs;
  Output* output = nullptr;
  std::optional<InputError> error;  // the first
};

TextStream::TextStream(std::unique_ptr<State> state) : state_(std::move(state)) {}
TextStream::TextStream(TextStream&&) noexcept = default;
TextStream& TextStream::operator=(TextStream&&) noexcept = default;
TextStream::~TextStream() = default;

Expected<TextStream> TextStream::open(const std::string& path) {
  return guarded<TextStream>(path, [&] {
    auto state = std::make_unique<State>();
    state->output = &state->outputs.open(path);
    return TextStream(std::move(state));
  });
}

void TextStream::write(std::string_view text) {
  if (state_->error) return;
  try {
    state_->output->put(text);
  } catch (Failure& failure) {
    state_->error = std::move(failure.error);
  }
}

Expected<void> TextStream::commit() {
  if (state_->error) return *state_->error;
  return guarded<void>({}, [&] { state_->outputs.commit(); });
}

}  // namespace temper::io
