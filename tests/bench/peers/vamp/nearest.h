// The nearest neighbours that VAMP asks its library nigh for, where that cannot be fetched: a k-d tree whose leaves
// hold 128 configurations and are looked through one by one, as in nigh. Only for the build of tests/bench/peers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace unc::robotics::nigh {

namespace metric {
template <typename T, typename Metric>
struct Space;
template <int p>
struct LP {};
}  // namespace metric

struct NoThreadSafety {};
template <std::size_t batch>
struct KDTreeBatch {
  static constexpr std::size_t kBatch = batch;
};

template <typename T, typename Space, typename KeyOf, typename Safety, typename Strategy>
class Nigh {
  using Key = typename Space::Type;
  static constexpr std::size_t kDimensions = Space::kDimensions, kLeaf = Strategy::kBatch;

  struct Branch {
    int axis = -1;  // -1: a leaf
    float at = 0;
    std::size_t below = 0, above = 0;
    std::vector<T> items;
  };

 public:
  Nigh() { branches_.emplace_back(); }

  std::size_t size() const { return size_; }

  void insert(const T& item) {
    ++size_;
    std::size_t at = 0;
    while (branches_[at].axis >= 0) {
      const Branch& branch = branches_[at];
      at = coordinate(item, branch.axis) < branch.at ? branch.below : branch.above;
    }
    branches_[at].items.push_back(item);
    if (branches_[at].items.size() > kLeaf) split(at);
  }

  std::optional<std::pair<T, float>> nearest(const Key& key) const {
    const T* best = nullptr;
    float best_distance = std::numeric_limits<float>::infinity();
    std::array<float, kDimensions> beyond{};
    const auto look = [&](const T& item) {
      const float distance = Space::distance(key, KeyOf{}(item));
      if (distance < best_distance) best = &item, best_distance = distance;
    };
    visit(0, key, beyond, 0, best_distance, look);
    if (best == nullptr) return std::nullopt;
    return std::pair<T, float>{*best, best_distance};
  }

  template <typename Distance>
  void nearest(std::vector<std::pair<T, Distance>>& out, const Key& key, std::size_t count, float radius) const {
    out.clear();
    const auto nearer = [](const auto& a, const auto& b) { return a.second < b.second; };
    float bound = radius;
    std::array<float, kDimensions> beyond{};
    const auto look = [&](const T& item) {
      const float distance = Space::distance(key, KeyOf{}(item));
      if (distance > bound) return;
      out.emplace_back(item, distance);
      std::push_heap(out.begin(), out.end(), nearer);
      if (out.size() > count) {
        std::pop_heap(out.begin(), out.end(), nearer);
        out.pop_back();
      }
      if (out.size() == count && count > 0) bound = std::min(bound, static_cast<float>(out.front().second));
    };
    visit(0, key, beyond, 0, bound, look);
    std::sort_heap(out.begin(), out.end(), nearer);
  }

 private:
  static float coordinate(const T& item, int axis) {
    return Space::coeff(KeyOf{}(item), static_cast<std::size_t>(axis));
  }

  void split(std::size_t at) {
    std::vector<T> items = std::move(branches_[at].items);
    int widest = 0;
    float width = -1;
    for (int axis = 0; axis < static_cast<int>(kDimensions); ++axis) {
      float low = std::numeric_limits<float>::infinity(), high = -low;
      for (const T& item : items) {
        low = std::min(low, coordinate(item, axis));
        high = std::max(high, coordinate(item, axis));
      }
      if (high - low > width) widest = axis, width = high - low;
    }
    const auto middle = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
    std::nth_element(items.begin(), middle, items.end(),
                     [&](const T& a, const T& b) { return coordinate(a, widest) < coordinate(b, widest); });
    const float value = coordinate(*middle, widest);
    Branch below, above;
    for (const T& item : items) (coordinate(item, widest) < value ? below : above).items.push_back(item);
    if (below.items.empty() || above.items.empty()) {  // all the same: one large leaf
      branches_[at].items = std::move(items);
      return;
    }
    const std::size_t first = branches_.size();
    branches_.push_back(std::move(below));
    branches_.push_back(std::move(above));
    branches_[at].axis = widest;
    branches_[at].at = value;
    branches_[at].below = first;
    branches_[at].above = first + 1;
  }

  // `beyond`: per axis, how far the key lies outside this branch; `squared`: the sum of their squares.
  template <typename Look>
  void visit(std::size_t at, const Key& key, std::array<float, kDimensions>& beyond, float squared, const float& bound,
             const Look& look) const {
    const Branch& branch = branches_[at];
    if (branch.axis < 0) {
      for (const T& item : branch.items) look(item);
      return;
    }
    const auto axis = static_cast<std::size_t>(branch.axis);
    const float offset = Space::coeff(key, axis) - branch.at;
    visit(offset < 0 ? branch.below : branch.above, key, beyond, squared, bound, look);
    const float other = squared - beyond[axis] * beyond[axis] + offset * offset;
    if (other > bound * bound) return;
    const float kept = std::exchange(beyond[axis], offset);
    visit(offset < 0 ? branch.above : branch.below, key, beyond, other, bound, look);
    beyond[axis] = kept;
  }

  std::deque<Branch> branches_;
  std::size_t size_ = 0;
};

}  // namespace unc::robotics::nigh
