// The edges that leave a node: the same as edges.py and tall_edges.py, which have the reasons.
#pragma once

#include <algorithm>
#include <vector>

#include "group.hpp"
#include "paths.hpp"
#include "skeleton.hpp"

class Maker {
 public:
  Maker(Group& group, const Position* state, bool owed, Arena& arena, std::vector<Edge>& made)
      : group_(group), owed_(owed), arena_(arena), made_(made), plain_(group.prices.plain), mu_(group.tolerance + kEps) {
    by_empty_ = group.prices.empty * group.share;
    by_loose_ = group.prices.loose * group.share;
    for (int b = 0; b < group.count(); ++b) {
      choices_.push_back(&group.bands[b]->options(state[b]));
      possible_ = possible_ && !choices_.back()->empty();
    }
    chosen_.assign(group.count(), nullptr);
  }

  /// Every column that makes the bound rise by at most `limit`, or so many of them, whichever come first.
  void make(const Position* state, double limit, std::size_t most) {
    before_ = group_.tall ? 0.0 : group_.ahead(state);
    limit_ = limit + kEps + before_;
    floor_ = -kInf;
    enough_ = most;
    const int n = group_.count();
    if (group_.reference >= 0) order_.push_back(group_.reference);
    for (int b = 0; b < n; ++b)
      if (b != group_.reference) order_.push_back(b);
    rows_.assign(n, nullptr);
    rest_.assign(n + 1, 0.0);
    if (possible_) descend(0, {0.0, kInf, kInf, 0, 0.0, 0, 0.0, false, 0.0});
  }

 protected:
  /// What is known of a column of which some elements are chosen.
  struct Part {
    double high, low, low_all;
    int empties;
    double loose;
    int softs;
    double soft_sizes;
    bool elastic;
    double ahead;
  };

  Group& group_;
  bool owed_, possible_ = true;
  Arena& arena_;
  std::vector<Edge>& made_;
  bool plain_;
  double mu_, by_empty_ = 0.0, by_loose_ = 0.0, before_ = 0.0, limit_ = 0.0, floor_ = -kInf;
  std::size_t enough_ = 0;
  std::vector<const Options*> choices_;
  std::vector<const Option*> chosen_;

  bool pause() { return (++calls_ & 255) == 0 && check(256 * 10); }

  void close(const Part& part) {
    double low = part.low;
    const bool rested = low < kInf;
    if (!rested) low = part.elastic ? part.high : part.low_all;
    const double omega = part.high > low ? part.high - low : 0.0;
    const double cost = omega + by_empty_ * part.empties * part.high +
                        by_loose_ * (part.loose + part.softs * part.high - part.soft_sizes);
    if (cost + part.ahead > limit_ || cost + part.ahead <= floor_ || omega > mu_) return;
    bool some = false, backed = false, begun = false, ended = false, tied = false, guarded = false, pinched = false;
    bool needy = part.empties > 0;
    for (const Option* option : chosen_) {
      if (option->empty) continue;
      some = true;
      begun = begun || option->begins;
      ended = ended || option->ends;
      tied = tied || option->tied;
      guarded = guarded || option->guarded;
      backed = backed || option->opaque;
      needy = needy || option->soft;
      pinched = pinched || (rested && option->elastic && option->least >= part.high - kEps);
    }
    if (!some || (owed_ && !begun) || (needy && !backed && !group_.waived)) return;  // C1
    const int n = group_.count();
    if (guarded)  // C3
      for (int b = 0; b < n; ++b)
        if (chosen_[b]->guarded)
          for (const int other : group_.guards[b])
            if (chosen_[other]->soft) return;
    const bool firm = rested || !part.elastic;
    const Option** column = arena_.room<const Option*>(n);
    Position* state = arena_.room<Position>(n);
    for (int b = 0; b < n; ++b) {
      column[b] = chosen_[b];
      state[b] = chosen_[b]->target;
    }
    made_.push_back({column, state, cost, omega, part.high, low, cost + part.ahead - before_, part.ahead,
                     1.0 + by_empty_ * part.empties + by_loose_ * part.softs, firm, !ended, tied || !firm, tied && firm, pinched});
  }

 private:
  std::vector<int> order_;
  std::vector<const PairTable::Row*> rows_;
  std::vector<double> rest_;
  unsigned calls_ = 0;

  /// Take the reference's element: look the pairs up that its next position is part of.
  void enter(const Option& option) {
    double total = 0.0;
    for (int n = static_cast<int>(order_.size()) - 1; n > 0; --n) {
      const int b = order_[n];
      const PairTable::Row& row = group_.pairs[b]->row(option.target);
      rows_[b] = &row;
      double least = kInf;
      for (const Option& o : *choices_[b]) least = std::min(least, row[o.target >> 2]);
      total += least;
      rest_[n] = total;
    }
  }

  void descend(int n, const Part& part) {
    if (stopped || pause()) return;
    if (n == static_cast<int>(order_.size())) {
      close(part);
      return;
    }
    if (made_.size() >= enough_) return;
    const int b = order_[n];
    const bool chief = n == 0 && group_.reference >= 0;
    const PairTable::Row* pairs = n > 0 ? rows_[b] : nullptr;
    const double* row = pairs != nullptr ? pairs->data() : nullptr;
    // none of these changes on the way, which the compiler cannot know
    const double limit = limit_, mu = mu_, by_empty = by_empty_, by_loose = by_loose_;
    const bool plain = plain_;
    const Part before = part;
    double rest = group_.reference >= 0 ? rest_[n + 1] : 0.0;
    for (const Option& option : *choices_[b]) {
      if (chief) {
        enter(option);
        rest = rest_[1];
      }
      const double ahead = row != nullptr ? before.ahead + row[option.target >> 2] : before.ahead;
      const bool sized = !option.empty && !option.elastic;
      const double size = option.size;
      const double high = std::max(before.high, option.least);
      const double low = sized && size < before.low && (plain || !option.soft) ? size : before.low;
      const double loose = sized ? before.loose + option.loose : before.loose;
      const int empties = before.empties + option.empty;
      const double omega = low < kInf ? high - low : 0.0;
      const double bound = omega + by_empty * empties * high + by_loose * loose + ahead + rest;
      if (omega > mu || bound > limit) {
        if (!option.elastic && size > before.low && omega > std::min(mu, limit) && !option.transparent)
          break;  // longer runs are dearer still
        continue;
      }
      Part own{high, low, sized && size < before.low_all ? size : before.low_all, empties, loose, before.softs,
               before.soft_sizes, before.elastic || option.elastic, ahead};
      if (sized && option.soft) {
        ++own.softs;
        own.soft_sizes += size;
      }
      chosen_[b] = &option;
      descend(n + 1, own);
    }
  }
};

/// Makes the edges that leave a node of a tall stack: columns whose right edge lies where the skeleton has one.
class Stepper : public Maker {
 public:
  Stepper(Group& group, const Path& path, Arena& arena, std::vector<Edge>& made, const Skeleton& skeleton)
      : Maker(group, path.state, path.owed, arena, made), skeleton_(skeleton), width_(path.width) {}

  void make(double made, double limit, std::size_t most) {
    slack_ = limit + kEps;
    made_before_ = made + kEps;
    most_ = most;
    if (!possible_) return;
    std::vector<double> heights;
    for (const Options* options : choices_)
      for (const Option& o : *options)
        if (!o.elastic && !o.empty) heights.push_back(o.size);
    if (!group_.stiff) heights.push_back(0.0);
    std::sort(heights.begin(), heights.end());
    double last = -kInf;
    for (const double height : heights) {
      if (height <= last + kEps) continue;
      last = height;
      const double right = width_ + height;
      if (right > skeleton_.width + kEps) break;
      const double rest = skeleton_.ahead(right, group_.stiff ? right : skeleton_.width);
      if (rest <= slack_) fill(height, right, rest);
      if (stopped) return;
    }
  }

 private:
  /// An element at the column's width: its price, its size (infinite: it does not count in ω), whether it is as wide.
  struct Choice {
    double price, size;
    bool hit;
    const Option* option;
  };
  struct Choices {
    int band;
    std::vector<Choice> own;
  };

  const Skeleton& skeleton_;
  double width_, slack_ = 0.0, made_before_ = 0.0;
  std::size_t most_ = 0;
  std::vector<Choices> options_;
  std::vector<double> after_;
  std::vector<char> hits_;

  /// All columns of one width.
  void fill(double height, double right, double rest) {
    const double room = skeleton_.width - right + kEps;
    options_.resize(group_.count());
    for (int b = 0; b < group_.count(); ++b) {
      Choices& all = options_[b];
      all.band = b;
      all.own.clear();
      for (const Option& option : *choices_[b]) {
        if (!option.elastic && !option.empty && option.size > height + kEps) {
          if (!option.transparent) break;
          continue;
        }
        if (group_.bands[b]->at_least(option.target) > room) continue;
        if (option.empty) {
          all.own.push_back({by_empty_ * height, kInf, false, &option});
        } else if (option.elastic) {
          all.own.push_back({0.0, kInf, false, &option});
        } else {
          const double loose = option.loose + (option.soft ? height - option.size : 0.0);
          const bool counts = plain_ || !option.soft;
          all.own.push_back({by_loose_ * loose, counts ? option.size : kInf, option.size >= height - kEps, &option});
        }
      }
      if (all.own.empty()) return;
    }
    for (Choices& all : options_)
      std::stable_sort(all.own.begin(), all.own.end(),
                       [](const Choice& a, const Choice& b) { return a.price < b.price; });
    std::stable_sort(options_.begin(), options_.end(),
                     [](const Choices& a, const Choices& b) { return a.own.size() < b.own.size(); });
    const int n = group_.count();
    after_.assign(n + 1, rest);
    hits_.assign(n + 1, height <= kEps);
    for (int k = n - 1; k >= 0; --k) {
      after_[k] = after_[k + 1] + options_[k].own[0].price;
      hits_[k] = hits_[k + 1];
      for (const Choice& choice : options_[k].own) hits_[k] = hits_[k] || choice.hit;
    }
    if (!hits_[0] || after_[0] > slack_) return;
    limit_ = slack_ - rest;
    floor_ = made_before_ - rest;
    enough_ = most_ >= SIZE_MAX - made_.size() ? SIZE_MAX : made_.size() + most_;
    choose(0, height, 0.0, kInf, height <= kEps);
  }

  void choose(int n, double height, double price, double low, bool hit) {
    if (stopped || pause()) return;
    if (n == static_cast<int>(options_.size())) {
      if (hit) finish(height);
      return;
    }
    if ((!hit && !hits_[n]) || made_.size() >= enough_) return;
    const double room = slack_ - price - after_[n + 1];
    for (const Choice& choice : options_[n].own) {
      const double low_ = std::min(low, choice.size), omega = low_ < kInf ? height - low_ : 0.0;
      if (choice.price > room) break;
      if (omega + choice.price > room || omega > mu_) continue;
      chosen_[options_[n].band] = choice.option;
      choose(n + 1, height, price + choice.price, low_, hit || choice.hit);
    }
  }

  void finish(double height) {
    Part part{height, kInf, kInf, 0, 0.0, 0, 0.0, false, 0.0};
    for (const Option* option : chosen_) {
      if (option->empty) {
        ++part.empties;
      } else if (option->elastic) {
        part.elastic = true;
      } else {
        part.low_all = std::min(part.low_all, option->size);
        if (plain_ || !option->soft) part.low = std::min(part.low, option->size);
        part.loose += option->loose;
        if (option->soft) {
          ++part.softs;
          part.soft_sizes += option->size;
        }
      }
    }
    close(part);
  }
};
