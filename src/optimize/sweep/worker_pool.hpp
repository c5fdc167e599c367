// The workers of parts that run at once: as many are made as ever are at work together, and kept.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <utility>

#include "base/assert.hpp"

namespace temper {

template <class Worker>
class WorkerPool {
  struct Place {
    std::atomic<bool> taken = false;
    std::unique_ptr<Worker> worker;
  };

 public:
  explicit WorkerPool(std::function<std::unique_ptr<Worker>()> make) : make_(std::move(make)) {}

  /// A worker that nobody else has, until this ends.
  class Lease {
   public:
    explicit Lease(Place& place) : place_(place) {}
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    ~Lease() { place_.taken.store(false, std::memory_order_release); }
    [[nodiscard]] Worker& operator*() const { return *place_.worker; }
    [[nodiscard]] Worker* operator->() const { return place_.worker.get(); }

   private:
    Place& place_;
  };

  /// Room for n workers; while none is leased.
  void make_room(std::size_t n) {
    TEMPER_ASSERT_SLOW(std::none_of(places_.begin(), places_.end(), [](const Place& p) { return p.taken.load(); }));
    while (places_.size() < n) places_.emplace_back();
  }

  /// The first worker that is free. With as many places as there are blocks one always is, or is just about to be.
  [[nodiscard]] Lease take() {
    for (std::size_t i = 0;; i = (i + 1) % places_.size()) {
      if (places_[i].taken.exchange(true, std::memory_order_acquire)) continue;
      if (!places_[i].worker) places_[i].worker = make_();
      return Lease(places_[i]);
    }
  }

  /// Every worker that has been made; while none is leased.
  template <class Visit>
  void for_each(Visit&& visit) {
    for (Place& place : places_) {
      if (place.worker) visit(*place.worker);
    }
  }

 private:
  std::function<std::unique_ptr<Worker>()> make_;
  std::deque<Place> places_;  // places do not move; few of them ever get a worker
};

}  // namespace temper
