// Partial alignments, and what the pieces of cut letters say about them: the same as paths.py.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "group.hpp"

/// Of the columns in which just the pieces of a key stand: see paths.Range.
struct Range {
  int key;
  double low, high, up, more;
};

/// Of the pieces of a letter: see paths.Span.
struct Span {
  double low, high;
  bool open;  // one of them may have any length
};

struct Learnt {
  int symbol;
  double low, high;
};

struct Path {
  int group, columns;
  const Position* state;
  double cost, width;
  const Path* parent;
  const Option* const* column;
  const Range* ranges;
  const Span* spans;
  const Learnt* learnt;
  double ahead, made, step;
  Path* next;  // another one that is known at the same node (see seen.hpp)
  int trail, n_ranges, n_learnt;
  bool firm, owed, dropped, pinched, late;
};


/// The columns whose price depends on the lengths of pieces; equal trails have equal numbers, 0 is the empty one.
class Trails {
 public:
  int with_column(int trail, int group, const Option* const* column, int bands) {
    std::uint64_t hash = mixed(mixed(1, trail), group);
    for (int b = 0; b < bands; ++b) hash = mixed(hash, reinterpret_cast<std::uintptr_t>(column[b]));
    return intern(hash, {trail, group, column, bands, 0});
  }
  int with_width(int trail, double width) {
    const long long rounded = std::llround(width * 1e9);
    return intern(mixed(mixed(2, trail), rounded), {trail, -1, nullptr, 0, rounded});
  }
  /// A trail like no other.
  int alone(int trail) {
    nodes_.push_back({trail, -2, nullptr, 0, 0});
    return static_cast<int>(nodes_.size());
  }
  /// Whether a letter has a piece in one of the columns.
  bool holds(int trail, int group, int band, int letter) const {
    for (; trail > 0; trail = nodes_[trail - 1].parent) {
      const Node& node = nodes_[trail - 1];
      if (node.group == group && node.column[band]->holds(letter)) return true;
    }
    return false;
  }
  void clear() {
    nodes_.clear();
    known_.clear();
  }

 private:
  struct Node {
    int parent, group;  // −1: a width; −2: like no other
    const Option* const* column;
    int bands;
    long long width;
  };
  std::vector<Node> nodes_;
  std::unordered_map<std::uint64_t, std::vector<int>> known_;

  int intern(std::uint64_t hash, const Node& node) {
    std::vector<int>& same = known_[hash];
    for (int id : same) {
      const Node& other = nodes_[id - 1];
      if (other.parent == node.parent && other.group == node.group && other.width == node.width &&
          std::equal(node.column, node.column + node.bands, other.column))
        return id;
    }
    nodes_.push_back(node);
    same.push_back(static_cast<int>(nodes_.size()));
    return same.back();
  }
};

using Piece = std::uint64_t;  // group, band, first and last letter, most significant first
constexpr Piece kDearness = 255;  // in place of a group, see paths.gathered

inline Piece piece(int group, int band, int first, int last) {
  return Piece(group) << 56 | Piece(band) << 44 | Piece(first) << 22 | Piece(last);
}

/// Numbers for sets of pieces, and the sums over the columns in which they stand (paths.gathered).
class Gatherer {
 public:
  void gather(const Path& path, const Trails& trails, const Edge& edge, const std::vector<Option const*>& column,
              double tolerance) {
    found_.clear();
    for (int k = 0; k < path.n_ranges; ++k) {
      const Range& own = path.ranges[k];
      found_.push_back({keys_[own.key], own.low, own.high, own.up, own.more});
    }
    const int g = path.group, n = static_cast<int>(column.size());
    std::vector<Piece> key;
    for (int b = 0; b < n; ++b)
      if (column[b]->tied) key.push_back(of(g, b, *column[b]));
    if (tolerance < kInf) key.push_back(kDearness << 56 | static_cast<Piece>(std::llround(edge.up * 1e9)));
    join({key, edge.least, edge.width, edge.up, tolerance - edge.omega});
    for (int b = 0; b < n; ++b) {
      const Option& option = *column[b];
      if (option.tied && option.count == 1 && option.ends && !std::isnan(option.sized))
        settle(path, trails, g, b, option);
    }
    std::sort(found_.begin(), found_.end(), [](const Sum& a, const Sum& b) { return a.key < b.key; });
  }

  int count() const { return static_cast<int>(found_.size()); }

  void write(Range* out) {
    for (const Sum& sum : found_) *out++ = {number(sum.key), sum.low, sum.high, sum.up, sum.more};
  }

  void clear() {
    keys_.clear();
    numbers_.clear();
  }

 private:
  struct Sum {
    std::vector<Piece> key;
    double low, high, up, more;
  };
  std::vector<Sum> found_;
  std::vector<std::vector<Piece>> keys_;
  std::map<std::vector<Piece>, int> numbers_;

  static Piece of(int g, int b, const Option& option) {
    return piece(g, b, option.first, option.first + option.count - 1);
  }

  int number(const std::vector<Piece>& key) {
    const auto [at, fresh] = numbers_.try_emplace(key, static_cast<int>(keys_.size()));
    if (fresh) keys_.push_back(key);
    return at->second;
  }

  void join(Sum sum) {
    for (Sum& own : found_)
      if (own.key == sum.key) {
        own.low = sum.low + own.low;
        own.high = sum.high + own.high;
        own.up = std::min(sum.up, own.up);
        own.more = sum.more + own.more;
        return;
      }
    found_.push_back(std::move(sum));
  }

  /// Forget a complete letter, if no column needs to change for it and it has no other pieces.
  void settle(const Path& path, const Trails& trails, int g, int b, const Option& option) {
    const Piece whole = of(g, b, option);
    const int letter = option.first;
    double low = 0.0, high = 0.0;
    std::vector<Sum> standing;
    for (const Sum& entry : found_)
      for (const Piece other : entry.key) {
        if (other == whole) {
          standing.push_back(entry);
          low += entry.low;
          high += entry.high;
        } else if (other >> 44 == whole >> 44) {
          const int first = static_cast<int>(other >> 22 & 0x3fffff), last = static_cast<int>(other & 0x3fffff);
          if (first <= letter && letter <= last) return;
        }
      }
    if (option.sized < low - kEps || option.sized > high + kEps) return;
    if (trails.holds(path.trail, g, b, letter)) return;
    for (const Sum& entry : standing)
      found_.erase(std::find_if(found_.begin(), found_.end(), [&](const Sum& own) { return own.key == entry.key; }));
    for (Sum& entry : standing) {
      entry.key.erase(std::find(entry.key.begin(), entry.key.end(), whole));
      if (!entry.key.empty() && entry.key.front() >> 56 != kDearness) join(std::move(entry));
    }
  }
};
