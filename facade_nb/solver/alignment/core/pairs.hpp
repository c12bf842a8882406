// What two rows cost each other at least: the same as pairs.py.
#pragma once

#include <memory>
#include <vector>

#include "words.hpp"

struct Prices {
  double empty, loose, fit;
  bool plain;
};

class PairTable {
 public:
  using Row = std::vector<double>;

  PairTable(Band& reference, Band& other, const Prices& prices, double share, int pairs)
      : reference_(reference),
        other_(other),
        part_(1.0 / pairs),
        empty_(prices.empty * share),
        loose_(prices.loose * share),
        plain_(prices.plain),
        rows_(2 * reference.letters.size() + 1),
        nothing_(2 * other.letters.size() + 1, kInf) {}

  double at(Position reference, Position other) { return row(reference)[other >> 2]; }

  /// Bounds for all places of the other word. Works from the end, and only as far as it is asked to.
  const Row& row(Position reference) {
    const int place = reference >> 2;
    if (!rows_[place])
      for (int p = static_cast<int>(rows_.size()) - 1; p >= place; --p) {
        if (!rows_[p]) fill(p);
        if (stopped) {  // the row is not to be relied on, but something has to be said
          rows_[p].reset();
          return nothing_;
        }
      }
    return *rows_[place];
  }

 private:
  struct Move {
    int end;
    double size, own;  // negative: elastic
    bool soft;
  };
  struct Reach {
    double size, own;
    bool soft;
    const Row* after;  // none: the reference's letter goes on
  };

  Band &reference_, &other_;
  double part_, empty_, loose_;
  bool plain_, made_ = false;
  std::vector<std::unique_ptr<Row>> rows_;
  Row nothing_;
  std::vector<std::vector<Move>> moves_a_, moves_b_;

  std::vector<std::vector<Move>> moves(Band& band) const {
    std::vector<std::vector<Move>> out(2 * band.letters.size() + 1);
    for (int place = 0; place < static_cast<int>(out.size()) && !stopped; ++place) {
      const int i = place >> 1, mid = place & 1;
      if (mid && !band.letters[i].transparent) continue;
      for (const Option& o : band.options(8 * i + 4 * mid))
        if (!o.empty) out[place].push_back({o.target >> 2, o.elastic ? -1.0 : o.size, loose_ * o.loose, o.soft});
    }
    return out;
  }

  void fill(int p) {
    rows_[p] = std::make_unique<Row>(2 * other_.letters.size() + 1, kInf);
    if (!made_) {
      moves_a_ = moves(reference_);
      moves_b_ = moves(other_);
      made_ = !stopped;
    }
    const int last = static_cast<int>(moves_b_.size()) - 1;
    Row& row = *rows_[p];
    std::vector<Reach> reach;
    for (const Move& m : moves_a_[p])
      reach.push_back({m.size, m.own * part_, m.soft && !plain_, m.end != p ? rows_[m.end].get() : nullptr});
    for (int q = last; q >= 0 && !stopped; --q) {
      unsigned work = 10;
      double best = q == last && reach.empty() ? 0.0 : kInf;
      const std::vector<Move>& others = moves_b_[q];
      const bool solid = !others.empty() && !other_.letters[q >> 1].transparent;
      for (const Move& m : others)  // the reference is empty
        if (m.end != q) best = least(best, row[m.end] + m.own + (m.size > 0 ? empty_ * part_ * m.size : 0.0));
      for (const Reach& a : reach) {
        if (a.own >= best) break;  // longer runs share more elements
        const bool stays = a.after == nullptr;
        const Row& rest = stays ? row : *a.after;
        if (!stays) best = least(best, a.own + rest[q] + (a.size > 0 ? empty_ * a.size : 0.0));
        const double up = part_ * (a.soft ? loose_ : 1.0);  // a metre by which the reference is short
        work += others.size();
        for (const Move& m : others) {
          if (stays && m.end == q) continue;
          double value = a.own + m.own;
          if (m.size >= 0 && a.size >= 0) {
            const double over = m.size - a.size;
            if (over > 0) {
              value += over * up;
              if (value >= best && solid) break;  // longer runs are dearer still
            } else {
              value -= over * (m.soft && !plain_ ? loose_ : part_);
            }
          }
          best = least(best, value + rest[m.end]);
        }
      }
      row[q] = best;
      check(work);
    }
  }

  static double least(double a, double b) { return b < a ? b : a; }
};
