// Good alignments soon: the same as dives.py, which has the reasons. Structures that are cheap enough are judged in Python.
#pragma once

#include <queue>
#include <vector>

#include "network.hpp"
#include "pricing.hpp"
#include "best_first.hpp"

/// The least cost of aligning the reference and one other word through two positions.
class BothWays {
 public:
  double least;

  BothWays(const Group& group, Band& reference, Band& other)
      : turned_reference_(turned(reference)),
        turned_other_(turned(other)),
        ahead_(reference, other, group.prices, group.share, 1),
        behind_(turned_reference_, turned_other_, group.prices, group.share, 1),
        end_reference_(2 * reference.size()),
        end_other_(2 * other.size()) {
    least = ahead_.at(0, 0);
  }

  /// What has to be paid before and after.
  double through(Position reference, Position other) {
    const int a = reference >> 2, b = other >> 2;
    return ahead_.row(a << 2)[b] + behind_.row((end_reference_ - a) << 2)[end_other_ - b];
  }

 private:
  Band turned_reference_, turned_other_;
  PairTable ahead_, behind_;
  int end_reference_, end_other_;

  static Band turned(const Band& band) {
    Band own;
    own.letters.assign(band.letters.rbegin(), band.letters.rend());
    own.cuts = band.cuts;
    own.finish();
    return own;
  }
};

class Dives {
 public:
  double limit, done = 0.0;

  Dives(std::vector<Group*> groups, double least, bool sizable) : network(groups, most(groups)) {
    network.sizable = sizable;
    const double canvas = [&] {
      double own = 0.0;
      for (const Group* group : groups) own = std::max(own, group->canvas);
      return own;
    }();
    canvas_ = canvas;
    for (Group* group : groups) {
      pairs_.emplace_back();
      for (int b = 0; b < group->count(); ++b)
        pairs_.back().push_back(group->reference < 0 || b == group->reference
                                    ? nullptr
                                    : std::make_unique<BothWays>(*group, *group->bands[group->reference], *group->bands[b]));
    }
    done = network.later[0] == kInf;
    limit = std::max(least, network.later[0]);
  }

  Network network;

  const Path* asked() const { return asked_; }

  /// The first time: everything anew below a limit a little above the least cost.
  Status begin(double ceiling) {
    ceiling_ = ceiling;
    if (!done) widen();
    return stopped ? kStopped : kEnded;
  }

  /// Go through the network once; it may end in a structure that is to be priced.
  Status dive(bool any) {
    asked_ = nullptr;
    if (done) return kEnded;
    if (idle_ >= kPatience || !waits()) {
      if (any || limit >= ceiling_)
        done = !waits();
      else
        widen();
      idle_ = 0;
    }
    for (std::size_t depth = 0; depth < waiting_.size(); ++depth) {
      go_deeper(waiting_[depth]);
      if (stopped) return kStopped;
      if (asked_ != nullptr) {
        if (price_(network, asked_) <= limit + kEps) return kPrice;
        if (stopped) return kStopped;
      }
    }
    return missed();
  }

  /// The dive ended in nothing better.
  Status missed() {
    ++idle_;
    return kEnded;
  }

  /// It ended in an alignment of this cost.
  Status found(double cost) {
    limit = cost - 2 * kEps;
    idle_ = 0;
    start();
    return stopped ? kStopped : kEnded;
  }

 private:
  static constexpr int kDepths = 40, kPatience = 5;
  static constexpr std::size_t kMost = 24;
  static constexpr double kStep = 0.003;

  struct Rank {
    double rank;
    long long serial;
    double bound;
    Path* path;
    bool operator<(const Rank& other) const {  // the greatest comes first
      return rank != other.rank ? rank > other.rank : serial > other.serial;
    }
  };
  using Queue = std::priority_queue<Rank>;
  struct Child {
    double bound;
    Path* path;
  };

  std::vector<std::vector<std::unique_ptr<BothWays>>> pairs_;
  std::vector<Queue> waiting_;
  std::vector<Child> children_;  // pushed together, as what is pushed may change what waits
  double canvas_ = 0.0, ceiling_ = kInf;
  long long serial_ = 0;
  int idle_ = 0;
  const Path* asked_ = nullptr;
  Pricer price_;

  static std::size_t most(const std::vector<Group*>& groups) {
    for (const Group* group : groups)
      if (group->tall || group->prices.plain) return kMost;
    return SIZE_MAX;
  }

  bool waits() const {
    for (const Queue& queue : waiting_)
      if (!queue.empty()) return true;
    return false;
  }

  void go_deeper(Queue& queue) {
    while (!queue.empty()) {
      const Rank top = queue.top();
      queue.pop();
      if (top.bound > limit + kEps) continue;
      if (check(1000)) return;
      if (network.complete(*top.path)) {
        asked_ = top.path;
        return;
      }
      if (go_on(*top.path, top.bound) || stopped) return;
    }
  }

  void widen() {
    limit = std::min(ceiling_, limit * 1.3 + 0.01 * canvas_);
    start();
  }

  void start() {
    waiting_.clear();
    waiting_.resize(kDepths * network.groups.size() + 1);
    network.clear();
    if (network.bind(limit)) push(network.later[0], network.root());
  }

  void push(double bound, Path* path) {
    waiting_[depth(*path)].push({bound + strays(*path), serial_++, bound, path});
  }

  /// By how much the rows, two by two, leave their own best alignments with the reference.
  double strays(const Path& path) {
    if (network.complete(path)) return 0.0;
    const int reference = network.groups[path.group]->reference;
    if (reference < 0) return 0.0;
    double total = 0.0;
    auto& pairs = pairs_[path.group];
    for (std::size_t b = 0; b < pairs.size(); ++b)
      if (pairs[b]) total += pairs[b]->through(path.state[reference], path.state[b]) - pairs[b]->least;
    return total;
  }

  int depth(const Path& path) const {
    const int groups = static_cast<int>(network.groups.size());
    if (network.complete(path)) return kDepths * groups;
    const Group& group = *network.groups[path.group];
    double part = 0.0;
    for (int b = 0; b < group.count(); ++b)
      part += static_cast<double>(path.state[b] >> 2) / (2 * std::max(1, group.bands[b]->size()));
    return path.group * kDepths + std::min(kDepths - 1, static_cast<int>(kDepths * part / group.count()));
  }

  /// Make the columns that raise the bound least; the path waits for its turn to make more.
  bool go_on(Path& path, double bound) {
    double step = path.step > 0 ? path.step : kStep * canvas_, upto;
    children_.clear();
    do {
      upto = std::min(limit, std::max(bound, path.made) + step);
      network.children(path, path.made, upto, [&](double least, Path& child) {
        children_.push_back({least, &child});
        return true;
      });
      if (stopped) return false;
      path.made = upto;
      step *= 2.0;
    } while (children_.empty() && upto < limit);
    for (const Child& child : children_) push(child.bound, child.path);
    path.step = step;
    if (upto < limit) push(upto, &path);
    return !children_.empty();
  }
};
