// A list that grows at its end and whose copies share what they have in common: a copy takes a time and memory that
// hardly depend on how long it is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace stampede {

// Elements lie in chunks; one that another copy may see is copied before it is written to. Lifetime: its own. Many
// threads may copy a list that is itself a copy.
template <typename T, std::size_t kChunk = 16>
class SharedList {
 public:
  class Iterator {
   public:
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    Iterator(const SharedList* list, std::size_t at) : list_(list), at_(at) {}
    const T& operator*() const { return (*list_)[at_]; }
    Iterator& operator++() { return ++at_, *this; }
    bool operator==(const Iterator&) const = default;

   private:
    const SharedList* list_;
    std::size_t at_;
  };

  SharedList() = default;
  SharedList(const SharedList& other) : size_(other.size_) {
    for (const Chunk& chunk : other.chunks_)
      if (!chunk.shared) chunk.shared = true;  // a copy's are already: it is not written to
    chunks_ = other.chunks_;
  }
  SharedList(SharedList&& other) noexcept
      : chunks_(std::exchange(other.chunks_, {})), size_(std::exchange(other.size_, 0)) {}
  SharedList& operator=(SharedList other) noexcept {
    chunks_.swap(other.chunks_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~SharedList() = default;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  Iterator begin() const { return {this, 0}; }
  Iterator end() const { return {this, size_}; }
  const T& operator[](std::size_t i) const { return (*chunks_[i / kChunk].values)[i % kChunk]; }
  const T& at(std::size_t i) const {
    if (i >= size_) throw std::out_of_range("SharedList::at");
    return (*this)[i];
  }
  const T& front() const { return (*this)[0]; }
  const T& back() const { return (*this)[size_ - 1]; }

  T& edit(std::size_t i) { return own(i / kChunk)[i % kChunk]; }
  T& edit_back() { return edit(size_ - 1); }
  void push_back(T value) {
    if (size_ % kChunk == 0) {
      chunks_.push_back({std::make_shared<std::vector<T>>()});
      chunks_.back().values->reserve(kChunk);
    }
    own(size_ / kChunk).push_back(std::move(value));
    ++size_;
  }
  void shorten(std::size_t size) {
    if (size >= size_) return;
    chunks_.resize((size + kChunk - 1) / kChunk);
    if (size % kChunk != 0) {
      std::vector<T>& last = own(size / kChunk);
      last.erase(last.begin() + static_cast<std::ptrdiff_t>(size % kChunk), last.end());
    }
    size_ = size;
  }
  void erase(std::size_t i) {
    for (; i + 1 < size_; ++i) edit(i) = std::move(edit(i + 1));
    shorten(i);
  }
  void clear() { shorten(0); }
  void keep_last(std::size_t count) {
    if (size_ <= count) return;
    std::vector<T> last;
    for (std::size_t i = size_ - count; i < size_; ++i) last.push_back(std::move(edit(i)));
    clear();
    for (T& one : last) push_back(std::move(one));
  }

  std::vector<T> copy() const {
    std::vector<T> all;
    all.reserve(size_);
    for (const Chunk& chunk : chunks_) all.insert(all.end(), chunk.values->begin(), chunk.values->end());
    return all;
  }
  std::vector<T> take() {  // it is empty then
    std::vector<T> all;
    all.reserve(size_);
    for (const Chunk& chunk : chunks_) {
      if (chunk.shared)
        all.insert(all.end(), chunk.values->begin(), chunk.values->end());
      else
        std::move(chunk.values->begin(), chunk.values->end(), std::back_inserter(all));
    }
    clear();
    return all;
  }

 private:
  struct Chunk {
    std::shared_ptr<std::vector<T>> values;
    mutable bool shared = false;  // another copy may see it
  };
  std::vector<T>& own(std::size_t place) {
    Chunk& chunk = chunks_[place];
    if (chunk.shared) {
      auto copied = std::make_shared<std::vector<T>>();
      copied->reserve(kChunk);
      copied->assign(chunk.values->begin(), chunk.values->end());
      chunk = {std::move(copied)};
    }
    return *chunk.values;
  }

  std::vector<Chunk> chunks_;
  std::size_t size_ = 0;
};

}  // namespace stampede
