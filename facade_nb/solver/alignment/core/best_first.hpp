// The best-first search: the same as reference/best_first.py, which has the reasons. It stops wherever a structure leaves the
// queue that could be among the best, to be judged in Python.
#pragma once

#include <queue>
#include <vector>

#include "network.hpp"
#include "pricing.hpp"
#include "dominance.hpp"

enum Status { kEnded = 0, kPaused = 1, kLeft = 2, kPrice = 3, kCut = 4, kStopped = 5 };

/// What waits: a path, or one that is complete and priced. The order is that of the tuples in Python.
struct Waiting {
  double bound;
  int columns;
  long long serial;
  Path* path;
  bool priced, proper;  // proper: no piece has to be looked at again
  bool late;            // see Path
};
struct Later {
  bool operator()(const Waiting& a, const Waiting& b) const {
    if (a.bound != b.bound) return a.bound > b.bound;
    if (a.late != b.late) return a.late;
    if (a.columns != b.columns) return a.columns < b.columns;
    return a.serial > b.serial;
  }
};

class Search {
 public:
  double bound;  // proven
  double nodes = 0;
  double root;

  Search(std::vector<Group*> groups, int keep, double nodes_, double turn, bool judged)
      : network(std::move(groups)), most_(nodes_), turn_(turn), judged_(judged), keep_(keep), seen_(network, keep) {
    bound = root = network.later[0];
    for (const Group* group : network.groups) horizon_ = std::min(horizon_, group->tolerance);
    if (root < kInf) push(root, network.root());
  }

  Network network;

  /// The structure that has left the queue.
  const Path* asked() const { return asked_; }

  Status advance(double limit, bool paused) {
    limit_ = limit;
    if (!paused && !prepare()) return stopped ? kStopped : kEnded;
    pause_ = nodes + turn_;
    return go_on();
  }

  /// What has left the queue was judged: the best there is costs so much (infinite: there is none). `full`: there are
  /// enough others that are as good.
  Status judged(double best, int columns, bool proper, bool full, double limit) {
    best_ = best;
    columns_ = columns;
    proper_ = proper;
    full_ = full;
    limit_ = limit;
    return go_on();
  }

 private:
  static constexpr double kStep = 0.002;

  double most_, turn_;
  bool judged_;
  int keep_;
  Seen seen_;
  std::priority_queue<Waiting, std::vector<Waiting>, Later> queue_;
  std::vector<std::pair<double, Path*>> parked_;
  long long serial_ = 0;
  double horizon_ = kInf, limit_ = 0.0, best_ = kInf, pause_ = 0.0;
  int columns_ = 0;
  bool proper_ = false, full_ = false, cut_ = false;
  std::vector<const Path*> improper_;
  const Path* asked_ = nullptr;
  Pricer price_;

  static double rounded(double bound) { return bound < kInf ? std::nearbyint(bound * 1e10) / 1e10 : bound; }

  /// Whether a structure has fewer columns than the best, or as many as enough others that are as good.
  bool fewer(const Path& path) const { return path.columns < columns_ || (path.columns == columns_ && full_); }

  /// Whether it matters for a structure as dear as the best if its pieces can all be longer than nothing.
  bool doubtful(const Path& path) const { return proper_ != fewer(path); }

  void push(double least, Path* path, bool late = false) {
    queue_.push({rounded(least), path->columns, serial_++, path, false, false, late});
  }

  Status go_on() {
    if (cut_) return ended();
    while (!queue_.empty()) {
      const Waiting top = queue_.top();
      if (top.bound > limit_ + kEps || (best_ < kInf && top.bound > best_ + kEps)) break;
      if (nodes >= pause_) return kPaused;
      queue_.pop();
      if (best_ == kInf) bound = std::max(bound, top.bound);
      Path& path = *top.path;
      if (top.priced) {
        if (judged_) return left(&path);
        if (best_ < kInf && !doubtful(path) && fewer(path)) continue;
        bool proper = top.proper;
        if (!proper) {
          price_(network, &path);
          proper = price_.proper(false);
          if (stopped) return kStopped;
        }
        if (best_ < kInf && (proper ? proper_ && fewer(path) : proper_ || fewer(path))) continue;
        if (!proper) {
          wait_for_better(&path, top.bound);
          continue;
        }
        improper_.clear();
        return left(&path);
      }
      if (path.dropped || (top.late && best_ < kInf && proper_)) continue;
      ++nodes;
      if (check(500)) return kStopped;
      if (nodes >= most_) {
        cut_ = true;
        return ended();
      }
      if (network.complete(path)) {
        if (!judged_ && best_ < kInf) {  // it can be as good as the best, not better
          if (doubtful(path)) {
            const bool proper = price_.proper_within(network, &path, best_ + kEps);
            if (stopped) return kStopped;
            if (proper) queue_.push({rounded(best_), path.columns, serial_++, &path, true, true, false});
            continue;
          }
          if (fewer(path)) continue;
        }
        const double cost = price_(network, &path);
        if (stopped) return kStopped;
        if (cost < kInf) queue_.push({rounded(cost), path.columns, serial_++, &path, true, price_.proper(true), false});
        continue;
      }
      if (network.tall)
        expand_a_little(path, top.bound);
      else
        expand(path, -kInf);
      if (stopped) return kStopped;
    }
    return ended();
  }

  Status left(const Path* path) {
    asked_ = path;
    return kLeft;
  }

  /// Improper structures are only looked at once it is clear that there are no others.
  void wait_for_better(const Path* path, double cost) {
    if (path->columns > columns_) improper_.clear();
    improper_.push_back(path);
    best_ = std::min(best_, cost);
    limit_ = std::min(limit_, cost);
    columns_ = path->columns;
    full_ = static_cast<int>(improper_.size()) >= keep_;
  }

  Status ended() {
    if (improper_.empty()) return cut_ ? kCut : kEnded;
    const Path* first = improper_.front();
    improper_.erase(improper_.begin());
    return left(first);
  }

  /// Take up what a lesser limit left aside; whether there is anything to search.
  bool prepare() {
    if (network.tall) {
      if (!network.bind(limit_)) return false;
      begin_again(limit_ > horizon_);
    } else if (!network.binds && limit_ > horizon_) {
      begin_again(true);
    }
    std::vector<std::pair<double, Path*>> parked;
    parked.swap(parked_);
    for (const auto& [made, path] : parked)
      if (!path->dropped) {
        expand(*path, made);
        if (stopped) return false;
      }
    return true;
  }

  void begin_again(bool binds) {
    network.binds = binds;
    seen_.clear();
    queue_ = {};
    parked_.clear();
    network.clear();
    push(network.later[0], network.root());
  }

  void expand(Path& path, double made) {
    network.children(path, made, limit_, [&](double least, Path& child) { return take(least, child); });
    parked_.push_back({limit_, &path});
  }

  void expand_a_little(Path& path, double least) {
    const double step = path.step > 0 ? path.step : kStep * network.groups[path.group]->canvas;
    const double upto = std::min(limit_, std::max(least, path.made) + step);
    network.children(path, path.made, upto, [&](double bound, Path& child) {
      return bound <= limit_ + kEps && take(bound, child);
    });
    path.made = upto;
    path.step = 2.0 * step;
    if (upto < limit_) push(upto, &path);
  }

  bool take(double least, Path& child) {
    if (!judged_ && seen_.drops(child)) return false;
    push(least, &child, child.late);
    return true;
  }
};
