// What searches share: a queue of successors that are not made yet, and the way to a state. Inside this folder.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace stampede::symbolic {

struct Entry {
  int parent, op;
};

// The operators that lead to state `number`; `entry_of` says how a state was reached, its op is -1 at the start.
template <typename EntryOf>
std::vector<int> operators_to(int number, const EntryOf& entry_of) {
  std::vector<int> plan;
  for (Entry at = entry_of(number); at.op >= 0; at = entry_of(at.parent)) plan.push_back(at.op);
  std::reverse(plan.begin(), plan.end());
  return plan;
}

// The lowest key first; first in, first out among equals.
class OpenList {
 public:
  bool empty() const { return count_ == 0; }
  std::int64_t count() const { return count_; }
  void push(int key, Entry entry) {
    if (static_cast<std::size_t>(key) >= buckets_.size()) buckets_.resize(static_cast<std::size_t>(key) + 1);
    buckets_[static_cast<std::size_t>(key)].entries.push_back(entry);
    lowest_ = std::min(lowest_, static_cast<std::size_t>(key));
    ++count_;
  }
  Entry pop() {
    while (buckets_[lowest_].next == buckets_[lowest_].entries.size()) ++lowest_;
    Bucket& bucket = buckets_[lowest_];
    const Entry entry = bucket.entries[bucket.next++];
    if (bucket.next == bucket.entries.size()) {
      bucket.entries.clear();
      bucket.next = 0;
    }
    --count_;
    return entry;
  }

 private:
  struct Bucket {
    std::vector<Entry> entries;
    std::size_t next = 0;
  };
  std::vector<Bucket> buckets_;
  std::size_t lowest_ = 0;
  std::int64_t count_ = 0;
};

}  // namespace stampede::symbolic
