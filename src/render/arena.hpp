// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace abbe::render {

/// Stack-like scratch memory of one thread: a path takes what it needs on its way down and gives it
/// back by leaving a Scope. Nothing is allocated per ray once the blocks have grown.
class Arena {
public:
  template <class T>
  T* take(std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T>);
    constexpr std::size_t alignment = alignof(T) > 8 ? alignof(T) : 8;
    std::size_t const bytes = (count * sizeof(T) + alignment - 1) / alignment * alignment;
    while (true) {
      if (block_ < blocks_.size() && used_ + bytes <= blocks_[block_].size) {
        void* place = blocks_[block_].memory.get() + used_;
        used_ += bytes;
        return static_cast<T*>(place);
      }
      if (block_ < blocks_.size()) ++block_;
      used_ = 0;
      if (block_ >= blocks_.size()) grow(bytes);
    }
  }

  /// Gives back, at its end, all that was taken since it was made.
  class Scope {
  public:
    explicit Scope(Arena& arena) : arena_(arena), block_(arena.block_), used_(arena.used_) {}
    ~Scope() {
      arena_.block_ = block_;
      arena_.used_ = used_;
    }
    Scope(Scope const&) = delete;
    Scope& operator=(Scope const&) = delete;

  private:
    Arena& arena_;
    std::size_t block_;
    std::size_t used_;
  };

private:
  struct Block {
    std::unique_ptr<std::byte[]> memory;
    std::size_t size;
  };
  void grow(std::size_t bytes) {
    std::size_t const size = bytes > block_size ? bytes : block_size;
    blocks_.push_back({std::make_unique<std::byte[]>(size), size});
  }
  static constexpr std::size_t block_size = std::size_t{1} << 18;
  std::vector<Block> blocks_;
  std::size_t block_ = 0;
  std::size_t used_ = 0;
};

} // namespace abbe::render
