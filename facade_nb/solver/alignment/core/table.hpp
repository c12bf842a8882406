// Hash tables without a room of their own for each entry: what they hold lives in an arena, and never leaves alone.
#pragma once

#include <cstdint>
#include <vector>

inline std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash ^= value + 0x9e3779b97f4a7c15ull + (hash << 6) + (hash >> 2);
  return hash * 0xff51afd7ed558ccdull;
}

/// Pointers by hash; whether two of the same hash are the same is asked of the caller.
template <class T>
class Table {
 public:
  /// The pointer that `same` accepts, or the place for it.
  template <class Same>
  T*& find(std::uint64_t hash, const Same& same) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    std::size_t at = hash & mask_;
    while (slots_[at].value != nullptr && !(slots_[at].hash == hash && same(*slots_[at].value))) at = (at + 1) & mask_;
    if (slots_[at].value == nullptr) {
      slots_[at].hash = hash;
      ++count_;  // the caller fills it
    }
    return slots_[at].value;
  }

  void clear() {
    slots_.clear();
    count_ = mask_ = 0;
  }

 private:
  struct Slot {
    std::uint64_t hash;
    T* value;
  };
  std::vector<Slot> slots_;
  std::size_t count_ = 0, mask_ = 0;

  void grow() {
    std::vector<Slot> old(slots_.empty() ? 64 : 2 * slots_.size(), Slot{0, nullptr});
    old.swap(slots_);
    mask_ = slots_.size() - 1;
    for (const Slot& slot : old) {
      if (slot.value == nullptr) continue;
      std::size_t at = slot.hash & mask_;
      while (slots_[at].value != nullptr) at = (at + 1) & mask_;
      slots_[at] = slot;
    }
  }
};
