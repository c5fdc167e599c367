// The file is an envelope (temper/envelope.hpp) around an archive (temper/archive.hpp).
#include "temper/checkpoint.hpp"

#include <utility>

#include "io/disk/output.hpp"
#include "io/formats/document.hpp"
#include "io/formats/format.hpp"
#include "io/text/failure.hpp"
#include "temper/archive.hpp"
#include "temper/envelope.hpp"

namespace temper {

namespace {

constexpr std::string_view kKind = "temper checkpoint";

}  // namespace

namespace io {

void visit(Archive& archive, Checkpoint& checkpoint) {
  auto& [command, inputs, trace, events, state] = checkpoint;
  archive(command, inputs, trace, events, state);
  archive.seal();
}

namespace {

/// What read() makes sure of.
void check_file(MeshFile& file) {
  check_sizes(file.path, file);
  Document document = new_document(file.path);
  std::swap(document.file, file);
  check(document);
  std::swap(document.file, file);
}

}  // namespace

Expected<Checkpoint> read_checkpoint(const std::string& path) {
  return guarded<Checkpoint>(path, [&] {
    const Source source = load(path);
    const Expected<std::string_view> bytes = from_envelope(kKind, source.bytes);
    if (!bytes) fail(bytes.error().code, path, bytes.error().message);
    Archive archive(*bytes);
    Checkpoint checkpoint;
    archive(checkpoint);
    if (!archive.at_end()) {
      fail(ErrorCode::unsupported, path,
           "was written by another build of temper: only the one that wrote it can read it");
    }
    for (MeshFile& file : checkpoint.inputs) check_file(file);
    return checkpoint;
  });
}

CheckpointFile::CheckpointFile(std::string path, double seconds) : path_(std::move(path)), between_(seconds) {}

void CheckpointFile::add_input(const MeshFile& file) { now_.inputs.push_back(file); }

void CheckpointFile::set_trace(std::function<TracePlace()> place, std::function<Expected<std::string>()> text) {
  trace_place_ = std::move(place);
  trace_text_ = std::move(text);
}

Expected<void> CheckpointFile::keep(const std::function<std::string()>& state) {
  constexpr int kSpared = 20;  // times what it takes to keep a state pass before the next is kept
  const Clock::time_point begin = Clock::now();
  const bool is_time = !written_ || begin - *written_ >= between_;
  if (begin < next_ && !is_time) return {};
  now_.state = state();
  if (trace_place_) trace_at_ = trace_place_();
  const Clock::time_point end = Clock::now();
  next_ = end + kSpared * (end - begin);
  if (!is_time) return {};
  Expected<void> written = write();
  written_ = Clock::now();
  return written;
}

Expected<void> CheckpointFile::write() {
  if (trace_text_) {
    Expected<std::string> text = trace_text_();
    if (!text) return text.error();
    now_.trace = *std::move(text);
    now_.trace.resize(std::min<std::size_t>(now_.trace.size(), static_cast<std::size_t>(trace_at_.bytes)));
    now_.events = trace_at_.events;
  }
  std::string bytes;
  Archive archive(bytes);
  archive(now_);
  now_.trace = {};
  return write_text(path_, in_envelope(kKind, bytes));
}

}  // namespace io
}  // namespace temper
