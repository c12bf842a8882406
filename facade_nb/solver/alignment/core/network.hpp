// The alignment decision network, made as it is walked: the same as network.py, which has the reasons.
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

#include "edges.hpp"
#include "paths.hpp"
#include "shortfall.hpp"
#include "skeleton.hpp"

class Network {
 public:
  std::vector<Group*> groups;
  std::vector<double> later;  // per group, and behind the last: lower bound from there on
  Arena arena;
  Trails trails;
  Gatherer gatherer;
  bool binds = false, tall = false;
  bool sizable = false;  // leave columns out that no sizes of symbols can make
  std::size_t most;

  explicit Network(std::vector<Group*> own, std::size_t most_ = SIZE_MAX) : groups(std::move(own)), most(most_) {
    skeletons_.resize(groups.size());
    later.assign(groups.size() + 1, 0.0);
    for (int g = static_cast<int>(groups.size()) - 1; g >= 0; --g) {
      tall = tall || groups[g]->tall;
      later[g] = later[g + 1] + shortfall_(*groups[g], *enter(g));
    }
  }

  /// Look only for what costs at most `limit` from here on; false: there is no such alignment.
  bool bind(double limit) {
    std::vector<double> floors;
    double total = 0.0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      floors.push_back(later[g] - later[g + 1]);
    }
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (!groups[g]->tall) continue;
      total = 0.0;
      for (const double own : floors) total += own;
      skeletons_[g] = std::make_unique<Skeleton>(*groups[g], limit - total + floors[g]);
      if (skeletons_[g]->root == kInf) return false;
      floors[g] = std::max(floors[g], skeletons_[g]->root);
    }
    for (int g = static_cast<int>(groups.size()) - 1; g >= 0; --g) later[g] = later[g + 1] + floors[g];
    return later[0] <= limit + kEps;
  }

  Path* root() { return enter(0); }

  bool complete(const Path& path) const { return path.group == static_cast<int>(groups.size()); }

  /// Lets go of every path there is.
  void clear() {
    arena.clear();
    trails.clear();
    gatherer.clear();
  }

  /// Gives to `take` each path longer by one column, with its bound, that keeps within `limit`, but did not within `made`.
  /// Those that it does not want are forgotten at once.
  template <class Take>
  void children(const Path& path, double made, double limit, const Take& take) {
    Group& group = *groups[path.group];
    const int n = group.count(), last = static_cast<int>(groups.size());
    const double after = later[path.group + 1], laid = path.cost + path.ahead + after;
    const Skeleton* skeleton = skeletons_[path.group].get();
    edges_.clear();
    const Edge *begin, *end;
    if (skeleton != nullptr) {
      const double own = path.cost + after;
      Stepper(group, path, arena, edges_, *skeleton).make(made - own, limit - own, most);
      begin = edges_.data();
      end = begin + edges_.size();
    } else if (most != SIZE_MAX) {
      Maker(group, path.state, path.owed, arena, edges_).make(path.state, limit - laid, most);
      begin = edges_.data();
      end = begin + edges_.size();
    } else {
      const Known& known = edges(group, path.state, path.owed, limit - laid);
      auto upto = [&](double rise) {
        return std::upper_bound(known.edges, known.edges + known.count, rise + kEps,
                                [](double value, const Edge& edge) { return value < edge.rise; });
      };
      begin = upto(made - laid);
      end = upto(limit - laid);
    }
    if (stopped) return;
    for (const Edge* edge = begin; edge < end; ++edge) {
      if (sizable && group.unsizable(edge->column)) continue;
      if (check(300)) return;
      const Arena::Mark before = arena.mark();
      Path* child = arena.room<Path>(1);
      *child = {};
      child->parent = &path;
      child->column = edge->column;
      child->columns = path.columns + 1;
      child->cost = path.cost + edge->cost;
      child->made = -kInf;
      child->ranges = path.ranges;
      child->n_ranges = path.n_ranges;
      child->learnt = path.learnt;
      child->n_learnt = path.n_learnt;
      child->spans = path.spans;
      child->pinched = path.pinched || edge->pinched;
      const double width = path.width + edge->width;
      const bool firm = path.firm && edge->firm;
      int trail = path.trail;
      if (edge->tied) {
        if (edge->pieces) {
          column_.assign(edge->column, edge->column + n);
          gatherer.gather(path, trails, *edge, column_, binds ? group.tolerance : kInf);
          Range* ranges = arena.room<Range>(gatherer.count());
          gatherer.write(ranges);
          child->ranges = ranges;
          child->n_ranges = gatherer.count();
        } else {
          trail = trails.with_column(trail, path.group, edge->column, n);
        }
      }
      bool done = true;
      for (int b = 0; b < n && done; ++b) done = edge->state[b] >> 2 == group.bands[b]->end >> 2;
      double bound;
      if (done) {
        child->cost += closing(group, width, firm);
        bound = child->cost + after;
        if (bound == kInf) {
          arena.rewind(before);
          continue;
        }
        if (child->n_ranges > 0 || width < group.canvas - group.tolerance - kEps)
          trail = trails.alone(trail);  // only its price can tell how wide it gets, so it is like no other
        else if (trail != 0)
          trail = trails.with_width(trail, width);  // what the pieces come to is added to this
        if (group.tied) learn(group, path, *edge, *child);
        child->group = path.group + 1;
        child->firm = true;
        child->late = child->pinched;
        if (child->group < last) {
          Group& next = *groups[child->group];
          start(next, *child);
          child->ahead = next.ahead(child->state);
        }
      } else {
        child->group = path.group;
        child->state = edge->state;
        child->width = width;
        child->firm = firm;
        child->owed = edge->owed;
        if (group.tied) learn(group, path, *edge, *child);
        child->ahead = group.tall ? group.ahead(edge->state) : edge->ahead;
        double rest = shortfall_(group, *child);
        if (skeleton != nullptr) rest = std::max(rest, skeleton->ahead(width, group.stiff ? width : skeleton->width));
        bound = child->cost + rest + after;
        child->late = child->pinched && rest <= apart(group, *child) + kEps;
      }
      child->trail = trail;
      if (bound == kInf || !take(bound, *child)) arena.rewind(before);
    }
  }

 private:
  std::vector<std::unique_ptr<Skeleton>> skeletons_;
  Shortfall shortfall_;
  std::vector<Edge> edges_;
  std::vector<const Option*> column_;

  Path* enter(int g) {
    Group& group = *groups[g];
    Path* path = arena.room<Path>(1);
    *path = {};
    path->group = g;
    path->firm = true;
    path->made = -kInf;
    start(group, *path);
    path->ahead = group.ahead(path->state);
    return path;
  }

  void start(const Group& group, Path& path) {
    Position* state = arena.room<Position>(group.count());
    Span* spans = arena.room<Span>(group.count());
    std::fill(state, state + group.count(), 0);
    std::fill(spans, spans + group.count(), Span{0.0, 0.0, false});
    path.state = state;
    path.spans = spans;
  }

  /// Edges of a node that rise by at most `limit`, and perhaps more; kept with the group, as other paths lead to it too.
  const Known& edges(Group& group, const Position* state, bool owed, double limit) {
    constexpr double kFurther = 0.01;  // a fraction of the canvas: limits grow in small steps
    const int n = group.count();
    std::uint64_t hash = mixed(3, owed);
    for (int b = 0; b < n; ++b) hash = mixed(hash, state[b]);
    Known*& known = group.known.find(
        hash, [&](const Known& other) { return other.owed == owed && std::equal(state, state + n, other.state); });
    if (known == nullptr) {
      Position* own = group.arena.room<Position>(n);
      std::copy(state, state + n, own);
      known = group.arena.room<Known>(1);
      *known = {own, owed, -kInf, nullptr, 0};
    }
    if (known->limit < limit) {
      const double further = limit + kFurther * group.canvas;
      edges_.clear();
      Maker(group, state, owed, group.arena, edges_).make(state, further, SIZE_MAX);
      std::stable_sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) { return a.rise < b.rise; });
      if (!stopped) {
        Edge* own = group.arena.room<Edge>(edges_.size());
        std::copy(edges_.begin(), edges_.end(), own);
        known->limit = further;
        known->edges = own;
        known->count = edges_.size();
      }
    }
    return *known;
  }

  /// What is still to come costs at least, whatever the pieces that are laid have paid for.
  static double apart(const Group& group, const Path& path) {
    double least = 0.0;
    for (int b = 0; b < group.count(); ++b) least = std::max(least, group.bands[b]->at_least(path.state[b]));
    return path.ahead + group.prices.fit * std::max(0.0, path.width + least - group.canvas);
  }

  /// What the pieces in a column say about the letters they belong to, and whether one of those is pinched.
  void learn(const Group& group, const Path& path, const Edge& edge, Path& child) {
    const int n = group.count();
    const double least = edge.firm ? edge.least : 0.0, most = edge.firm ? edge.width : kInf;
    Span* spans = arena.room<Span>(n);
    learnt_.assign(path.learnt, path.learnt + path.n_learnt);
    for (int b = 0; b < n; ++b) {
      const Band& band = *group.bands[b];
      const Option& option = *edge.column[b];
      Span span = path.spans[b];
      if (!band.tied || option.empty) {
        spans[b] = span;
        continue;
      }
      if (!option.transparent) {
        spans[b] = {0.0, 0.0, false};
        continue;
      }
      const double low = option.count == 1 ? least : 0.0;
      const int last = option.first + option.count - 1;
      for (int i = option.first; i <= last; ++i) {
        const Span begun = i == option.first && !option.begins ? span : Span{0.0, 0.0, false};
        span = {begun.low + low, begun.high + most, begun.open || low <= kEps};
        const Letter& letter = band.letters[i];
        if (letter.sized && span.low >= letter.size - kEps)
          child.pinched = child.pinched || span.open || (i == last && !option.ends);
        if ((i != last || option.ends) && !letter.sized && !letter.free) {
          bool fresh = true;
          for (const Learnt& own : learnt_) fresh = fresh && own.symbol != letter.symbol;
          if (fresh) learnt_.push_back({letter.symbol, span.low, span.high});
        }
      }
      spans[b] = option.ends ? Span{0.0, 0.0, false} : span;
    }
    child.spans = spans;
    if (static_cast<int>(learnt_.size()) != path.n_learnt) {
      Learnt* own = arena.room<Learnt>(learnt_.size());
      std::copy(learnt_.begin(), learnt_.end(), own);
      child.learnt = own;
      child.n_learnt = static_cast<int>(learnt_.size());
    }
  }
  std::vector<Learnt> learnt_;

  /// Price of W at the end of a group: exact where nothing is elastic, a lower bound otherwise.
  static double closing(const Group& group, double width, bool firm) {
    const double over = width - group.canvas, fit = group.prices.fit;
    if (over > group.tolerance + kEps || (group.stiff && -over > group.tolerance + kEps)) return kInf;
    return over > 0 ? fit * over : -(firm ? fit : group.under) * over;
  }
};
