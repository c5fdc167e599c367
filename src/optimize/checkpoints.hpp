// Checkpoints: the state of a run between two sweeps, as bytes, and a run that goes on from there.
//
// The state of a run is that of the functions that are under way: optimize() has called best_attempt(), that has called
// Driver::run(). Each of them says with a Resumable what it would need to be there again. A checkpoint is what all of
// them say, outermost first. A run that is resumed is called like any other, and descends the same way; each function
// gets its part back when it comes to its Resumable, and leaves out what it had done before, until the last one is at
// the place where the checkpoint was taken.
//
//   int Driver::run(Phase& phase, int first) {
//     const Resumable here(run_.checkpoints, first, phase, *this);
//     if (!here.resumed()) begin(phase, first);
//     do {
//       if (!run_.checkpoints.here()) return first;  // a checkpoint may be taken here
//       …
//
// state.cpp says class by class what is kept. Bytes begin with a magic number, the version of temper, and whose run
// they are of; they end with a checksum.
#pragma once

#include <functional>
#include <tuple>
#include <vector>

#include "temper/archive.hpp"
#include "temper/optimize.hpp"

namespace temper {

class Checkpoints {
 public:
  /// Nobody listens, and nothing is resumed.
  Checkpoints() = default;
  /// Those of the hooks. Errors: the state to resume is not one, or not of this mesh and these options.
  [[nodiscard]] static Expected<Checkpoints> of(const OptimizeHooks& hooks, const OptimizeOptions& options,
                                                const Mesh& mesh);

  /// A place where a checkpoint may be taken: the listener is told. False when the state that is resumed does not end
  /// here, so that error() says what is wrong with it.
  [[nodiscard]] bool here();
  /// Says whether the run has not come yet to where it is resumed; and never will, after an error.
  [[nodiscard]] bool resumes() const { return rest_.has_value(); }
  /// What was read so far does not fit: variables have no values to go on with.
  [[nodiscard]] bool failed() const { return rest_ && rest_->failed(); }
  /// Why a run that should have come to where it is resumed has not.
  [[nodiscard]] std::optional<InputError> error() const;

 private:
  friend class Resumable;
  using Visit = std::function<void(Archive&)>;

  [[nodiscard]] std::string state() const;

  StateListener listener_;
  std::uint64_t owner_ = 0;              // of the state: a hash of mesh and options
  std::optional<Archive> rest_;          // of what is resumed
  std::vector<const Visit*> under_way_;  // of the functions, outermost first
};

/// A hash of all that the result of a run depends on.
[[nodiscard]] std::uint64_t identity_of(const OptimizeOptions& options, const Mesh& mesh);

/// The part that a function has in the state of a run, as long as it runs.
class Resumable {
 public:
  /// When the run is resumed the variables get their values back.
  template <class... T>
  explicit Resumable(Checkpoints& all, T&... variables)
      : all_(all), resumed_(all.resumes()), visit_([kept = std::tie(variables...)](Archive& archive) {
          std::apply([&archive](T&... each) { archive(each...); }, kept);
          archive.seal();
        }) {
    all_.under_way_.push_back(&visit_);
    if (resumed_) visit_(*all_.rest_);
  }
  ~Resumable() { all_.under_way_.pop_back(); }
  Resumable(const Resumable&) = delete;
  Resumable& operator=(const Resumable&) = delete;

  /// Says whether the variables are those of a checkpoint, so that nothing is to be begun.
  [[nodiscard]] bool resumed() const { return resumed_; }

 private:
  Checkpoints& all_;
  bool resumed_;
  Checkpoints::Visit visit_;
};

}  // namespace temper
