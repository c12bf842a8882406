// Memory that is let go of all at once: paths and columns live as long as the search that made them.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <type_traits>
#include <vector>

/// Does not return.
[[noreturn]] void out_of_memory();

class Arena {
 public:
  Arena() = default;
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;
  ~Arena() { clear(); }

  /// Room for `n` of T, not initialised.
  template <class T>
  T* room(std::size_t n) {
    static_assert(std::is_trivially_destructible_v<T>, "nothing in an arena is destroyed one by one");
    const std::size_t bytes = (n * sizeof(T) + 7) & ~std::size_t{7};
    if (used_ + bytes > size_) grow(bytes);
    void* at = blocks_.back() + used_;
    used_ += bytes;
    return static_cast<T*>(at);
  }

  struct Mark {
    std::size_t blocks, used, size;
  };

  Mark mark() const { return {blocks_.size(), used_, size_}; }

  /// Takes back what was given since.
  void rewind(const Mark& mark) {
    while (blocks_.size() > mark.blocks) {
      std::free(blocks_.back());
      blocks_.pop_back();
    }
    used_ = mark.used;
    size_ = mark.size;
  }

  void clear() {
    for (char* block : blocks_) std::free(block);
    blocks_.clear();
    used_ = size_ = 0;
  }

 private:
  std::vector<char*> blocks_;
  std::size_t used_ = 0, size_ = 0;

  void grow(std::size_t bytes) {
    size_ = blocks_.empty() ? 16384 : size_ < 1048576 ? 2 * size_ : size_;
    if (size_ < bytes) size_ = bytes;
    char* block = static_cast<char*>(std::malloc(size_));
    if (block == nullptr) out_of_memory();
    blocks_.push_back(block);
    used_ = 0;
  }
};
