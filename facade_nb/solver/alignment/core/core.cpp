// The alignment search of facade_nb in WebAssembly: what Python calls. Built by `make core`.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "dives.hpp"
#include "group.hpp"
#include "best_first.hpp"

#define EXPORT(name) extern "C" __attribute__((export_name(#name)))

extern "C" __attribute__((import_module("host"), import_name("check"))) int host_check();

bool stopped = false;
unsigned work_done = 0;
unsigned work_until = 0;

namespace {

constexpr unsigned kOften = 400000;  // of work, about a millisecond or two: so often the host is asked
double spent = 0.0;  // work since it was last told, less `work_done`
double allowed = HUGE_VAL;  // and how much there may be until then
double since = 0.0;  // the host was asked, less `work_done`

void count() {
  spent += work_done;
  since += work_done;
  work_done = 0;
}

/// How much work there may be until it is looked at again.
void look_again() {
  const double least = std::fmin(allowed - spent, kOften - since);
  work_until = stopped ? 0 : static_cast<unsigned>(std::fmax(std::floor(least), 0.0)) + 1;
}

}  // namespace

bool look() {
  count();
  if (spent > allowed) stopped = true;
  if (!stopped && since > kOften) {
    since = 0.0;
    stopped = host_check() != 0;
  }
  look_again();
  return stopped;
}

namespace {

// What is passed in and out of a call; calls have neither parameters nor results, which are dear in Python. The last one
// says that there was no memory left.
double box[8];
std::vector<double> numbers;  // more to be passed in
std::vector<int> structure;   // passed out, with its length before it

template <class T>
T* object(double number) {
  return reinterpret_cast<T*>(static_cast<std::uintptr_t>(number));
}
double number(const void* object) { return static_cast<double>(reinterpret_cast<std::uintptr_t>(object)); }

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

std::vector<Group*> groups_of(double n) {
  std::vector<Group*> groups;
  for (int k = 0; k < n; ++k) groups.push_back(object<Group>(numbers[k]));
  return groups;
}

/// How much was done, which does not depend on when the host was asked.
void tell_work() {
  count();
  box[5] = spent;
  spent = 0.0;
  allowed = HUGE_VAL;
  look_again();
}

void go_on() {
  stopped = false;
  look_again();
}

/// Status, bound, nodes, and a structure that has left the queue; work.
void answer(Search& search, Status status) {
  box[0] = status;
  box[1] = search.bound;
  box[2] = search.nodes;
  box[3] = status == kLeft ? number(spell(search.network, search.asked())) : 0.0;
  tell_work();
}

/// Status, limit, whether it is done, and a structure to be priced; work.
void answer(Dives& dives, Status status) {
  box[0] = status;
  box[1] = dives.limit;
  box[2] = dives.done;
  box[3] = status == kPrice ? number(spell(dives.network, dives.asked())) : 0.0;
  tell_work();
}

}  // namespace

void out_of_memory() {
  box[7] = 1.0;
  __builtin_trap();
}

void* operator new(std::size_t bytes) {
  void* room = std::malloc(bytes);
  if (room == nullptr) out_of_memory();
  return room;
}
void operator delete(void* room) noexcept { std::free(room); }
void operator delete(void* room, std::size_t) noexcept { std::free(room); }

EXPORT(box_at) double* box_at() { return box; }

// How many numbers are to be passed in → where they are put; large enough for most.
EXPORT(numbers_at) void numbers_at() {
  if (static_cast<double>(numbers.size()) < box[0]) numbers.resize(static_cast<std::size_t>(box[0]));
  box[0] = number(numbers.data());
}

// → its number
EXPORT(group_new) void group_new() { box[0] = number(Group::read(numbers.data())); }

// How much work there may be until the next answer
EXPORT(allow) void allow() {
  allowed = box[0];
  look_again();
}

// How many groups, structures to keep, most nodes, nodes in a turn, whether Python judges → its number, and as `answer`
EXPORT(search_new) void search_new() {
  go_on();
  auto* search = new Search(groups_of(box[0]), static_cast<int>(box[1]), box[2], box[3], box[4] != 0.0);
  answer(*search, stopped ? kStopped : kEnded);
  box[4] = number(search);
}
// Search, limit, whether it was paused → `answer`
EXPORT(search_advance) void search_advance() {
  go_on();
  auto& search = *object<Search>(box[0]);
  answer(search, search.advance(box[1], box[2] != 0.0));
}
// Search, cost of the best, its columns, whether it is proper, whether there are enough as good, limit → `answer`
EXPORT(search_judged) void search_judged() {
  auto& search = *object<Search>(box[0]);
  answer(search, search.judged(box[1], static_cast<int>(box[2]), box[3] != 0.0, box[4] != 0.0, box[5]));
}

// How many groups, least cost, whether only columns that can be sized → its number, and as `answer`
EXPORT(dives_new) void dives_new() {
  go_on();
  auto* dives = new Dives(groups_of(box[0]), box[1], box[2] != 0.0);
  answer(*dives, stopped ? kStopped : kEnded);
  box[4] = number(dives);
}
// Dives, ceiling → `answer`
EXPORT(dives_begin) void dives_begin() {
  auto& dives = *object<Dives>(box[0]);
  answer(dives, dives.begin(box[1]));
}
// Dives, whether there is an alignment already → `answer`
EXPORT(dives_dive) void dives_dive() {
  go_on();
  auto& dives = *object<Dives>(box[0]);
  answer(dives, dives.dive(box[1] != 0.0));
}
// Dives → `answer`
EXPORT(dives_missed) void dives_missed() {
  auto& dives = *object<Dives>(box[0]);
  answer(dives, dives.missed());
}
// Dives, cost → `answer`
EXPORT(dives_found) void dives_found() {
  auto& dives = *object<Dives>(box[0]);
  answer(dives, dives.found(box[1]));
}

// Nothing is left of who had this instance before.
EXPORT(begin) void begin() {
  count();
  spent = since = 0.0;
  allowed = HUGE_VAL;
  go_on();
}

// How many; among the numbers, of each which kind it is (0: search, 1: dives, 2: group) and its number
EXPORT(free_all) void free_all() {
  for (int k = 0; k < 2 * box[0]; k += 2) {
    if (numbers[k] == 0.0)
      delete object<Search>(numbers[k + 1]);
    else if (numbers[k] == 1.0)
      delete object<Dives>(numbers[k + 1]);
    else
      delete object<Group>(numbers[k + 1]);
  }
}
