// What a finished structure costs: the same as pricing.py, which has the reasons. Only the cost is found here; the sizes
// of the few structures that are looked at are found in Python.
#pragma once

#include <algorithm>
#include <vector>

#include "network.hpp"

extern "C" {
#include "api.h"
}

/// A linear programme, as it is met; solved by daqp like lp.py.
class Programme {
 public:
  using Terms = std::vector<std::pair<int, double>>;  // variable, coefficient
  struct Constraint {
    Terms terms;
    double low, high;
    bool operator==(const Constraint& other) const {
      return terms == other.terms && low == other.low && high == other.high;
    }
  };
  static constexpr double kFree = 1e30;

  std::vector<double> cost, low, high;
  std::vector<Constraint> rows;

  void clear() {
    cost.clear();
    low.clear();
    high.clear();
    rows.clear();
  }

  int variable(double least = 0.0, double price = 0.0) {
    cost.push_back(price);
    low.push_back(least);
    high.push_back(kFree);
    return static_cast<int>(cost.size()) - 1;
  }

  void add(Terms terms, double least, double most) { rows.push_back({std::move(terms), least, most}); }

  /// The cheapest point, or an empty one where the constraints contradict each other.
  std::vector<double> solve(const std::vector<Constraint>& pins) {
    const int n = static_cast<int>(cost.size()), m = static_cast<int>(rows.size() + pins.size());
    matrix_.assign(static_cast<std::size_t>(m) * n, 0.0);
    lower_ = low;
    upper_ = high;
    int r = 0;
    auto enter = [&](const Constraint& row) {
      for (const auto& [v, coefficient] : row.terms) matrix_[static_cast<std::size_t>(r) * n + v] = coefficient;
      lower_.push_back(row.low);
      upper_.push_back(row.high);
      ++r;
    };
    for (const Constraint& row : rows) enter(row);
    for (const Constraint& row : pins) enter(row);
    sense_.resize(n + m);
    for (int k = 0; k < n + m; ++k) sense_[k] = upper_[k] == lower_[k] ? 5 : 0;
    hessian_.assign(static_cast<std::size_t>(n) * n, 0.0);
    multipliers_.resize(n + m);
    std::vector<double> x(n);
    DAQPProblem problem{n,
                        n + m,
                        n,
                        hessian_.data(),
                        cost.data(),
                        m ? matrix_.data() : nullptr,
                        upper_.data(),
                        lower_.data(),
                        sense_.data(),
                        nullptr,
                        0,
                        0};
    DAQPSettings settings;
    daqp_default_settings(&settings);
    settings.primal_tol = 1e-11;
    settings.dual_tol = 1e-12;
    settings.eps_prox = 1e-2;
    settings.eta_prox = 1e-10;
    DAQPResult result{};
    result.x = x.data();
    result.lam = multipliers_.data();
    daqp_quadprog(&result, &problem, &settings);
    if (result.exitflag != 1) x.clear();
    return x;
  }

 private:
  std::vector<double> matrix_, lower_, upper_, hessian_, multipliers_;
  std::vector<int> sense_;
};

class Pricer {
 public:
  /// Least J of a complete path; infinite where no sizes keep within the tolerances.
  double operator()(const Network& network, const Path* path) {
    if (!pose(network, path)) return kInf;
    if (programme_.cost.empty()) return measure({});
    x_ = solve_with_floor({});
    return x_.empty() ? kInf : measure(x_);
  }

  /// Whether the structure priced last has sizes as good by which every piece is longer than nothing; `roughly`: whether
  /// it has them already.
  bool proper(bool roughly) {
    bool positive = true;
    for (const int piece : pieces_) positive = positive && x_[piece] >= kLeast;
    return positive || (!roughly && spread(objective(x_) + 1e-10));
  }

  /// Whether a complete path has sizes by which every piece is longer than nothing and J is at most `cost`.
  bool proper_within(const Network& network, const Path* path, double cost) {
    if (!pose(network, path)) return false;
    return pieces_.empty() ? (*this)(network, path) <= cost : spread(cost - constant_);
  }

 private:
  struct Part {
    double constant;
    int variable;  // −1: none
  };
  struct Term {
    double constant = 0.0;
    Programme::Terms terms;
  };
  struct Top {
    int high;
    std::vector<Term> sizes;
  };
  using Column = const Option* const*;
  static constexpr double kLeast = 1e-6;

  std::vector<double> x_, here_;
  std::vector<int> pieces_;  // variables that are the size of a piece
  const std::vector<Group*>* groups_ = nullptr;
  std::vector<std::vector<Column>> columns_;               // per group
  std::vector<std::vector<std::vector<std::vector<Part>>>> parts_;  // per group, column, band: its letters
  Programme programme_;
  std::vector<std::pair<int, int>> unsized_;  // symbol, variable
  std::vector<Programme::Terms> floors_;
  std::vector<std::vector<Top>> largest_;
  bool impossible_ = false;
  double constant_ = 0.0;  // J less the programme's objective

  const Group& group(int g) const { return *(*groups_)[g]; }

  /// Sets the programme up; false where it is clear that no sizes keep within the tolerances.
  bool pose(const Network& network, const Path* path) {
    x_.clear();
    groups_ = &network.groups;
    read(path);
    programme_.clear();
    pieces_.clear();
    unsized_.clear();
    floors_.clear();
    largest_.clear();
    impossible_ = false;
    constant_ = 0.0;
    parts_.resize(columns_.size());
    for (std::size_t g = 0; g < columns_.size(); ++g) make_parts(static_cast<int>(g));
    if (!programme_.cost.empty())
      for (std::size_t g = 0; g < columns_.size(); ++g) add_columns(static_cast<int>(g));
    return !impossible_;
  }

  void read(const Path* path) {
    columns_.resize(groups_->size());
    for (auto& own : columns_) own.clear();
    for (const Path* node = path; node->parent != nullptr; node = node->parent)
      columns_[node->parent->group].push_back(node->column);
    for (auto& own : columns_) std::reverse(own.begin(), own.end());
  }

  void make_parts(int g) {
    const Group& own = group(g);
    auto& parts = parts_[g];
    const int m = static_cast<int>(columns_[g].size());
    parts.assign(m, std::vector<std::vector<Part>>(own.count()));
    std::vector<std::pair<int, int>> places;
    for (int b = 0; b < own.count(); ++b) {
      const Band& band = *own.bands[b];
      for (int j = 0; j < m; ++j) parts[j][b].assign(columns_[g][j][b]->count, {0.0, -1});
      int from = 0;  // the first column in which the letter can stand
      for (int i = 0; i < band.size(); ++i) {
        const Letter& letter = band.letters[i];
        places.clear();
        for (int j = from; j < m; ++j) {
          const Option& option = *columns_[g][j][b];
          if (option.holds(i)) {
            if (places.empty()) from = j;
            places.push_back({j, i - option.first});
          } else if (option.count > 0 && option.first > i) {
            break;
          }
        }
        Part total{letter.sized ? letter.size : 0.0, -1};
        if (!letter.sized) total.variable = unsized(letter.symbol);
        if (places.size() == 1) {
          parts[places[0].first][b][places[0].second] = total;
          continue;
        }
        Programme::Terms balance;
        if (total.variable >= 0) balance.push_back({total.variable, -1.0});
        for (const auto& [j, k] : places) {
          const int v = programme_.variable();
          pieces_.push_back(v);
          parts[j][b][k] = {0.0, v};
          balance.push_back({v, 1.0});
        }
        programme_.add(std::move(balance), total.constant, total.constant);
      }
    }
  }

  int unsized(int symbol) {
    for (const auto& [own, variable] : unsized_)
      if (own == symbol) return variable;
    unsized_.push_back({symbol, programme_.variable()});
    pieces_.push_back(unsized_.back().second);
    return unsized_.back().second;
  }

  Term size(int g, int j, int b) const {
    Term out;
    for (const Part& part : parts_[g][j][b]) {
      out.constant += part.constant;
      if (part.variable < 0) continue;
      auto at = std::find_if(out.terms.begin(), out.terms.end(),
                             [&](const auto& own) { return own.first == part.variable; });
      if (at == out.terms.end())
        out.terms.push_back({part.variable, 1.0});
      else
        at->second += 1.0;
    }
    return out;
  }

  static double value(const Term& term, const std::vector<double>& x) {
    double sum = 0.0;
    for (const auto& [v, coefficient] : term.terms) sum += coefficient * x[v];
    return term.constant + sum;
  }

  static Programme::Terms less(int variable, const Programme::Terms& terms) {
    Programme::Terms out{{variable, 1.0}};
    for (const auto& [v, coefficient] : terms) out.push_back({v, -coefficient});
    return out;
  }

  /// ω, E and Λ of every column, W, and the tolerances.
  void add_columns(int g) {
    const Group& own = group(g);
    const Prices& prices = own.prices;
    const double mu = own.tolerance;
    double constant_width = 0.0;
    Programme::Terms width_terms;
    largest_.emplace_back();
    for (std::size_t j = 0; j < columns_[g].size(); ++j) {
      const Column column = columns_[g][j];
      std::vector<Term> sizes;
      std::vector<int> bands;
      bool elastic = false, rigid = false;
      int softs = 0;
      for (int b = 0; b < own.count(); ++b) {
        if (column[b]->empty) continue;
        bands.push_back(b);
        sizes.push_back(size(g, static_cast<int>(j), b));
        elastic = elastic || !sizes.back().terms.empty();
        if (!prices.plain && column[b]->soft)
          ++softs;
        else
          rigid = true;
      }
      const int empties = own.count() - static_cast<int>(bands.size());
      auto rests = [&](int b) { return !rigid || prices.plain || !column[b]->soft; };
      for (std::size_t k = 0; k < bands.size(); ++k) {
        const double soft = !prices.plain && column[bands[k]]->soft ? sizes[k].constant : 0.0;
        constant_ += own.share * prices.loose * (column[bands[k]]->loose - soft);
      }
      if (!elastic) {
        double most = -kInf, least = kInf;
        for (std::size_t k = 0; k < bands.size(); ++k) {
          most = std::max(most, sizes[k].constant);
          if (rests(bands[k])) least = std::min(least, sizes[k].constant);
        }
        if (most - least > mu + kEps) impossible_ = true;
        constant_width += most;
        constant_ += most - least + own.share * (prices.empty * empties + prices.loose * softs) * most;
        continue;
      }
      const int high = programme_.variable(
          -Programme::kFree, 1.0 + own.share * (prices.empty * empties + prices.loose * softs));
      const int low = programme_.variable(-Programme::kFree, -1.0);
      double fixed_low = kInf, fixed_high = -kInf;
      for (std::size_t k = 0; k < bands.size(); ++k) {
        const Term& term = sizes[k];
        if (term.terms.empty()) {
          fixed_high = std::max(fixed_high, term.constant);
          if (rests(bands[k])) fixed_low = std::min(fixed_low, term.constant);
          continue;
        }
        programme_.add(less(high, term.terms), term.constant, Programme::kFree);
        if (rests(bands[k])) programme_.add(less(low, term.terms), -Programme::kFree, term.constant);
      }
      if (fixed_high > -kInf) programme_.low[high] = fixed_high;
      if (fixed_low < kInf) programme_.high[low] = fixed_low;
      programme_.add({{high, 1.0}, {low, -1.0}}, -Programme::kFree, mu);
      width_terms.push_back({high, 1.0});
      largest_.back().push_back({high, std::move(sizes)});
    }
    const double gap = own.canvas - constant_width;
    if (!width_terms.empty())
      programme_.add(width_terms, -Programme::kFree, gap + mu);
    else if (std::abs(gap) > mu + kEps)
      impossible_ = true;
    if (prices.fit != 0.0) {
      const int t = programme_.variable(0.0, 1.0);
      for (const double sign : {1.0, -1.0}) {
        Programme::Terms row{{t, 1.0}};
        for (const auto& [v, coefficient] : width_terms) row.push_back({v, -sign * prices.fit * coefficient});
        programme_.add(std::move(row), -sign * prices.fit * gap, Programme::kFree);
      }
    }
    floors_.push_back(std::move(width_terms));
  }

  double width(int g, const std::vector<double>& x) const {
    double total = 0.0;
    for (std::size_t j = 0; j < columns_[g].size(); ++j) {
      double most = -kInf;
      for (int b = 0; b < group(g).count(); ++b)
        if (!columns_[g][j][b]->empty) most = std::max(most, value(size(g, static_cast<int>(j), b), x));
      total += most;
    }
    return total;
  }

  double constant_width(int g) const {
    double total = 0.0;
    for (std::size_t j = 0; j < columns_[g].size(); ++j) {
      double most = -kInf;
      bool elastic = false;
      for (int b = 0; b < group(g).count(); ++b) {
        if (columns_[g][j][b]->empty) continue;
        const Term own = size(g, static_cast<int>(j), b);
        elastic = elastic || !own.terms.empty();
        most = std::max(most, own.constant);
      }
      if (!elastic) total += most;
    }
    return total;
  }

  double objective(const std::vector<double>& x) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) sum += programme_.cost[k] * x[k];
    return sum;
  }

  /// Solve; where W falls below canvas − μ, ask for more and branch on the row that is to be the largest.
  std::vector<double> solve_with_floor(std::vector<Programme::Constraint> pins) {
    std::vector<double> x = programme_.solve(pins);
    if (x.empty()) return x;
    for (int g = 0; g < static_cast<int>(columns_.size()); ++g) {
      const double floor = group(g).canvas - group(g).tolerance;
      if (width(g, x) >= floor - 1e-8) continue;
      if (floors_[g].empty()) return {};
      const Programme::Constraint demand{floors_[g], floor - constant_width(g), Programme::kFree};
      if (std::find(pins.begin(), pins.end(), demand) == pins.end()) {
        pins.push_back(demand);
        x = programme_.solve(pins);
        if (x.empty()) return x;
        if (width(g, x) >= floor - 1e-8) return solve_with_floor(std::move(pins));
      }
      std::vector<double> best;
      for (const Top& top : largest_[g]) {
        double most = -kInf;
        for (const Term& term : top.sizes) most = std::max(most, value(term, x));
        if (x[top.high] <= most + 1e-9) continue;
        for (const Term& term : top.sizes) {
          if (check(10000)) return {};
          std::vector<Programme::Constraint> more = pins;
          more.push_back({less(top.high, term.terms), term.constant, term.constant});
          std::vector<double> found = solve_with_floor(std::move(more));
          if (!found.empty() && (best.empty() || objective(found) < objective(best) - kEps)) best = std::move(found);
        }
        return best;
      }
    }
    return x;
  }

  /// Sizes of at most this objective with the smallest piece as large as possible; false where that is nothing.
  bool spread(double most) {
    Programme::Constraint budget{{}, -Programme::kFree, most};
    for (std::size_t v = 0; v < programme_.cost.size(); ++v)
      if (programme_.cost[v] != 0.0) budget.terms.push_back({static_cast<int>(v), programme_.cost[v]});
    const int least = programme_.variable();
    std::vector<Programme::Constraint> extra{std::move(budget)};
    for (const int piece : pieces_) extra.push_back({{{piece, 1.0}, {least, -1.0}}, 0.0, Programme::kFree});
    std::fill(programme_.cost.begin(), programme_.cost.end(), 0.0);
    programme_.cost[least] = -1.0;
    programme_.high[least] = 1.0;
    const std::vector<double> x = programme_.solve(extra);
    if (x.empty() || x[least] < kLeast) return false;
    for (int g = 0; g < static_cast<int>(columns_.size()); ++g)
      if (width(g, x) < group(g).canvas - group(g).tolerance - 1e-8) return false;
    return true;
  }

  /// J from the sizes themselves, whatever the programme said.
  double measure(const std::vector<double>& x) {
    double cost = 0.0;
    for (int g = 0; g < static_cast<int>(columns_.size()); ++g) {
      const Group& own = group(g);
      const Prices& prices = own.prices;
      double width = 0.0;
      for (std::size_t j = 0; j < columns_[g].size(); ++j) {
        const Column column = columns_[g][j];
        double largest = -kInf, least = kInf, least_all = kInf, loose = 0.0;
        int empties = 0;
        std::vector<double>& here = here_;
        here.assign(own.count(), 0.0);
        for (int b = 0; b < own.count(); ++b) {
          if (column[b]->empty) {
            ++empties;
            continue;
          }
          for (const Part& part : parts_[g][j][b])
            here[b] += std::max(0.0, part.constant + (part.variable < 0 ? 0.0 : x[part.variable]));
          largest = std::max(largest, here[b]);
          least_all = std::min(least_all, here[b]);
          if (prices.plain || !column[b]->soft) least = std::min(least, here[b]);
        }
        for (int b = 0; b < own.count(); ++b)
          if (!column[b]->empty) loose += column[b]->loose + (column[b]->soft ? largest - here[b] : 0.0);
        const double omega = largest - (least < kInf ? least : least_all);
        if (omega > own.tolerance + 1e-7) return kInf;
        width += largest;
        cost += omega + own.share * (prices.empty * empties * largest + prices.loose * loose);
      }
      if (std::abs(width - own.canvas) > own.tolerance + 1e-7) return kInf;
      cost += prices.fit * std::abs(width - own.canvas);
    }
    return cost;
  }
};
