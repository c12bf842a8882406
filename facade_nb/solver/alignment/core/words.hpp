// Words and the elements that may stand in a column: the same as bands.py and elements.py, which has the reasons.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

constexpr double kInf = HUGE_VAL;
constexpr double kEps = 1e-9;

extern bool stopped;
extern unsigned work_done;   // since it was last looked at
extern unsigned work_until;  // where it is looked at again; 0 once stopped
bool look();

/// To be called often, with the work that was done since, in steps of some nanoseconds. Now and then it asks the host
/// whether to go on; once that has said no, `stopped` says so, and everything returns as soon as it can.
inline bool check(unsigned work) {
  work_done += work;
  return work_done >= work_until && look();
}

struct Letter {
  double size;  // metres; what is not `sized` has 0
  int symbol;
  bool sized, transparent, opaque, attached, unoccludable, free;
};

/// Where a band stands: 8·i + 4·mid + 2·gap + held (see columns.Position).
using Position = int;

struct Option {
  Position target;
  int index;         // in the list of its position
  int first, count;  // letters first … first + count − 1
  double size;       // where it is not elastic
  double loose;
  double sized;  // size of the letter that ends it, NaN: none
  double least;  // size of its whole sized letters
  bool empty, transparent, elastic, soft, opaque, guarded, begins, ends, tied;

  bool holds(int letter) const { return letter >= first && letter < first + count; }
};

using Options = std::vector<Option>;

struct Counted {
  int symbol, times;
};

/// The rows of a group that have one word.
class Band {
 public:
  std::vector<Letter> letters;
  std::vector<double> rest_min, rest_max, soft_rest, gap_rest;
  bool cuts = true, soft = false, elastic = false, tied = false, rigid = true;
  Position end = 0;

  void finish();
  const Options& options(Position position);
  const std::vector<Counted>& unsized_from(int i);

  double at_least(Position position) const {
    return position & 4 ? rest_min[(position >> 3) + 1] : rest_min[position >> 3];
  }
  int size() const { return static_cast<int>(letters.size()); }

 private:
  std::vector<std::unique_ptr<Options>> options_;
  Options scrap_;
  std::vector<std::unique_ptr<std::vector<Counted>>> unsized_;

  void make(Position position, Options& out) const;
  void solid(int i, Options& out) const;
  void transparent(int i, bool mid, Options& out) const;
};

inline void Band::finish() {
  const int n = size();
  end = 8 * n;
  rest_min.assign(n + 1, 0.0);
  rest_max.assign(n + 1, 0.0);
  for (int i = n - 1; i >= 0; --i) {
    const Letter& a = letters[i];
    rest_min[i] = rest_min[i + 1] + a.size;
    rest_max[i] = rest_max[i + 1] + (a.sized ? a.size : kInf);
    const bool stretches = a.transparent && (cuts || !a.sized);
    soft = soft || (!a.opaque && !a.transparent);
    elastic = elastic || stretches;
    tied = tied || (stretches && !a.free);
    rigid = rigid && !a.transparent;
  }
  options_.resize(8 * (n + 1));
  unsized_.resize(n + 1);
}

inline const std::vector<Counted>& Band::unsized_from(int i) {
  auto& found = unsized_[i];
  if (!found) {
    found = std::make_unique<std::vector<Counted>>();
    for (int j = i; j < size(); ++j) {
      if (letters[j].sized) continue;
      Counted* own = nullptr;
      for (Counted& other : *found)
        if (other.symbol == letters[j].symbol) own = &other;
      if (own != nullptr)
        ++own->times;
      else
        found->push_back({letters[j].symbol, 1});
    }
  }
  return *found;
}

inline const Options& Band::options(Position position) {
  auto& found = options_[position];
  if (!found) {
    scrap_.clear();
    make(position, scrap_);
    for (std::size_t k = 0; k < scrap_.size(); ++k) scrap_[k].index = static_cast<int>(k);
    if (stopped) return scrap_;  // these may not be all
    found = std::make_unique<Options>(scrap_);
  }
  return *found;
}

inline void Band::make(Position position, Options& out) const {
  const int i = position >> 3, n = size();
  const bool mid = position & 4, gap = position & 2, held = position & 1;
  if (!held) {  // C4, behind
    const bool ahead = i < n && !mid && letters[i].attached && !letters[i].transparent;
    Option nothing{};
    nothing.target = 8 * i + (mid ? 4 : 0) + (ahead ? 2 : 0);
    nothing.empty = true;
    nothing.sized = NAN;
    out.push_back(nothing);
  }
  if (i == n) return;
  if (letters[i].transparent)
    transparent(i, mid, out);
  else if (!gap)  // C4, before
    solid(i, out);
}

inline void Band::solid(int i, Options& out) const {
  Option run{};
  run.first = i;
  run.begins = run.ends = true;
  run.sized = NAN;
  for (int j = i; j < size(); ++j) {
    const Letter& letter = letters[j];
    if (letter.transparent) return;
    if (j > i) run.loose += std::fmin(letter.size, letters[j - 1].size);
    run.size += letter.size;
    run.least = run.size;
    run.soft = run.soft || !letter.opaque;
    run.opaque = !run.soft;
    run.guarded = run.guarded || letter.unoccludable;
    run.count = j - i + 1;
    run.target = 8 * (j + 1) + (letter.attached ? 1 : 0);
    out.push_back(run);
    if (!(run.count & 255) && check(1024)) return;
  }
}

inline void Band::transparent(int i, bool mid, Options& out) const {
  bool fixed = !mid, tied = false;
  double size = 0.0, least = 0.0;
  for (int j = i; j < this->size(); ++j) {
    const Letter& letter = letters[j];
    if (!letter.transparent) return;
    const bool bound = !letter.free;
    Option run{};
    run.transparent = true;
    run.first = i;
    run.count = j - i + 1;
    run.begins = !mid;
    if (cuts) {  // ends within letter j
      Option part = run;
      part.target = 8 * j + 4;
      part.elastic = true;
      part.tied = tied || bound;
      part.sized = NAN;
      part.least = least;
      out.push_back(part);
    }
    if (letter.sized && (j > i || !mid)) least += letter.size;
    fixed = fixed && letter.sized && (j > i || !mid);
    if (fixed) size += letter.size;
    tied = tied || bound;
    run.target = 8 * (j + 1);
    run.ends = true;
    run.elastic = !fixed;
    run.size = fixed ? size : 0.0;
    run.tied = tied && !fixed;
    run.sized = letter.sized ? letter.size : NAN;
    run.least = least;
    out.push_back(run);
    if (!(run.count & 255) && check(1024)) return;
  }
}
