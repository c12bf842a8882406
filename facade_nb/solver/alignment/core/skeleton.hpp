// Where the columns of many rows can end: the same as skeleton.py, which has the reasons.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "group.hpp"

class Skeleton {
 public:
  double root = kInf, width;

  Skeleton(const Group& group, double limit) : width(greatest_width(group, limit)), group_(group), limit_(limit) {
    by_empty_ = group.prices.empty * group.share;
    by_loose_ = group.prices.loose * group.share;
    for (const auto& band : group.bands) {
      if (!band->rigid) continue;
      Row row;
      row.band = band.get();
      for (const double rest : band->rest_min) row.prefix.push_back(band->rest_min[0] - rest);
      const int n = band->size();
      row.loose.assign(1, 0.0);
      row.softs.assign(1, 0);
      for (int i = 0; i < n; ++i) {
        if (i > 0)
          row.loose.push_back(row.loose.back() + std::fmin(band->letters[i - 1].size, band->letters[i].size));
        row.softs.push_back(row.softs.back() + !band->letters[i].opaque);
      }
      row.loose.push_back(0.0);
      rows_.push_back(std::move(row));
    }
    build();
  }

  /// What is still to be paid by a path whose W so far lies between two values.
  double ahead(double low, double high) const {
    double best = kInf;
    auto at = std::upper_bound(kept_.begin(), kept_.end(), high + kEps,
                               [](double value, const Cell& cell) { return value < cell.low; });
    while (at != kept_.begin()) {
      --at;
      if (at->high < low - kEps) break;
      best = std::min(best, at->rest);
    }
    return best;
  }

 private:
  static constexpr int kCoarse = 20, kRounds = 6, kCells = 150, kBins = 14, kWindow = 6, kSteps = kBins + 1;

  struct Interval {
    double low, high;
  };
  struct Cell {
    double low, high, rest;
  };
  struct Row {
    const Band* band;
    std::vector<double> prefix, loose;
    std::vector<int> softs, first, last;
  };
  using Intervals = std::vector<Interval>;

  const Group& group_;
  double limit_, by_empty_, by_loose_;
  std::vector<Row> rows_;
  std::vector<Cell> kept_;

  static double greatest_width(const Group& group, double limit) {
    const double top = group.canvas + group.tolerance, fit = group.prices.fit;
    struct Rest {
      double rest, weight;
    };
    std::vector<Rest> rests;
    double width = group.bands.empty() ? 0.0 : group.bands[0]->rest_min[0];
    for (int b = 0; b < group.count(); ++b) {
      rests.push_back({group.bands[b]->rest_max[0], group.weights[b]});
      width = std::max(width, group.bands[b]->rest_min[0]);
    }
    std::sort(rests.begin(), rests.end(), [](const Rest& a, const Rest& b) {
      return a.rest < b.rest || (a.rest == b.rest && a.weight < b.weight);
    });
    auto cost = [&](double w) {
      double total = 0.0;
      for (const Rest& own : rests)
        if (own.rest < w) total += own.weight * (w - own.rest);
      return fit * std::max(0.0, w - group.canvas) + total;
    };
    std::vector<double> turns{group.canvas};
    for (const Rest& own : rests) turns.push_back(own.rest);
    std::sort(turns.begin(), turns.end());
    turns.erase(std::unique(turns.begin(), turns.end()), turns.end());
    turns.erase(std::remove_if(turns.begin(), turns.end(), [&](double t) { return t <= width || t >= top; }),
                turns.end());
    turns.push_back(top);
    double a = width;
    for (const double b : turns) {
      const double high = cost(b);
      if (high > limit) {
        const double low = cost(a);
        return low > limit ? a : a + (b - a) * (limit - low) / (high - low) + kEps;
      }
      a = b;
    }
    return top;
  }

  // From coarse to fine: cells that no alignment within the limit can use are dropped, the others are split.
  void build() {
    const double size = group_.canvas / kCoarse;
    Intervals between = cells(places(), size), ends = cells(end_runs(), size);
    std::vector<Cell> kept;
    for (int round = 0; round < kRounds; ++round) {
      if (check(1000)) return;
      if (ends.empty()) {
        root = kInf;
        return;
      }
      std::vector<double> through, rest;
      walk(between, ends, through, rest);
      root = rest[0];
      Intervals between_left, ends_left;
      kept.clear();
      for (std::size_t k = 0; k < between.size(); ++k)
        if (through[k + 1] <= limit_ + kEps) {
          between_left.push_back(between[k]);
          kept.push_back({between[k].low, between[k].high, rest[k + 1]});
        }
      for (std::size_t k = 0; k < ends.size(); ++k)
        if (through[between.size() + 1 + k] <= limit_ + kEps) ends_left.push_back(ends[k]);
      between = std::move(between_left);
      ends = std::move(ends_left);
      if (root > limit_ + kEps) {
        root = kInf;
        return;
      }
      if (between.size() + ends.size() > kCells / 2) break;
      double far = -kInf;
      for (const Interval& own : ends) far = std::max(far, own.high);
      width = std::min(width, far);
      between = halves(between);
      ends = halves(ends);
    }
    kept_ = std::move(kept);
  }

  /// Per cell (the start, those between, the ends): least cost of an alignment through it, and of the rest.
  void walk(const Intervals& between, const Intervals& ends, std::vector<double>& through, std::vector<double>& rest) {
    Intervals all{{0.0, 0.0}};
    all.insert(all.end(), between.begin(), between.end());
    all.insert(all.end(), ends.begin(), ends.end());
    const int m = static_cast<int>(between.size()), total = static_cast<int>(all.size());
    windows(all, m);
    std::vector<double> table = columns(all, m);
    rest.assign(total, kInf);
    const double canvas = group_.canvas, fit = group_.prices.fit;
    for (int k = m + 1; k < total; ++k)
      rest[k] = fit * std::max({0.0, all[k].low - canvas, canvas - all[k].high});
    for (int k = m; k >= 0; --k)
      for (int j = k + 1; j < total; ++j) rest[k] = std::min(rest[k], table[k * total + j] + rest[j]);
    std::vector<double> laid(total, kInf);
    laid[0] = 0.0;
    for (int k = 1; k < total; ++k)
      for (int i = 0; i < std::min(k, m + 1); ++i) laid[k] = std::min(laid[k], laid[i] + table[i * total + k]);
    through.resize(total);
    for (int k = 0; k < total; ++k) through[k] = laid[k] + rest[k];
  }

  /// Where every row has a letter boundary within its slack, without the ends.
  Intervals places() const {
    Intervals runs{{0.0, width}};
    for (const Row& row : rows_) {
      const double slack = width - row.band->rest_min[0];
      Intervals own;
      for (const double s : row.prefix) {
        if (!own.empty() && s <= own.back().high + kEps)
          own.back().high = s + slack;
        else
          own.push_back({s, s + slack});
      }
      runs = meet(runs, own);
    }
    return runs;
  }

  Intervals end_runs() const {
    double least = group_.bands.empty() ? 0.0 : group_.bands[0]->rest_min[0];
    for (const auto& band : group_.bands) least = std::max(least, band->rest_min[0]);
    if (least > width + kEps) return {};
    const double canvas = group_.canvas, most = std::max(least, width);
    if (least < canvas && canvas < width) return {{least, canvas}, {canvas, most}};
    return {{least, most}};
  }

  /// Per row, per cell: the first and the last letter it may stand at.
  void windows(const Intervals& all, int m) {
    for (Row& row : rows_) {
      const double slack = width - row.band->rest_min[0];
      const std::vector<double>& prefix = row.prefix;
      row.first.resize(all.size());
      row.last.resize(all.size());
      for (std::size_t k = 0; k < all.size(); ++k) {
        const auto a = std::lower_bound(prefix.begin(), prefix.end(), all[k].low - slack - 1e-9);
        const auto z = std::upper_bound(prefix.begin(), prefix.end(), all[k].high + 1e-9);
        row.first[k] = static_cast<int>(a - prefix.begin());
        row.last[k] = static_cast<int>(z - prefix.begin()) - 1;
        if (k == 0) row.first[k] = row.last[k] = 0;
        if (static_cast<int>(k) > m) row.first[k] = row.last[k] = row.band->size();
      }
    }
  }

  /// Least cost of a column from each cell to each later one.
  std::vector<double> columns(const Intervals& all, int m) {
    const int total = static_cast<int>(all.size());
    std::vector<double> table(static_cast<std::size_t>(total) * total, kInf);
    double steps[kSteps], floor[kSteps];
    steps[0] = 0.0;
    steps[1] = 1e-8;
    const double most_omega = std::min(limit_, group_.tolerance);
    for (int k = 1; k < kBins; ++k) steps[k + 1] = k * (most_omega / (kBins - 1));
    steps[kSteps - 1] = most_omega;
    floor[0] = 0.0;
    for (int k = 1; k < kSteps; ++k) floor[k] = steps[k - 1];
    std::vector<const Row*> asked;
    for (const Row& row : rows_)
      if (telling(row, m, total)) asked.push_back(&row);
    for (int i = 0; i <= m && !stopped; ++i) {
      if (check(static_cast<unsigned>(10 * asked.size() * total))) break;
      for (int j = i + 1; j < total; ++j) {
        const double least = std::max(0.0, all[j].low - all[i].high), most = all[j].high - all[i].low;
        double sum[kSteps] = {};
        bool open = true;
        for (const Row* row : asked) {
          double own[kSteps + 1];
          std::fill(own, own + kSteps + 1, kInf);
          element(*row, i, j, least, most, steps, own);
          double low = kInf;
          open = false;
          for (int k = 0; k < kSteps; ++k) {
            low = std::min(low, own[k]);
            sum[k] += low;
            open = open || sum[k] < kInf;
          }
          if (!open) break;
        }
        if (!open) continue;
        double best = kInf;
        for (int k = 0; k < kSteps; ++k) best = std::min(best, sum[k] + floor[k]);
        table[static_cast<std::size_t>(i) * total + j] = best;
      }
    }
    return table;
  }

  /// A row that may stand at too many letters says too little to be asked.
  bool telling(const Row& row, int m, int total) const {
    double sum = 0.0, pairs = 0.0;
    for (int i = 0; i <= m; ++i)
      for (int j = i + 1; j < total; ++j) {
        sum += (row.last[i] - row.first[i] + 1) * (row.last[j] - row.first[j] + 1);
        ++pairs;
      }
    return !(pairs > 0 && sum / pairs > kWindow * kWindow);
  }

  /// Per step of ω: what the row costs at least whose element needs no more.
  void element(const Row& row, int i, int j, double least, double most, const double* steps, double* own) const {
    const int ai = row.first[i], zi = row.last[i], aj = row.first[j], zj = row.last[j];
    if (std::min(zi, zj) >= std::max(ai, aj)) own[0] = by_empty_ * least;
    for (int p = ai; p <= zi; ++p)
      for (int q = std::max(aj, p + 1); q <= zj; ++q) {
        const double size = row.prefix[q] - row.prefix[p];
        if (size > most + 1e-9) break;
        const double lacks = std::max(0.0, least - size);
        const bool soft = row.softs[q] > row.softs[p];
        double price = by_loose_ * (row.loose[std::max(q - 1, 0)] - row.loose[p]);
        if (soft) price += by_loose_ * lacks;
        const double need = soft ? 0.0 : lacks;
        const int k = static_cast<int>(std::lower_bound(steps, steps + kSteps, need - 1e-9) - steps);
        own[k] = std::min(own[k], price);
      }
  }

  static Intervals cells(const Intervals& runs, double size) {
    Intervals out;
    for (const Interval& run : runs) {
      const int parts = std::max(1, static_cast<int>(std::ceil((run.high - run.low) / size - 1e-6)));
      const double step = (run.high - run.low) / parts;
      for (int k = 0; k < parts; ++k)
        out.push_back({k * step + run.low, k + 1 == parts ? run.high : (k + 1) * step + run.low});
    }
    return out;
  }

  static Intervals halves(const Intervals& cells) {
    Intervals out;
    for (const Interval& cell : cells) {
      const double middle = (cell.low + cell.high) / 2.0;
      const bool wide = cell.high - cell.low > 1e-6;
      out.push_back({cell.low, wide ? middle : cell.high});
    }
    for (const Interval& cell : cells)
      if (cell.high - cell.low > 1e-6) out.push_back({(cell.low + cell.high) / 2.0, cell.high});
    std::stable_sort(out.begin(), out.end(), [](const Interval& a, const Interval& b) { return a.low < b.low; });
    return out;
  }

  static Intervals meet(const Intervals& a, const Intervals& b) {
    Intervals out;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
      const double low = std::max(a[i].low, b[j].low), high = std::min(a[i].high, b[j].high);
      if (low <= high + kEps) out.push_back({low, std::max(low, high)});
      if (a[i].high < b[j].high)
        ++i;
      else
        ++j;
    }
    return out;
  }
};
