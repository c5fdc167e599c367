// Workers for blocks that run at once: as many of them are made as blocks ever do.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>

namespace temper {

template <class Worker>
class Desks {
 public:
  struct Desk {
    std::atomic<bool> taken = false;
    std::unique_ptr<Worker> worker;
    void leave() { taken.store(false, std::memory_order_release); }
  };

  /// Before blocks run: room for as many as there are. Workers there were may be gone after that.
  void make_room(std::size_t n_blocks) {
    if (n_ >= n_blocks) return;
    desks_ = std::make_unique<Desk[]>(n_blocks);
    n_ = n_blocks;
  }

  /// The first that is free, with a worker; to be left in the end. There are as many desks as blocks, so one is always
  /// free, or just about to be.
  template <class Make>
  [[nodiscard]] Desk& take(Make&& make) {
    for (std::size_t i = 0;; i = (i + 1) % n_) {
      if (desks_[i].taken.exchange(true, std::memory_order_acquire)) continue;
      if (!desks_[i].worker) desks_[i].worker = make();
      return desks_[i];
    }
  }

  /// While no block runs.
  template <class Visit>
  void for_each_worker(Visit&& visit) {
    for (std::size_t i = 0; i < n_ && desks_[i].worker; ++i) visit(*desks_[i].worker);
  }

 private:
  std::unique_ptr<Desk[]> desks_;  // few of them are ever used
  std::size_t n_ = 0;
};

}  // namespace temper
