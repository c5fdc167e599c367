#include "temper/envelope.hpp"

#include "temper/archive.hpp"
#include "temper/version.hpp"

namespace temper {
namespace {

// A first line that is longer is none of ours.
constexpr std::size_t kLongestLine = 80;

std::string first_line(std::string_view kind, std::string_view version) {
  return std::string(kind) + ", version " + std::string(version) + "\n";
}

std::uint64_t number_at(std::string_view bytes) {
  std::uint64_t number = 0;
  std::memcpy(&number, bytes.data(), sizeof number);
  return number;
}

void append_number(std::string& bytes, std::uint64_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace

std::string in_envelope(std::string_view kind, std::string_view bytes) {
  std::string envelope = first_line(kind, version());
  envelope.reserve(envelope.size() + bytes.size() + 2 * sizeof(std::uint64_t));
  append_number(envelope, bytes.size());
  envelope += bytes;
  append_number(envelope, checksum(bytes));
  return envelope;
}

Expected<std::string_view> from_envelope(std::string_view kind, std::string_view envelope) {
  const auto wrong = [&](ErrorCode code, const std::string& what) { return InputError{code, {}, what}; };
  const std::string expected = first_line(kind, version());
  if (!envelope.starts_with(expected)) {
    if (expected.starts_with(envelope)) return wrong(ErrorCode::truncated, "is cut off in its first line");
    const std::string_view line = envelope.substr(0, std::min(envelope.find('\n'), kLongestLine));
    if (!line.starts_with(first_line(kind, {}).substr(0, kind.size() + 1))) {
      return wrong(ErrorCode::syntax, "is no " + std::string(kind) + "; expected a file that begins with these words");
    }
    return wrong(ErrorCode::unsupported, "is a " + printable(line) + ", and this is temper " + std::string(version()) +
                                             ": only the version that wrote it can read it");
  }
  envelope.remove_prefix(expected.size());
  constexpr std::size_t kNumber = sizeof(std::uint64_t);
  const std::string counts = " bytes after its first line; expected ";
  const std::uint64_t around = 2 * kNumber;
  const std::uint64_t size = envelope.size() < kNumber ? 0 : number_at(envelope);
  if (envelope.size() < around || size > envelope.size() - around) {
    return wrong(ErrorCode::truncated, "is cut off: it has " + std::to_string(envelope.size()) + counts +
                                           (size == 0 ? "more" : std::to_string(size) + " and 16 around them"));
  }
  if (size < envelope.size() - around) return wrong(ErrorCode::syntax, "is damaged: it has more bytes than it says");
  const std::string_view bytes = envelope.substr(kNumber, static_cast<std::size_t>(size));
  if (number_at(envelope.substr(kNumber + bytes.size())) != checksum(bytes)) {
    return wrong(ErrorCode::syntax, "is damaged: its checksum is not that of its bytes");
  }
  return bytes;
}

}  // namespace temper
