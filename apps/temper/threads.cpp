#include "threads.hpp"

#include <algorithm>

namespace temper::app {

std::size_t hardware_threads() { return std::max<std::size_t>(1, std::thread::hardware_concurrency()); }

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  work_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::run(std::size_t n, const std::function<void(std::size_t)>& block) {
  if (helpers_ == 0 || n < 2) {
    for (std::size_t i = 0; i < n; ++i) block(i);
    return;
  }
  while (threads_.size() < helpers_) threads_.emplace_back([this] { help(); });
  std::unique_lock lock(mutex_);
  block_ = &block;
  next_ = 0;
  size_ = n;
  work_.notify_all();
  take_blocks(lock);
  done_.wait(lock, [this] { return running_ == 0; });
}

void ThreadPool::help() {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    take_blocks(lock);
    work_.wait(lock, [this] { return stop_ || next_ < size_; });
  }
}

void ThreadPool::take_blocks(std::unique_lock<std::mutex>& lock) {
  while (next_ < size_) {
    const std::size_t mine = next_++;
    ++running_;
    lock.unlock();
    (*block_)(mine);
    lock.lock();
    --running_;
  }
  if (running_ == 0) done_.notify_all();
}

}  // namespace temper::app
