// By how far rows fall short of W: the same as shortfall.py, which has the proof.
#pragma once

#include <vector>

#include "paths.hpp"

class Shortfall {
 public:
  /// Least cost still to come at the end of a path.
  double operator()(const Group& group, const Path& path) {
    const double width = path.width, canvas = group.canvas, fit = group.prices.fit;
    const double by_loose = group.prices.loose * group.share;
    double longest = 0.0, soft_longest = 0.0, strain = 0.0, gap = 0.0;
    rests_.clear();
    needs_.clear();
    known_.clear();
    if (group.tied) know(group, path);
    for (int b = 0; b < group.count(); ++b) {
      Band& band = *group.bands[b];
      const Position position = path.state[b];
      const int i = position >> 3;
      const bool mid = position & 4;
      double least = mid ? band.rest_min[i + 1] : band.rest_min[i], most = band.rest_max[i];
      if (least > longest) longest = least;
      gap = std::max(gap, band.gap_rest[i]);
      int multiple = 1;
      if (band.tied) {
        if (mid && band.letters[i].sized) {
          const double size = band.letters[i].size;
          const auto [low, high, open] = path.spans[b];
          least = std::max(least, size - high + band.rest_min[i + 1]);
          most = std::min(most, size > low ? size - low + band.rest_max[i + 1] : band.rest_max[i + 1]);
        }
        if (!known_.empty()) {
          const std::vector<Counted>& waiting = band.unsized_from(mid ? i + 1 : i);
          if (!waiting.empty()) {
            int copies = 0;
            std::size_t told = 0;
            double low_sum = 0.0, high_sum = 0.0;
            for (const Counted& own : waiting)
              if (const Learnt* span = find(own.symbol)) {
                ++told;
                copies += own.times;
                low_sum += own.times * span->low;
                high_sum += own.times * span->high;
              }
            multiple += copies;
            least += low_sum;
            if (told == waiting.size() && (!mid || band.letters[i].sized))
              most = (mid ? most_sized(band, i, path.spans[b]) : band.rest_min[i]) + high_sum;
            if (copies > 1) {
              needs_.push_back({width + least, copies});
              least = 0.0;
            }
          }
        }
      }
      if (least > soft_longest) soft_longest = least;
      strain += group.weights[b] * multiple;
      rests_.push_back({most, group.weights[b], by_loose * band.soft_rest[i]});
    }
    const double low = width + longest;
    if (low > canvas + group.tolerance + kEps) return kInf;
    const double below = path.firm ? fit : group.under, scale = strain <= 1.0 ? 1.0 : 1.0 / strain;
    const double soft = width + soft_longest;
    double top = std::max(canvas, soft), best = kInf;
    turns_.assign(1, low);
    if (low < canvas) turns_.push_back(canvas);
    if (low < soft) turns_.push_back(soft);
    for (const Need& need : needs_) {
      if (low < need.reach) turns_.push_back(need.reach);
      top = std::max(top, need.reach);
    }
    for (const Rest& own : rests_)
      if (low < width + own.rest && width + own.rest < top) turns_.push_back(width + own.rest);
    for (const double total : turns_) {
      const double over = total - canvas, future = total - width;
      double value = over > 0 ? fit * over : -below * over, lacking = 0.0, loose = 0.0;
      for (const Rest& own : rests_) {
        const double lack = own.weight * scale * (future - own.rest);
        if (lack > own.loose) lacking += lack - own.loose;
        loose += own.loose;
      }
      double need = soft - total;
      for (const Need& own : needs_) need = std::max(need, (own.reach - total) / own.copies);
      value += loose + (need > lacking ? need : lacking);
      best = std::min(best, value);
    }
    return std::max({best, path.ahead + fit * std::max(0.0, low - canvas), gap});
  }

 private:
  struct Rest {
    double rest, weight, loose;
  };
  struct Need {
    double reach;
    int copies;
  };
  std::vector<Rest> rests_;
  std::vector<Need> needs_;
  std::vector<Learnt> known_;
  std::vector<double> turns_;

  Learnt* find(int symbol) {
    for (Learnt& own : known_)
      if (own.symbol == symbol) return &own;
    return nullptr;
  }

  void know(const Group& group, const Path& path) {
    for (int b = 0; b < group.count(); ++b) {
      if (!(path.state[b] & 4)) continue;
      const Letter& letter = group.bands[b]->letters[path.state[b] >> 3];
      if (letter.sized) continue;
      Learnt* own = find(letter.symbol);
      const double low = path.spans[b].low;
      if (low > (own != nullptr ? own->low : 0.0)) {
        if (own != nullptr)
          *own = {letter.symbol, low, kInf};
        else
          known_.push_back({letter.symbol, low, kInf});
      }
    }
    for (int k = 0; k < path.n_learnt; ++k) {
      if (Learnt* own = find(path.learnt[k].symbol))
        *own = path.learnt[k];
      else
        known_.push_back(path.learnt[k]);
    }
  }

  static double most_sized(const Band& band, int i, const Span& span) {
    return std::max(0.0, band.letters[i].size - span.low) + band.rest_min[i + 1];
  }
};
