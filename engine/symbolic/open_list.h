// A queue of successors that are not made yet. Inside this folder.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace stampede::symbolic {

struct Entry {
  int parent, op;
};

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
