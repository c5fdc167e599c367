#pragma once

#include <atomic>
#include <memory>

namespace temper::error_detail {

/// Lends what its last user gave back, or a new value while that one is lent. Threads may ask at the same time.
template <class T>
class Lender {
 public:
  Lender() = default;
  Lender(const Lender&) = delete;
  Lender& operator=(const Lender&) = delete;
  ~Lender() { delete kept_.load(std::memory_order_relaxed); }

  [[nodiscard]] auto take() {
    const auto give_back = [this](T* value) { delete kept_.exchange(value, std::memory_order_acq_rel); };
    T* const kept = kept_.exchange(nullptr, std::memory_order_acq_rel);
    return std::unique_ptr<T, decltype(give_back)>(kept != nullptr ? kept : new T, give_back);
  }

 private:
  std::atomic<T*> kept_{nullptr};
};

}  // namespace temper::error_detail
