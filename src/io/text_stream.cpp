#include <memory>
#include <optional>
#include <utility>

#include "io/output.hpp"
#include "temper/io.hpp"

namespace temper::io {

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
  try {
    auto state = std::make_unique<State>();
    state->output = &state->outputs.open(path);
    return TextStream(std::move(state));
  } catch (Failure& failure) {
    return std::move(failure.error);
  }
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
  try {
    state_->outputs.commit();
    return {};
  } catch (Failure& failure) {
    return std::move(failure.error);
  }
}

}  // namespace temper::io
