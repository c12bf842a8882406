// The transposition table: the same as dominance.py, which has the reasons.
#pragma once

#include <algorithm>

#include "network.hpp"

class Seen {
 public:
  Seen(const Network& network, int keep) : network_(network), keep_(keep) {}

  /// Whether a known path makes this one needless; if not, it becomes known, and what it beats is dropped.
  bool drops(Path& path) {
    Path*& known = known_.find(hash(path), [&](const Path& other) { return alike(other, path); });
    if (known == nullptr) {
      known = &path;
      return false;
    }
    double rest = -1.0;
    int equals = 0;
    for (const Path* other = known; other != nullptr; other = other->next) {
      check(40);
      const int verdict = beats(*other, path, rest);
      if (verdict > 0) return true;
      equals += verdict == 0;
    }
    if (equals >= keep_) return true;
    Path** at = &known;
    while (*at != nullptr) {
      check(40);
      Path& other = **at;
      other.dropped = other.dropped || beats(path, other, rest) > 0;
      if (other.dropped)
        *at = other.next;
      else
        at = &other.next;
    }
    path.next = known;
    known = &path;
    return false;
  }

  void clear() { known_.clear(); }

 private:
  const Network& network_;
  int keep_;
  Table<Path> known_;

  int bands(const Path& path) const {
    return network_.complete(path) ? 0 : network_.groups[path.group]->count();
  }

  std::uint64_t hash(const Path& path) const {
    std::uint64_t own = mixed(mixed(mixed(5, path.group), path.owed), path.trail);
    for (int b = 0; b < bands(path); ++b) own = mixed(own, path.state[b]);
    for (int k = 0; k < path.n_ranges; ++k) own = mixed(own, path.ranges[k].key);
    return own;
  }

  bool alike(const Path& a, const Path& b) const {
    if (a.group != b.group || a.owed != b.owed || a.trail != b.trail || a.n_ranges != b.n_ranges) return false;
    for (int k = 0; k < a.n_ranges; ++k)
      if (a.ranges[k].key != b.ranges[k].key) return false;
    return std::equal(a.state, a.state + bands(a), b.state);
  }

  /// 1: `a` makes `b` needless; 0: as good as it in every respect; −1: neither. `rest`, the least width of what is left,
  /// is the same for all paths that are alike; below 0 it is not known yet.
  int beats(const Path& a, const Path& b, double& rest) const {
    const double dw = a.width - b.width;
    if (a.cost > b.cost + kEps || dw > kEps || (a.pinched && !b.pinched)) return -1;
    double slack = 0.0;
    bool wider = false;
    for (int k = 0; k < a.n_ranges; ++k) {
      const Range &own = a.ranges[k], &other = b.ranges[k];
      if (own.low > other.low + kEps || own.high < other.high - kEps || own.up > other.up + kEps ||
          own.more < other.more - kEps)
        return -1;
      wider = wider || own.low < other.low - kEps || own.high > other.high + kEps || own.up < other.up - kEps ||
              own.more > other.more + kEps;
    }
    if (std::abs(dw) > kEps || wider) {
      if (network_.complete(a) || dw > 0) return -1;
      const Group& group = *network_.groups[a.group];
      if (rest < 0.0) {
        rest = 0.0;
        for (int k = 0; k < group.count(); ++k) rest = std::max(rest, group.bands[k]->at_least(a.state[k]));
      }
      if (a.width + rest < group.canvas - group.tolerance) return -1;
      slack = group.prices.fit * std::abs(dw);
    }
    if (a.cost + slack < b.cost - kEps) return 1;
    if (a.cost + slack <= b.cost + kEps && a.columns >= b.columns) {
      const bool equal = slack <= kEps && a.columns == b.columns && a.cost >= b.cost - kEps;
      return equal && !wider ? 0 : 1;
    }
    return -1;
  }
};
