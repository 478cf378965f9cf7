// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace abbe {

/// Stack-like scratch memory of one thread: a path takes what it needs on its way down and gives it
/// back by leaving a Scope. Nothing is allocated per ray once the blocks have grown.
class Arena {
public:
  template <class T>
  T* take(std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T>);
    constexpr std::size_t alignment = alignof(T) > 8 ? alignof(T) : 8;
    static_assert(alignment <= block_alignment);
    auto const up = [](std::size_t n, std::size_t to) { return (n + to - 1) / to * to; };
    std::size_t const bytes = up(count * sizeof(T), 8);
    while (true) {
      std::size_t const begin = up(used_, alignment);
      if (block_ < blocks_.size() && begin + bytes <= blocks_[block_].size) {
        used_ = begin + bytes;
        return static_cast<T*>(static_cast<void*>(blocks_[block_].memory.get() + begin));
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
  static constexpr std::size_t block_alignment = 64;
  struct Free {
    void operator()(std::byte* memory) const {
      ::operator delete (memory, std::align_val_t{block_alignment});
    }
  };
  struct Block {
    std::unique_ptr<std::byte, Free> memory;
    std::size_t size;
  };
  void grow(std::size_t bytes) {
    std::size_t const size = bytes > block_size ? bytes : block_size;
    auto* memory =
        static_cast<std::byte*>(::operator new (size, std::align_val_t{block_alignment}));
    blocks_.push_back({std::unique_ptr<std::byte, Free>(memory), size});
  }
  static constexpr std::size_t block_size = std::size_t{1} << 18;
  std::vector<Block> blocks_;
  std::size_t block_ = 0;
  std::size_t used_ = 0;
};

} // namespace abbe
