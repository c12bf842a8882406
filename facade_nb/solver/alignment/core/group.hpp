// An alignment group, ready to be aligned: the same as group.Group, which it is read from.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "arena.hpp"
#include "pairs.hpp"
#include "table.hpp"
#include "words.hpp"

/// A column that may come next (see paths.Edge).
struct Edge {
  const Option* const* column;  // per band
  const Position* state;        // per band
  double cost, omega, width, least, rise, ahead, up;
  bool firm, owed, tied, pieces, pinched;
};

/// The edges of a node that have been made, the least rise first, and up to which.
struct Known {
  const Position* state;
  bool owed;
  double limit;
  const Edge* edges;
  std::size_t count;
};

struct Group {
  std::vector<std::unique_ptr<Band>> bands;
  double canvas, tolerance, share, under;
  Prices prices;
  bool waived, stiff, tied, tall;
  int reference;  // −1: none
  std::vector<double> weights;
  std::vector<std::vector<int>> guards;
  std::vector<std::unique_ptr<PairTable>> pairs;  // per band; none for the reference

  Arena arena;  // of the edges
  Table<Known> known;

  int count() const { return static_cast<int>(bands.size()); }

  /// What the rows still cost each other, by pairs with the reference.
  double ahead(const Position* state) {
    if (reference < 0) return 0.0;
    double total = 0.0;
    for (int b = 0; b < count(); ++b)
      if (pairs[b]) total += pairs[b]->at(state[reference], state[b]);
    return total;
  }

  /// Whether no sizes of the symbols can make such a column (see columns.unsizable).
  bool unsizable(const Option* const* column) const {
    for (int a = 0; a < count(); ++a) {
      const Option& filling = *column[a];
      if (filling.empty || filling.soft) continue;
      const bool cut = filling.transparent && !(filling.begins && filling.ends);
      for (int b = 0; b < count(); ++b) {
        const Option& other = *column[b];
        if (a == b || other.empty) continue;
        const int first = other.first + (other.transparent && !other.begins);
        const int last = other.first + other.count - (other.transparent && !other.ends);
        const bool parts = other.transparent && !(other.begins && other.ends);
        if (filling.count > last - first || !(cut || parts || filling.count < last - first)) continue;
        if (within(*bands[a], filling.first, filling.first + filling.count, *bands[b], first, last)) return true;
      }
    }
    return false;
  }

  /// Reads what compiled.py writes; see there for the order.
  static Group* read(const double* at) {
    auto group = std::make_unique<Group>();
    auto next = [&at] { return *at++; };
    auto whole = [&at] { return static_cast<int>(*at++); };
    auto flag = [&at] { return *at++ != 0.0; };
    const int n = whole();
    group->canvas = next();
    group->tolerance = next();
    group->share = next();
    group->under = next();
    group->prices = {next(), next(), next(), flag()};
    group->waived = flag();
    group->stiff = flag();
    group->tied = flag();
    group->tall = flag();
    group->reference = whole();
    for (int b = 0; b < n; ++b) {
      group->weights.push_back(next());
      const int guards = whole();
      group->guards.emplace_back();
      for (int k = 0; k < guards; ++k) group->guards.back().push_back(whole());
      auto band = std::make_unique<Band>();
      band->cuts = flag();
      const int letters = whole();
      for (int i = 0; i < letters; ++i) {
        Letter letter{};
        letter.size = next();
        letter.symbol = whole();
        const int flags = whole();
        letter.sized = flags & 1;
        letter.transparent = flags & 2;
        letter.opaque = flags & 4;
        letter.attached = flags & 8;
        letter.unoccludable = flags & 16;
        letter.free = flags & 32;
        band->letters.push_back(letter);
      }
      band->soft_rest.assign(at, at + letters + 1);
      at += letters + 1;
      band->gap_rest.assign(at, at + letters + 1);
      at += letters + 1;
      band->finish();
      group->bands.push_back(std::move(band));
    }
    for (int b = 0; b < n; ++b) {
      const bool paired = group->reference >= 0 && b != group->reference;
      group->pairs.push_back(paired ? std::make_unique<PairTable>(*group->bands[group->reference], *group->bands[b],
                                                                  group->prices, group->share, n - 1)
                                    : nullptr);
    }
    return group.release();
  }

 private:
  /// Whether all symbols of some letters, as often as they stand there, are among those of others.
  static bool within(const Band& a, int from_a, int to_a, const Band& b, int from_b, int to_b) {
    for (int i = from_a; i < to_a; ++i) {
      const int symbol = a.letters[i].symbol;
      int here = 0, there = 0;
      for (int k = from_a; k < to_a; ++k) here += a.letters[k].symbol == symbol;
      for (int k = from_b; k < to_b; ++k) there += b.letters[k].symbol == symbol;
      if (here > there) return false;
    }
    return true;
  }
};
