// The alignment search of facade_nb in WebAssembly: what Python calls. Built by `make core`.

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "dive.hpp"
#include "group.hpp"
#include "search.hpp"

#define EXPORT(name) extern "C" __attribute__((export_name(#name)))

extern "C" __attribute__((import_module("host"), import_name("check"))) int host_check();

bool stopped = false;

bool check(unsigned work) {
  constexpr unsigned kOften = 400000;  // about every millisecond or two
  static unsigned done = 0;
  done += work;
  if (!stopped && done > kOften) {
    done = 0;
    stopped = host_check() != 0;
  }
  return stopped;
}

// Python reads the first members of both.
static_assert(offsetof(Search, bound) == 0 && offsetof(Search, nodes) == 8 && offsetof(Search, root) == 16);
static_assert(offsetof(Dives, limit) == 0 && offsetof(Dives, done) == 8);

namespace {

std::vector<double> numbers;  // what is passed in
std::vector<int> structure;   // what is passed out

/// The columns of a complete path: per group their number, then per column and band which option was taken.
const int* spell(const Network& network, const Path* path) {
  structure.assign(1, 0);
  std::vector<std::vector<const Path*>> columns(network.groups.size());
  for (const Path* node = path; node->parent != nullptr; node = node->parent)
    columns[node->parent->group].push_back(node);
  for (std::size_t g = 0; g < columns.size(); ++g) {
    structure.push_back(static_cast<int>(columns[g].size()));
    for (auto node = columns[g].rbegin(); node != columns[g].rend(); ++node)
      for (int b = 0; b < network.groups[g]->count(); ++b) structure.push_back((*node)->column[b]->index);
  }
  structure[0] = static_cast<int>(structure.size()) - 1;
  return structure.data();
}

std::vector<Group*> groups_of(int n) {
  std::vector<Group*> groups;
  for (int k = 0; k < n; ++k) groups.push_back(reinterpret_cast<Group*>(static_cast<std::uintptr_t>(numbers[k])));
  return groups;
}

}  // namespace

// Large enough for most of what is passed in.
EXPORT(numbers_at) double* numbers_at(int n) {
  if (static_cast<int>(numbers.size()) < n) numbers.resize(n);
  return numbers.data();
}

EXPORT(group_new) Group* group_new() { return Group::read(numbers.data()); }
EXPORT(group_free) void group_free(Group* group) { delete group; }

EXPORT(search_new) Search* search_new(int groups, int keep, double nodes, double turn, int judged) {
  stopped = false;
  return new Search(groups_of(groups), keep, nodes, turn, judged != 0);
}
EXPORT(search_free) void search_free(Search* search) { delete search; }
EXPORT(search_advance) int search_advance(Search* search, double limit, int paused) {
  stopped = false;
  return search->advance(limit, paused != 0);
}
EXPORT(search_judged)
int search_judged(Search* search, double best, int columns, int proper, int enough, double limit) {
  return search->judged(best, columns, proper != 0, enough != 0, limit);
}
EXPORT(search_structure) const int* search_structure(Search* search) {
  return spell(search->network, search->asked());
}

EXPORT(dives_new) Dives* dives_new(int groups, double least, int sizable) {
  stopped = false;
  return new Dives(groups_of(groups), least, sizable != 0);
}
EXPORT(dives_free) void dives_free(Dives* dives) { delete dives; }
EXPORT(dives_begin) int dives_begin(Dives* dives, double ceiling) { return dives->begin(ceiling); }
EXPORT(dives_dive) int dives_dive(Dives* dives, int any) {
  stopped = false;
  return dives->dive(any != 0);
}
EXPORT(dives_missed) int dives_missed(Dives* dives) { return dives->missed(); }
EXPORT(dives_found) int dives_found(Dives* dives, double cost) { return dives->found(cost); }
EXPORT(dives_structure) const int* dives_structure(Dives* dives) { return spell(dives->network, dives->asked()); }
